#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
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
    const auto even = kernel_conditions(kernel, degree, even_exponents<dim>),
               all = kernel_conditions(kernel, degree, exponents<dim>);
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

  template NeighbourhoodQuadrature<1> recalibrated(const Kernel<1> &, unsigned int);
  template NeighbourhoodQuadrature<2> recalibrated(const Kernel<2> &, unsigned int);
  template NeighbourhoodQuadrature<2> recalibrated_at_centroid(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> recalibrated(const Kernel<3> &, unsigned int);
  template NeighbourhoodQuadrature<3> recalibrated_at_centroid(const Kernel<3> &);
} // namespace plumbline::meshfree
