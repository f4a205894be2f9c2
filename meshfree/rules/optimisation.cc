#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// ∫ s^α / |s|³ over the unit ball.
    template <std::size_t dim>
    double exact_integral(const std::array<int, dim> &alpha)
    {
      double product = 2;
      int order = 0;
      for (const int one : alpha)
      {
        if (one % 2 != 0)
          return 0;
        product *= std::tgamma(.5 * (one + 1));
        order += one;
      }
      const auto n = static_cast<int>(dim);
      return product / std::tgamma(.5 * (order + n)) / (order + n - 3);
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> optimisation_based(const Kernel<dim> &kernel)
  {
    const double horizon = kernel.horizon();
    MomentConditions<dim> conditions{5, horizon, exponents<dim>(2, 5), {}, {}, {}};
    double scale = 1;
    for (int d = 0; d < dim; ++d)
      scale *= horizon;
    for (const Exponents<dim> &alpha : conditions.exponents)
      conditions.moments.push_back(scale * exact_integral(alpha));
    conditions.factor = [horizon](const Bond<dim> &bond)
    {
      const double inverse = horizon / bond.xi.norm();
      return inverse * inverse * inverse;
    };
    conditions.scale = [](const Bond<dim> &) { return 1.; };
    return {full_area_bond<dim>, [conditions](Family<dim> &family)
            {
              for (Bond<dim> &bond : family.bonds)
                bond.weight = 0;
              meet(conditions, family);
            }};
  }

  template NeighbourhoodQuadrature<2> optimisation_based(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> optimisation_based(const Kernel<3> &);
} // namespace plumbline::meshfree
