#pragma once

#include "random/variable.h"

#include <vector>

namespace plumbline::random
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
} // namespace plumbline::random
