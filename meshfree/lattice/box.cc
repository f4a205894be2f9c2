#include "meshfree/discretisations.h"
#include "meshfree/lattice/stencil.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// Nodes at the centres of the cells.
    class RuleOnBox : public method::BoxDiscretisation
    {
    public:
      RuleOnBox(const problem::Problem<3> &problem, const Bonds<3> &bonds)
          : BoxDiscretisation(problem, method::NodePlace::centres,
                              problem.dilatation ? state_based_stencil(*problem.dilatation, bonds)
                                                 : lattice_operator(problem.kernel, bonds)),
            diagnostics_(describe(problem, bonds, stencil()))
      {
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      bool is_collocated() const override { return true; }

      algebra::Stencil mass_stencil() const override
      {
        algebra::Stencil mass(stencil().n_blocks(), 0);
        for (unsigned int c = 0; c < mass.n_blocks(); ++c)
          mass(c, c, 0, 0) = 1; // equations at nodes
        return mass;
      }

      physics::AxisFunctional load_functional(double coordinate) const override
      {
        return {{coordinate, 1}};
      }

      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::unique_ptr<method::BoxDiscretisation> discretise_on_box(const Rule &rule,
                                                               const problem::Problem<3> &problem)
  {
    return std::make_unique<RuleOnBox>(problem, lattice_bonds(rule.in_space(problem.kernel),
                                                              problem.kernel, problem.h(),
                                                              problem.settings.geometry.backend));
  }
} // namespace plumbline::meshfree
