#pragma once

#include "uq/sample_points.h"

#include <functional>

namespace plumbline::uq
{
  /// Calls f(factor, excess) for each tensor product of Smolyak's combination: excess[d] + 1 is the
  /// level of variable d. Fan et al. 2022, eq. (3.8).
  void
  for_each_smolyak_term(std::size_t n_variables, unsigned int level,
                        const std::function<void(double, const std::vector<unsigned int> &)> &f);

  /// The rule of one variable at a level, see Growth.
  LineRule line_rule(Law law, Growth growth, unsigned int level);
} // namespace plumbline::uq
