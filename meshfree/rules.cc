#include "meshfree/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    template <unsigned int degree>
    Bonds recalibrated_to(const Kernel<2> &kernel, double h, Backend backend)
    {
      return recalibrated(kernel, h, backend, degree);
    }

    template <unsigned int degree>
    Families recalibrated_to(const Kernel<2> &kernel, const NodeCells &cells, Backend backend)
    {
      return recalibrated(kernel, cells, backend, degree);
    }
  } // namespace

  const std::vector<Rule> &rules()
  {
    static const std::vector<Rule> table = {
        {"FA", "full area of cells whose node is in the ball", full_area, full_area},
        {"LAMMPS", "full area with a ramp inside the horizon", lammps, lammps},
        {"QWJ", "full area with a ramp across the horizon", qwj, qwj},
        {"PA-AC", "exact partial areas, kernel at the node", partial_area, partial_area},
        {"IPA-AC", "exact partial areas, kernel at the centroid", improved_partial_area,
         improved_partial_area},
        {"IPA-AC-R2", "IPA-AC recalibrated to exact moments of degree 2", recalibrated_to<2>,
         recalibrated_to<2>},
        {"IPA-AC-R4", "IPA-AC recalibrated to exact moments of degree 4", recalibrated_to<4>,
         recalibrated_to<4>},
        {"OPT", "optimisation-based quadrature weights", optimisation_based, optimisation_based},
    };
    return table;
  }
} // namespace plumbline::meshfree
