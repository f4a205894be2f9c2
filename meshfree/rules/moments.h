#pragma once

#include "meshfree/rules/quadrature_rule.h"

#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  /// Exponents of a monomial.
  template <int dim>
  using Exponents = std::array<int, dim>;

  template <std::size_t dim>
  int order(const std::array<int, dim> &alpha)
  {
    return std::accumulate(alpha.begin(), alpha.end(), 0);
  }

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

  /// That the operator Σ_j w_j C (u_j - u) has the moments of the continuous one up to a degree.
  /// Scalar kernels: those of C ξ^α, C taken at the kernel point. Tensors: the entries n_a n_b ξ^α
  /// are ξ^β / |ξ|², |β| = |α| + 2. The scale is the area of a bond's cell.
  /// @param select  which exponents of a range of degrees
  template <int dim>
  MomentConditions<dim> kernel_conditions(const Kernel<dim> &kernel, unsigned int degree,
                                          std::vector<Exponents<dim>> (*select)(int lowest,
                                                                                int highest));

  /// A full-area bond where the kernel does not vanish, to rounding; elsewhere no weight has an
  /// effect, and there is no bond. For rules whose coefficients w C do not depend on the kernel's
  /// profile.
  template <int dim>
  Bond<dim> coefficient_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate);

  /// exp(-(2r/δ)²), the Gaussian of generalised finite differences and of the peridynamic
  /// differential operator.
  template <int dim>
  double gaussian(const Kernel<dim> &kernel, const Bond<dim> &bond)
  {
    const double s = 2 * bond.xi.norm() / kernel.horizon();
    return std::exp(-s * s);
  }

  /// Change the weights as little as possible, min Σ (w - w_before)²/ω, so that they meet the
  /// conditions, and say in family.fit how well they do. Rank-revealing: conditions that depend on
  /// others to 1e-7 are left out, and met if they are consistent.
  template <int dim>
  void meet(const MomentConditions<dim> &conditions, Family<dim> &family);
} // namespace plumbline::meshfree
