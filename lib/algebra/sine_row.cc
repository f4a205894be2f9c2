#include "algebra/sine_row.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    /// More nodes than these on either side of a row cost more iterations than any length saves.
    constexpr int most_around = 24;

    /// Conjugate gradients' iterations where nodes are constrained, 3 to 4: waves reflected half a
    /// reach away meet no free node, each node more costs some.
    double iterations_held(int n_more)
    {
      return 3 + .4 * std::log(1 + .5 * n_more);
    }

    /// The same where the zeros alone act, in steps from the outermost node: fewest where a volume
    /// constraint acts as a zero, 1.3 times that at 4/3 of this distance, 1.9 times at twice or
    /// half of it (constant, linear and 1/r kernels, m = 1.5 to 20).
    double iterations_by_zeros(double distance, int reach)
    {
      const double best = .8 + .2 * reach;
      return 8 + 10 * std::abs(std::log(distance / best));
    }

    /// An iteration with a transform of this length; the operator, the nodes that are constrained
    /// and the vectors of conjugate gradients take as long as one transform at m = 3.
    double iteration_time(int length)
    {
      return 1 + length_penalty(length);
    }
  } // namespace

  double length_penalty(int length)
  {
    constexpr int with_code = 13;
    constexpr double of_factor = .02, of_root = .17, of_eleven = 1.3;
    const double least = length % 11 == 0 ? of_eleven : 1;
    int largest = 1;
    for (int factor = 2; length > 1; ++factor)
      while (length % factor == 0)
      {
        largest = factor;
        length /= factor;
      }
    return largest <= with_code ? least
                                : 1 + std::min(of_factor * largest, of_root * std::sqrt(largest));
  }

  int nodes_to_hold(int reach, unsigned int n_components)
  {
    constexpr int longest_reach = 13; // beyond it holding takes as much time as it saves
    if (reach > longest_reach)
      return 0;
    return n_components > 1 ? 1 : std::min((reach + 3) / 2, most_constrained);
  }

  SineRow fast_sine_row(int n, int reach, int n_constrained)
  {
    const int fewest = std::max(n_constrained, 1);
    int best = 0;
    double least = 0;
    for (int more = 0; more <= 2 * (most_around - fewest); ++more)
    {
      const double iterations = n_constrained > 0
                                    ? iterations_held(more)
                                    : iterations_by_zeros(fewest + .5 * more + .5, reach);
      const double time = iterations * iteration_time(n + 2 * fewest + more);
      if (more == 0 || time < least)
      {
        best = more;
        least = time;
      }
    }
    const int n_before = fewest + best / 2, n_after = fewest + (best + 1) / 2;
    return {n_before + n + n_after, n_before, n_after, n_constrained};
  }
} // namespace plumbline::algebra
