#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  const std::vector<Rule> &rules()
  {
    static const std::vector<Rule> table = {
        {"FA", "full area of cells whose node is in the ball", full_area},
        {"LAMMPS", "full area with a ramp inside the horizon", lammps},
        {"QWJ", "full area with a ramp across the horizon, also known as HHB", qwj},
        {"PA-AC", "exact partial areas, kernel at the node", partial_area},
        {"IPA-AC",
         "exact partial areas, kernel at the centroid of ball and cell ('plumbline describe "
         "Methods/names': what of each model)",
         improved_partial_area},
        {"IPA-AC-R2", "IPA-AC recalibrated to exact moments of degree 2",
         [](const Kernel<2> &kernel) { return recalibrated(kernel, 2); }},
        {"IPA-AC-R4", "IPA-AC recalibrated to exact moments of degree 4",
         [](const Kernel<2> &kernel) { return recalibrated(kernel, 4); }},
        {"OPT", "optimisation-based quadrature weights", optimisation_based},
    };
    return table;
  }

  const std::vector<Rule> &counterexamples()
  {
    static const std::vector<Rule> table = {
        {"IPA-AC-R2c", "IPA-AC-R2 with tensors at the centroid: negative weights, a counterexample",
         recalibrated_at_centroid},
    };
    return table;
  }
} // namespace plumbline::meshfree
