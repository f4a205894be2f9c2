#include "meshfree/discretisations.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/family_moments.h"
#include "meshfree/rules/family_statistics.h"
#include "method/limit_proof.h"

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double centre = .5; ///< of cells, where nodes are

    class RuleOnBox : public method::BoxDiscretisation
    {
    public:
      RuleOnBox(const problem::Problem<3> &problem, const Bonds<3> &bonds)
          : BoxDiscretisation(problem, {problem.lattice.n_cells(), centre},
                              lattice_operator(problem.kernel, bonds)),
            n_components_(problem.n_components)
      {
        describe_weights(bonds.family, bonds.fit, diagnostics_);
        diagnostics_.notes = bonds.notes;
        diagnostics_.limit = method::prove_by_moments(problem, stencil(), 1);
        if (problem.settings.ball_order > 0)
        {
          const BallMoments ball(problem.kernel, problem.settings.ball_order);
          diagnostics_.limit.ball_defect = ball.worst_defect(bonds.family);
          diagnostics_.limit.area_defect = ball.area_defect(bonds.family);
        }
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      std::vector<physics::AxisFunctional> load_functionals(unsigned int axis) const override
      {
        std::vector<physics::AxisFunctional> values;
        for (int i = 0; i < nodes().n[axis]; ++i)
          values.push_back({{lattice().coordinate(axis, i + centre), 1}});
        return values;
      }

      /// Values at the nodes.
      std::vector<double> averages(const std::vector<double> &values) const override
      {
        const auto &n = nodes().n;
        std::vector<double> result;
        const std::size_t row = n[0] + 2, layer = row * (n[1] + 2), block = layer * (n[2] + 2);
        for (int k = 1; k <= n[2]; ++k)
          for (int j = 1; j <= n[1]; ++j)
            for (int i = 1; i <= n[0]; ++i)
              for (unsigned int c = 0; c < n_components_; ++c)
                result.push_back(values[c * block + k * layer + j * row + i]);
        return result;
      }

      unsigned int n_components_;
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
