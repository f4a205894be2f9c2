#include "meshfree/rules/derivatives.h"

#include "base/error.h"
#include "meshfree/rules/moments.h"

#include <utility>

namespace plumbline::meshfree
{
  template <int dim>
  NeighbourhoodQuadrature<dim> fitted_derivatives(const std::string &name,
                                                  const Kernel<dim> &kernel,
                                                  decltype(NeighbourhoodQuadrature<dim>::bond) bond,
                                                  std::function<double(const Bond<dim> &)> omega)
  {
    if (kernel.n_components() > 1)
      throw InputError(name +
                       " has weights for scalar kernels only: fitted derivatives of a "
                       "vector field do not give forces along the bonds; use GFD or IPA-AC-R2");
    // c = ω times a polynomial with these conditions is the c of least Σ c²/ω that meets them
    const auto conditions_of = [&](std::vector<Exponents<dim>> (*select)(int, int))
    {
      MomentConditions<dim> conditions = kernel_conditions<dim>(kernel, 2, select);
      conditions.exponents.insert(conditions.exponents.begin(), Exponents<dim>{});
      conditions.moments.insert(conditions.moments.begin(), 0.);
      conditions.factor = [](const Bond<dim> &) { return 1.; };
      conditions.scale = omega;
      return conditions;
    };
    // on a lattice symmetry meets the odd moments, which need not be independent there
    const auto even = conditions_of(even_exponents<dim>), all = conditions_of(exponents<dim>);
    return {std::move(bond), [kernel, even, all](Family<dim> &family)
            {
              for (Bond<dim> &bond : family.bonds)
                bond.weight = 0;
              family.bonds.push_back({{}, 0, {}, family.own_area});
              meet(family.neighbours.empty() ? even : all, family);
              family.bonds.pop_back(); // it multiplies u - u in L_h u
              for (Bond<dim> &bond : family.bonds)
                bond.weight /= radial_value(kernel, bond);
            }};
  }

#define PLUMBLINE_INSTANTIATE(dim)                                                                 \
  template NeighbourhoodQuadrature<dim> fitted_derivatives(                                        \
      const std::string &, const Kernel<dim> &, decltype(NeighbourhoodQuadrature<dim>::bond),      \
      std::function<double(const Bond<dim> &)>);
  PLUMBLINE_INSTANTIATE(2)
  PLUMBLINE_INSTANTIATE(3)
#undef PLUMBLINE_INSTANTIATE
} // namespace plumbline::meshfree
