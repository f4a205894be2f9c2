#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// Scalar kernels: the moments of C(kernel_point) ξ^α. Tensors: the entries n_a n_b ξ^α are
    /// ξ^β / |ξ|², |β| = |α| + 2.
    /// @param select  which exponents of a range of degrees
    MomentConditions moment_conditions(const Kernel<2> &kernel, unsigned int degree,
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
      return conditions;
    }

    /// The moments of C_ab ξ^α up to a degree, C taken at the kernel point, ξ to the node.
    /// @param is_even  those that symmetry does not meet
    MomentConditions entry_conditions(const Kernel<2> &kernel, unsigned int degree, bool is_even)
    {
      struct Entry
      {
        unsigned int a, b;
      };
      const double horizon = kernel.horizon();
      MomentConditions conditions{degree, horizon, {}, {}, {}, {}};
      std::vector<Entry> entries;
      for (const Exponents &alpha : exponents(1, static_cast<int>(degree)))
        for (const auto &[a, b] : {Entry{0, 0}, Entry{0, 1}, Entry{1, 1}})
        {
          Exponents parity = alpha;
          ++parity[a];
          ++parity[b];
          if (is_even && (parity[0] % 2 != 0 || parity[1] % 2 != 0))
            continue;
          conditions.exponents.push_back(alpha);
          conditions.moments.push_back(kernel.moment(alpha, a, b) /
                                       std::pow(horizon, alpha[0] + alpha[1]));
          entries.push_back({a, b});
        }
      conditions.factor = [kernel](const Bond &bond) { return radial_value(kernel, bond); };
      conditions.own_factor = [kernel, entries](const Bond &bond, std::size_t i)
      { return kernel.direction_factor(entries[i].a, entries[i].b, bond.kernel_point); };
      conditions.scale = [](const Bond &bond) { return bond.area; };
      return conditions;
    }
  } // namespace

  NeighbourhoodQuadrature recalibrated(const Kernel<2> &kernel, unsigned int degree)
  {
    // on a lattice symmetry meets the odd moments, which need not be independent there
    const auto even = moment_conditions(kernel, degree, even_exponents),
               all = moment_conditions(kernel, degree, exponents);
    return {kernel.n_components() > 1 ? partial_area_bond : centroid_bond,
            [even, all](Family &family) { meet(family.neighbours.empty() ? even : all, family); }};
  }

  NeighbourhoodQuadrature recalibrated_at_centroid(const Kernel<2> &kernel)
  {
    if (kernel.n_components() == 1)
      return recalibrated(kernel, 2);
    const auto even = entry_conditions(kernel, 2, true), all = entry_conditions(kernel, 2, false);
    return {centroid_bond,
            [even, all](Family &family) { meet(family.neighbours.empty() ? even : all, family); }};
  }
} // namespace plumbline::meshfree
