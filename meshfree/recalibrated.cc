#include "meshfree/moments.h"
#include "meshfree/rules.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// Scalar kernels: the moments of C(kernel_point) ξ^α. Tensors: the entries n_a n_b ξ^α are
    /// ξ^β / |ξ|², |β| = |α| + 2.
    /// @param select  which exponents of a range of degrees
    Recipe recipe(const Kernel<2> &kernel, unsigned int degree,
                  std::vector<Exponents> (*select)(int lowest, int highest))
    {
      const bool is_tensor = kernel.n_components() > 1;
      const double horizon = kernel.horizon();
      const int raise = is_tensor ? 2 : 0;
      MomentConditions conditions{
          degree, horizon, select(1 + raise, static_cast<int>(degree) + raise), {}, {}, {}};
      for (const Exponents &beta : conditions.exponents)
      {
        Exponents alpha = beta;
        const unsigned int a = beta[0] > 0 ? 0 : 1, b = beta[a] > 1 ? a : 1 - a;
        if (is_tensor)
        {
          --alpha[a];
          --alpha[b];
        }
        conditions.moments.push_back(
            (is_tensor ? kernel.moment(alpha, a, b) : kernel.moment(alpha)) /
            std::pow(horizon, alpha[0] + alpha[1]));
      }
      conditions.factor = [kernel, is_tensor](const Bond &bond)
      {
        const double scale = kernel.horizon() * kernel.horizon() / bond.xi.square();
        return radial_value(kernel, bond) * (is_tensor ? scale : 1);
      };
      conditions.scale = [](const Bond &bond) { return bond.area; };
      return {is_tensor ? partial_area_bond : centroid_bond,
              [conditions](Family &family) { meet(conditions, family); }};
    }
  } // namespace

  Bonds recalibrated(const Kernel<2> &kernel, double h, Backend backend, unsigned int degree)
  {
    return lattice_bonds(recipe(kernel, degree, even_exponents), kernel, h, backend);
  }

  Families recalibrated(const Kernel<2> &kernel, const NodeCells &cells, Backend backend,
                        unsigned int degree)
  {
    return {recipe(kernel, degree, exponents), kernel, cells, backend};
  }
} // namespace plumbline::meshfree
