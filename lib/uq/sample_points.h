#pragma once

#include "uq/line_rule.h"

namespace plumbline::uq
{
  /// Where samples are taken.
  enum class SampleRule
  {
    none,
    tensor, ///< Gauss points in each variable
    smolyak,
    monte_carlo,
    quasi_monte_carlo, ///< Sobol's points
    equidistant,       ///< from end to end of uniform variables, to see how results depend on them
    chebyshev          ///< tensor products of Chebyshev points of uniform variables
  };

  /// How many points a variable has at level l = 1, 2, ... of Smolyak's rule.
  enum class Growth
  {
    linear,   ///< l Gauss points
    odd,      ///< 2 l - 1 Gauss points, the middle one always among them
    doubling, ///< 2^l - 1 Gauss points
    nested    ///< each among the next: 1, 3, 5, 9, ... points of Clenshaw and Curtis for uniform
              ///< laws, 1, 3, 9, 19, 35 of Genz and Keister for normal ones
  };

  /// Points in the space of standard variables, with weights that sum to 1: the mean of a function
  /// is the sum of its values times weights.
  struct SamplePoints
  {
    std::vector<std::vector<double>> points; ///< shape (n, n_variables)
    std::vector<double> weights;             ///< may be negative

    double sum_of_sizes() const; ///< Σ|w|, at least 1: by how much errors of samples may grow
    /// √Σw²: the mean's deviation over that of independent errors of samples.
    double noise() const;
  };

  /// The most points that the rule of one variable may have: Gauss's takes n² numbers and some
  /// 10 n³ operations, ten seconds here.
  constexpr double most_line_points = 1025;

  /// How many points a variable has at level 1, 2, ... of Smolyak's rule; 1e300 for all beyond.
  /// @pre level > 0; Growth::nested and a normal law: level <= n_genz_keister_rules
  double n_line_points(Law law, Growth growth, unsigned int level);

  /// How many points there will be, before any is made; 1e300 for all beyond. Of Smolyak's rule at
  /// most; where one variable alone has more than most_line_points, how many it has.
  /// @pre of Smolyak's rule as n_line_points, at level + 1
  double n_tensor_points(std::size_t n_variables, unsigned int n);
  double n_smolyak_points(const std::vector<Law> &laws, unsigned int level, Growth growth);

  /// All combinations of n Gauss points each.
  /// @pre n <= most_line_points
  SamplePoints tensor_points(const std::vector<Law> &laws, unsigned int n);

  /// All combinations of n Chebyshev points each of uniform variables, see fejer_rule.
  /// @pre 0 < n <= most_line_points
  SamplePoints chebyshev_points(std::size_t n_variables, unsigned int n);

  /// All combinations of n equidistant values each of uniform variables, both ends among them, with
  /// the weights of the trapezoidal rule; the middle where n = 1.
  /// @pre 0 < n <= most_line_points
  SamplePoints equidistant_points(std::size_t n_variables, unsigned int n);

  /// Smolyak's combination of tensor products, of levels whose sum exceeds their number by at most
  /// `level`: exact for polynomials of total degree 2 level + 1 with Gauss points. Points are
  /// sorted; points that come twice are one, and none where their weights cancel.
  /// Source: Wasilkowski & Wozniakowski 1995, doi:10.1006/jcom.1995.1001; Fan et al. 2022,
  /// doi:10.1016/j.cma.2022.115340, eq. (3.8), ζ - N being the level.
  /// @pre Growth::nested and a normal law: level < n_genz_keister_rules; no variable has more than
  /// most_line_points
  SamplePoints smolyak_points(const std::vector<Law> &laws, unsigned int level, Growth growth);

  /// Independent samples by Generator(seed), point by point. The first ones of more are the same.
  SamplePoints monte_carlo_points(const std::vector<Law> &laws, std::size_t n, std::uint64_t seed);

  /// Sobol's points without the first, the origin, through the inverse distribution. The first ones
  /// of more are the same.
  /// Source: Joe & Kuo 2008, doi:10.1137/070709359, by Boost.
  SamplePoints quasi_monte_carlo_points(const std::vector<Law> &laws, std::size_t n);
} // namespace plumbline::uq

namespace plumbline::base
{
  template <>
  inline constexpr auto words<uq::SampleRule> = std::array{
      "none", "tensor", "Smolyak", "Monte Carlo", "quasi-Monte Carlo", "equidistant", "Chebyshev"};
  template <>
  inline constexpr auto words<uq::Growth> = std::array{"linear", "odd", "doubling", "nested"};
} // namespace plumbline::base
