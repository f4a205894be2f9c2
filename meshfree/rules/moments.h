#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// Exponents of a monomial.
  template <int dim>
  using Exponents = std::array<int, dim>;

  /// All exponents α with lowest <= |α| <= highest.
  template <int dim>
  std::vector<Exponents<dim>> exponents(int lowest, int highest);

  /// Those of them that are even along each axis: for families that are symmetric.
  template <int dim>
  std::vector<Exponents<dim>> even_exponents(int lowest, int highest);

  /// What exact moments ask of the weights of a family: Σ_j g_j s_j^α w_j = moment_α with s =
  /// ξ/δ.
  template <int dim>
  struct MomentConditions
  {
    unsigned int degree = 0; ///< of what is integrated exactly
    double horizon = 0;
    std::vector<Exponents<dim>> exponents; ///< α
    std::vector<double> moments;
    std::function<double(const Bond<dim> &)> factor; ///< g
    std::function<double(const Bond<dim> &)> scale;  ///< ω > 0
    /// Of condition i, multiplies g; empty: 1.
    std::function<double(const Bond<dim> &, std::size_t i)> own_factor = {};
  };

  /// Change the weights as little as possible, min Σ (w - w_before)²/ω, so that they meet the
  /// conditions, and say in family.fit how well they do. Rank-revealing: conditions that depend on
  /// others to 1e-7 are left out, and met if they are consistent.
  template <int dim>
  void meet(const MomentConditions<dim> &conditions, Family<dim> &family);
} // namespace plumbline::meshfree
