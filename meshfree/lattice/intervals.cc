#include "meshfree/discretisations.h"
#include "meshfree/lattice/stencil.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// Nodes at the centres of the cells; u is constant on each.
    class RuleOnIntervals : public method::IntervalDiscretisation
    {
    public:
      RuleOnIntervals(const problem::Problem<1> &problem, const Bonds<1> &bonds)
          : IntervalDiscretisation(problem, {{.5, false, 0}},
                                   lattice_operator(problem.kernel, bonds)),
            diagnostics_(describe(problem, bonds, stencil()))
      {
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      Vector load(const problem::Problem<1> &problem) const override
      {
        Vector result(static_cast<unsigned int>(lattice().n_cells()));
        lattice().for_each_cell([&](int i)
                                { result[i] = problem.load.value(Point<1>(place(0, i)), 0); });
        return result;
      }
      double value_in(int cell, double, const method::LineValues &values) const override
      {
        return values.at(0, cell);
      }
      double average_over(int cell, const method::LineValues &values) const override
      {
        return values.at(0, cell);
      }

      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::unique_ptr<method::IntervalDiscretisation>
  discretise_on_intervals(const Rule &rule, const problem::Problem<1> &problem)
  {
    return std::make_unique<RuleOnIntervals>(
        problem, lattice_bonds(rule.on_line(problem.kernel), problem.kernel, problem.h(),
                               problem.settings.geometry.backend));
  }
} // namespace plumbline::meshfree
