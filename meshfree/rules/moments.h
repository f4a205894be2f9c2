#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// Exponents of a monomial.
  using Exponents = std::array<int, 2>;

  /// All exponents (a, b) with lowest <= a + b <= highest.
  std::vector<Exponents> exponents(int lowest, int highest);

  /// Those of them with a and b even: for families that are symmetric.
  std::vector<Exponents> even_exponents(int lowest, int highest);

  /// What exact moments ask of the weights of a family: Σ_j g_j s_j^α w_j = moment_α with s =
  /// ξ/δ.
  struct MomentConditions
  {
    unsigned int degree = 0; ///< of what is integrated exactly
    double horizon = 0;
    std::vector<Exponents> exponents; ///< α
    std::vector<double> moments;
    std::function<double(const Bond &)> factor; ///< g
    std::function<double(const Bond &)> scale;  ///< ω > 0
    /// Of condition i, multiplies g; empty: 1.
    std::function<double(const Bond &, std::size_t i)> own_factor = {};
  };

  /// Change the weights as little as possible, min Σ (w - w_before)²/ω, so that they meet the
  /// conditions, and say in family.fit how well they do. Rank-revealing: conditions that depend on
  /// others to 1e-7 are left out, and met if they are consistent.
  void meet(const MomentConditions &conditions, Family &family);
} // namespace plumbline::meshfree
