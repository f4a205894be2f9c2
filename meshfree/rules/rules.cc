#include "meshfree/rules/rules.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "meshfree/rules/monte_carlo.h"

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim, unsigned int degree>
    NeighbourhoodQuadrature<dim> of_degree(const Kernel<dim> &kernel)
    {
      return recalibrated(kernel, degree);
    }
  } // namespace

  const std::vector<Rule> &rules()
  {
    static const std::vector<Rule> table = {
        {"FA", "full area of cells whose node is in the ball", full_area<2>, full_area<3>, false,
         full_area<1>},
        {"LAMMPS", "full area with a ramp inside the horizon", lammps<2>, lammps<3>, false,
         lammps<1>},
        {"QWJ", "full area with a ramp across the horizon", qwj<2>, qwj<3>, false, qwj<1>},
        {"PA-AC", "exact partial areas, kernel at the node", partial_area<2>, partial_area<3>,
         false, partial_area<1>},
        {"IPA-AC",
         "exact partial areas, kernel at the centroid of ball and cell ('plumbline describe "
         "Methods/names': what of each model)",
         improved_partial_area<2>, improved_partial_area<3>, false, improved_partial_area<1>},
        {"IPA-AC-R2", "IPA-AC recalibrated to exact moments of degree 2", of_degree<2, 2>,
         of_degree<3, 2>, false, of_degree<1, 2>},
        {"IPA-AC-R4", "IPA-AC recalibrated to exact moments of degree 4", of_degree<2, 4>,
         of_degree<3, 4>, false, of_degree<1, 4>},
        {"OPT",
         "optimisation-based quadrature weights",
         optimisation_based<2>,
         optimisation_based<3>,
         false,
         {},
         "its weights integrate s^2/|s|^3, which is not "
         "integrable in one dimension"},
    };
    return table;
  }

  const std::vector<Rule> &rules_on_request()
  {
    static const std::vector<Rule> table = {
        {"GFD",
         "generalised finite differences: exact second moments, any kernel profile; not "
         "m-convergent",
         generalised_finite_differences<2>, generalised_finite_differences<3>},
        {"PDDO",
         "peridynamic differential operator, scalar kernels: exact second moments, but short waves "
         "may be unstable; not m-convergent",
         peridynamic_differential_operator<2>, peridynamic_differential_operator<3>, true},
        {"GMLS",
         "generalised moving least squares, scalar kernels: exact second moments; not m-convergent",
         generalised_moving_least_squares<2>, generalised_moving_least_squares<3>, true},
        {"MC", "Monte Carlo: the area of the ball divided equally among the nodes in it",
         monte_carlo<2>, monte_carlo<3>, false, monte_carlo<1>},
        {"IPA-AC-R2c", "IPA-AC-R2 with tensors at the centroid: negative weights, a counterexample",
         recalibrated_at_centroid<2>, recalibrated_at_centroid<3>},
    };
    return table;
  }

  const Rule &find_rule(const std::string &name, const std::string &key)
  {
    std::vector<std::string> known;
    std::string list;
    for (const std::vector<Rule> *table : {&rules(), &rules_on_request()})
      for (const Rule &rule : *table)
      {
        if (base::to_lower(rule.name) == base::to_lower(name))
          return rule;
        known.push_back(rule.name);
        list += (list.empty() ? "" : ", ") + rule.name;
      }
    throw InputError(key + " '" + name + "' is not known; choose one of " + list +
                     base::did_you_mean(name, known));
  }
} // namespace plumbline::meshfree
