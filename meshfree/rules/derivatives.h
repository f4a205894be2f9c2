#pragma once

#include "meshfree/rules/quadrature_rule.h"

#include <string>

namespace plumbline::meshfree
{
  /// The local limit -Σ_p M_p/p! ∂^p, M_p = ∫ C ξ^p, 1 <= |p| <= 2, with derivatives at a node that
  /// are a weighted least-squares fit of degree 2 to the values u_j of the family and the node's
  /// own value, min Σ ω_j (P(ξ_j) - u_j)². The coefficients c = w C are ω_j times a polynomial of
  /// degree 2 in ξ_j such that Σ c ξ^n = M_n, 1 <= |n| <= 2, and Σ c = 0 with the node's own. They
  /// depend on the kernel through M_p, and on where it vanishes.
  /// @param name  of the rule, for messages
  /// @param bond  to a candidate, weight 0: none
  /// @param omega  > 0 for all bonds and for the node itself, at ξ = 0
  /// @throws InputError  a bond tensor: derivatives of vectors make coefficients that are no
  /// multiples of n⊗n
  template <int dim>
  NeighbourhoodQuadrature<dim> fitted_derivatives(const std::string &name,
                                                  const Kernel<dim> &kernel,
                                                  decltype(NeighbourhoodQuadrature<dim>::bond) bond,
                                                  std::function<double(const Bond<dim> &)> omega);
} // namespace plumbline::meshfree
