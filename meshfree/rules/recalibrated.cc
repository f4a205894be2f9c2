#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    template <std::size_t dim>
    int order(const std::array<int, dim> &alpha)
    {
      return std::accumulate(alpha.begin(), alpha.end(), 0);
    }

    /// The axes of the first two factors of a monomial of degree 2 or more.
    template <std::size_t dim>
    std::array<unsigned int, 2> first_two(const std::array<int, dim> &beta)
    {
      std::array<unsigned int, 2> axes{};
      unsigned int n = 0;
      for (unsigned int d = 0; d < dim; ++d)
        for (int k = 0; k < beta[d] && n < 2; ++k)
          axes[n++] = d;
      return axes;
    }

    /// Scalar kernels: the moments of C(kernel_point) ξ^α. Tensors: the entries n_a n_b ξ^α are
    /// ξ^β / |ξ|², |β| = |α| + 2.
    /// @param select  which exponents of a range of degrees
    template <int dim>
    MomentConditions<dim> moment_conditions(const Kernel<dim> &kernel, unsigned int degree,
                                            std::vector<Exponents<dim>> (*select)(int lowest,
                                                                                  int highest))
    {
      const bool is_tensor = kernel.n_components() > 1;
      const double horizon = kernel.horizon();
      const int raise = is_tensor ? 2 : 0;
      MomentConditions<dim> conditions{
          degree, horizon, select(1 + raise, static_cast<int>(degree) + raise), {}, {}, {}};
      for (const Exponents<dim> &beta : conditions.exponents)
      {
        Exponents<dim> alpha = beta;
        const auto [a, b] = first_two(beta);
        if (is_tensor)
        {
          --alpha[a];
          --alpha[b];
        }
        conditions.moments.push_back(
            (is_tensor ? kernel.moment(alpha, a, b) : kernel.moment(alpha)) /
            std::pow(horizon, order(alpha)));
      }
      conditions.factor = [kernel, is_tensor](const Bond<dim> &bond)
      {
        const double scale = kernel.horizon() * kernel.horizon() / bond.xi.square();
        return radial_value(kernel, bond) * (is_tensor ? scale : 1);
      };
      conditions.scale = [](const Bond<dim> &bond) { return bond.area; };
      return conditions;
    }

    /// The moments of C_ab ξ^α up to a degree, C taken at the kernel point, ξ to the node.
    /// @param is_even  those that symmetry does not meet
    template <int dim>
    MomentConditions<dim> entry_conditions(const Kernel<dim> &kernel, unsigned int degree,
                                           bool is_even)
    {
      struct Entry
      {
        unsigned int a, b;
      };
      const double horizon = kernel.horizon();
      MomentConditions<dim> conditions{degree, horizon, {}, {}, {}, {}};
      std::vector<Entry> entries;
      for (const Exponents<dim> &alpha : exponents<dim>(1, static_cast<int>(degree)))
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a; b < dim; ++b)
          {
            Exponents<dim> parity = alpha;
            ++parity[a];
            ++parity[b];
            if (is_even &&
                std::any_of(parity.begin(), parity.end(), [](int one) { return one % 2 != 0; }))
              continue;
            conditions.exponents.push_back(alpha);
            conditions.moments.push_back(kernel.moment(alpha, a, b) /
                                         std::pow(horizon, order(alpha)));
            entries.push_back({a, b});
          }
      conditions.factor = [kernel](const Bond<dim> &bond) { return radial_value(kernel, bond); };
      conditions.own_factor = [kernel, entries](const Bond<dim> &bond, std::size_t i)
      { return kernel.direction_factor(entries[i].a, entries[i].b, bond.kernel_point); };
      conditions.scale = [](const Bond<dim> &bond) { return bond.area; };
      return conditions;
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> recalibrated(const Kernel<dim> &kernel, unsigned int degree)
  {
    // on a lattice symmetry meets the odd moments, which need not be independent there
    const auto even = moment_conditions(kernel, degree, even_exponents<dim>),
               all = moment_conditions(kernel, degree, exponents<dim>);
    return {kernel.n_components() > 1 ? partial_area_bond<dim> : centroid_bond<dim>,
            [even, all](Family<dim> &family)
            { meet(family.neighbours.empty() ? even : all, family); }};
  }

  template <int dim>
  NeighbourhoodQuadrature<dim> recalibrated_at_centroid(const Kernel<dim> &kernel)
  {
    if (kernel.n_components() == 1)
      return recalibrated(kernel, 2);
    const auto even = entry_conditions(kernel, 2, true), all = entry_conditions(kernel, 2, false);
    return {centroid_bond<dim>, [even, all](Family<dim> &family)
            { meet(family.neighbours.empty() ? even : all, family); }};
  }

  template NeighbourhoodQuadrature<2> recalibrated(const Kernel<2> &, unsigned int);
  template NeighbourhoodQuadrature<2> recalibrated_at_centroid(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> recalibrated(const Kernel<3> &, unsigned int);
  template NeighbourhoodQuadrature<3> recalibrated_at_centroid(const Kernel<3> &);
} // namespace plumbline::meshfree
