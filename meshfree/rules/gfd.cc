#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// The coefficients c = w C of least Σ c²/(A g), g = exp(-(2r/δ)²): c = A g times a polynomial.
    template <int dim>
    MomentConditions<dim> conditions_of(const Kernel<dim> &kernel,
                                        std::vector<Exponents<dim>> (*select)(int lowest,
                                                                              int highest))
    {
      constexpr unsigned int degree = 2;
      MomentConditions<dim> conditions = kernel_conditions<dim>(kernel, degree, select);
      conditions.scale = [kernel](const Bond<dim> &bond)
      {
        const double C = radial_value(kernel, bond);
        return bond.area * gaussian(kernel, bond) / (C * C);
      };
      return conditions;
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> generalised_finite_differences(const Kernel<dim> &kernel)
  {
    // on a lattice symmetry meets the odd moments, which need not be independent there
    const auto even = conditions_of(kernel, even_exponents<dim>),
               all = conditions_of(kernel, exponents<dim>);
    return {coefficient_bond<dim>, [even, all](Family<dim> &family)
            {
              for (Bond<dim> &bond : family.bonds)
                bond.weight = 0;
              meet(family.neighbours.empty() ? even : all, family);
            }};
  }

  template NeighbourhoodQuadrature<2> generalised_finite_differences(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> generalised_finite_differences(const Kernel<3> &);
} // namespace plumbline::meshfree
