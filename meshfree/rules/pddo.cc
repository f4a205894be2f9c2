#include "meshfree/rules/derivatives.h"
#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  // ∂^p u(x) = Σ_j g^p(ξ_j) u_j A_j, the node itself among the j, with the PD functions g^p = g
  // Σ_q a_q^p ξ^q, |q| <= 2, such that Σ_j ξ_j^n g^p(ξ_j) A_j = n! δ_np, 0 <= |n| <= 2 (Madenci,
  // Barut & Futch 2016). These are the derivatives of a fit with ω = A g.
  template <int dim>
  NeighbourhoodQuadrature<dim> peridynamic_differential_operator(const Kernel<dim> &kernel)
  {
    return fitted_derivatives<dim>("PDDO", kernel, coefficient_bond<dim>,
                                   [kernel](const Bond<dim> &bond)
                                   { return bond.area * gaussian(kernel, bond); });
  }

  template NeighbourhoodQuadrature<2> peridynamic_differential_operator(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> peridynamic_differential_operator(const Kernel<3> &);
} // namespace plumbline::meshfree
