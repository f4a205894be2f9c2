#pragma once

#include "uq/variable.h"

#include <vector>

namespace plumbline::uq
{
  /// A rule for the mean of a function of one standard variable. Weights sum to 1; nodes rise, and
  /// are symmetric to the last bit, the middle one being 0.
  struct LineRule
  {
    std::vector<double> nodes, weights;
  };

  /// Gauss's rule of n points for the density of a law (Hermite, Legendre), exact for polynomials
  /// of degree 2n - 1; nodes and weights to 1e-14. Weights below 1e-15 of a normal law's have no
  /// digits that are right.
  /// Source: Golub & Welsch 1969, doi:10.1090/S0025-5718-69-99647-1.
  /// @pre n > 0
  LineRule gauss_rule(Law law, unsigned int n);

  /// Clenshaw and Curtis's rule of n points on [-1, 1] for the uniform law, exact for degree n - 1;
  /// the points of 2n - 1 hold those of n. All weights are positive.
  /// Source: Waldvogel 2006, doi:10.1007/s10543-006-0045-4, section 2.
  /// @pre n odd
  LineRule clenshaw_curtis_rule(unsigned int n);

  /// Fejér's first rule of n points on [-1, 1] for the uniform law: the roots of Chebyshev's
  /// polynomial T_n, exact for degree n - 1. All weights are positive. The Lebesgue constant of
  /// these points is at most 2/π log(n + 1) + 1.
  /// Source: Waldvogel 2006, doi:10.1007/s10543-006-0045-4, section 2.
  /// @pre n > 0
  LineRule fejer_rule(unsigned int n);

  constexpr unsigned int n_genz_keister_rules = 5;

  /// Genz and Keister's rules of 1, 3, 9, 19 and 35 points for the normal law, exact for degree 1,
  /// 5, 15, 29 and 51; the points of each hold those before. Some weights of 19 points are
  /// negative.
  /// Found from their definition: each is the one before with as few points added as reach that
  /// degree, roots of the polynomial E with ∫ P E q = 0 for all q of smaller degree, P being that
  /// of the points before. Means of powers to 1e-13 of their parts, of 35 points to 1e-11.
  /// Source: Genz & Keister 1996, doi:10.1016/0377-0427(95)00232-4.
  /// @pre 1 <= level <= n_genz_keister_rules
  LineRule genz_keister_rule(unsigned int level);
} // namespace plumbline::uq
