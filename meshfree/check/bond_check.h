#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// A value and where it is found.
  struct Worst
  {
    double value = 0;
    std::size_t node = 0;
  };

  /// How far sums Σ w C_ab(kernel_point) ξ^α over the families are from ∫ C_ab(ξ) ξ^α dξ, the
  /// largest over |α| = degree and a, b, relative to ∫ |C| |ξ|^degree; of degree 2 relative to the
  /// largest exact moment ∫ C_11 ξ_1², as in what `run` says of a method's moments.
  struct MomentDefect
  {
    int degree = 0;
    Worst worst;
    double median = 0;
    std::vector<double> values = {}; ///< of each node
  };

  /// ∫ |C| |ξ|^degree over the ball, where |C| is the radial factor's.
  template <int dim>
  double kernel_size(const Kernel<dim> &kernel, int degree);

  /// The moments of families, which decide what their operator tends to.
  struct MomentCheck
  {
    static constexpr double tolerance = 1e-8; ///< for moments to count as exact

    std::vector<MomentDefect> defects; ///< of degrees 1 to `highest`, see check_moments
    /// Polynomials up to this degree are mapped as by the nonlocal operator.
    int exact_degree = 0;
    /// Mean over the families of the ratio of Σ w tr C |ξ|² to its exact value.
    double mean_ratio = 1;
    /// Second-moment defect: the defect of degree 2, or |ratio - 1| where that is larger. Both are
    /// the same for scalars where all directions are alike.
    Worst second;
    std::vector<double> ratios, second_defects; ///< of each node: what mean_ratio and second are of

    bool is_first_exact() const { return defects[0].worst.value < tolerance; }
    bool is_second_exact() const { return second.value < tolerance; }

    /// Of most nodes: the median of the larger of the defects of degree 1 and 2.
    double typical() const;
  };

  /// @param highest  degree of the moments, at least 2
  /// @throws InputError  the kernel's second moment is 0: there is no local limit
  template <int dim>
  MomentCheck check_moments(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                            int highest = 4);

  struct WeightCheck
  {
    std::size_t n_bonds = 0, n_negative = 0;
    unsigned int largest_family = 0;
    Worst area; ///< |Σ w - (ball - own volume)| relative to the ball
    double smallest_ratio = 0, largest_ratio = 0; ///< of weights to the neighbours' volumes
  };

  /// @param volumes  of the free nodes, shape (n_families)
  template <int dim>
  WeightCheck check_weights(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                            const std::vector<double> &volumes);

  /// Pairs of free nodes seen from both ends.
  struct SymmetryCheck
  {
    double asymmetry = 0; ///< largest |w_ij C(q_ij) - w_ji C(q_ji)| relative to the largest |w C|
    /// Largest |V_i w_ij C(q_ij) - V_j w_ji C(q_ji)| relative to the largest |V w C|: 0 where the
    /// forces of a pair balance.
    double imbalance = 0;
    std::array<std::size_t, 2> nodes{}; ///< of that pair
    std::size_t n_unpaired = 0;         ///< bonds i to j without one from j to i
  };

  /// @param volumes  of the free nodes, shape (n_families)
  template <int dim>
  SymmetryCheck check_symmetry(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                               const std::vector<double> &volumes);
} // namespace plumbline::meshfree
