#include "physics/solid_bounds.h"

#include <algorithm>
#include <cmath>

namespace plumbline::physics
{
  void LameBounds::add(const Lame &one)
  {
    least = {std::min(least.lambda, one.lambda), std::min(least.mu, one.mu)};
    largest = {std::max(largest.lambda, one.lambda), std::max(largest.mu, one.mu)};
  }

  Assumption1 assumption_1(const LameBounds &bounds)
  {
    const double root = std::sqrt(bounds.largest.mu) +
                        (bounds.largest.lambda - bounds.least.lambda) / std::sqrt(bounds.least.mu);
    return {8 * bounds.largest.lambda, root * root};
  }
} // namespace plumbline::physics
