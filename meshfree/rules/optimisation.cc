#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// ∫ s1^a s2^b / |s|³ over the unit disc.
    double exact_integral(int a, int b)
    {
      if (a % 2 != 0 || b % 2 != 0)
        return 0;
      return 2 * std::tgamma(.5 * (a + 1)) * std::tgamma(.5 * (b + 1)) /
             std::tgamma(.5 * (a + b + 2)) / (a + b - 1);
    }
  } // namespace

  NeighbourhoodQuadrature optimisation_based(const Kernel<2> &kernel)
  {
    const double horizon = kernel.horizon();
    MomentConditions conditions{5, horizon, exponents(2, 5), {}, {}, {}};
    for (const auto &[a, b] : conditions.exponents)
      conditions.moments.push_back(horizon * horizon * exact_integral(a, b));
    conditions.factor = [horizon](const Bond &bond)
    {
      const double inverse = horizon / bond.xi.norm();
      return inverse * inverse * inverse;
    };
    conditions.scale = [](const Bond &) { return 1.; };
    return {full_area_bond, [conditions](Family &family)
            {
              for (Bond &bond : family.bonds)
                bond.weight = 0;
              meet(conditions, family);
            }};
  }
} // namespace plumbline::meshfree
