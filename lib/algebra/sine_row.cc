#include "algebra/sine_row.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    /// Longer rows than this, on either side, cost more iterations than any length saves.
    constexpr int most_around = 24;

    /// Iterations over the fewest: 1.3 where the zero is at 4/3 of the best distance, 1.9 at twice
    /// or half of it (measured at m = 3 and 8).
    double iterations(double distance, double best)
    {
      return 1 + 1.25 * std::abs(std::log(distance / best));
    }

    /// An iteration with a transform of this length; the operator and the vectors of conjugate
    /// gradients take as long as .7 transforms at m = 3.
    double iteration_time(double transform)
    {
      return .7 + transform;
    }
  } // namespace

  double best_zero(int reach)
  {
    return reach <= 1 ? 1 : .8 + .2 * reach;
  }

  double length_penalty(int length)
  {
    constexpr int with_code = 13;
    constexpr double of_root = .17;
    int largest = 1;
    for (int factor = 2; length > 1; ++factor)
      while (length % factor == 0)
      {
        largest = factor;
        length /= factor;
      }
    return largest <= with_code ? 1 : 1 + of_root * std::sqrt(largest);
  }

  SineRow fast_sine_row(int n, double best, bool is_exact)
  {
    constexpr double of_nodes = 1.3, of_odd = 2; // DST-I over DST-II; FFTW doubles odd lengths
    constexpr double exact_over_few = .1;        // 1 iteration instead of 9
    SineRow choice;
    double least = 0;
    for (int around = 0; around <= most_around; ++around)
      for (const bool is_zero_between : {false, true})
      {
        const SineRow row{n + 2 * around, around, is_zero_between};
        const int length = row.period() / 2;
        const double transform = length_penalty(length) * (is_zero_between   ? 1
                                                           : length % 2 == 0 ? of_nodes
                                                                             : of_odd);
        double time = iterations(row.distance(), best) * iteration_time(transform);
        if (is_exact && row.distance() == best)
          time *= exact_over_few;
        if (choice.n == 0 || time < least)
        {
          choice = row;
          least = time;
        }
      }
    return choice;
  }

  int fast_cells_around(int n, double best)
  {
    int choice = 0;
    double least = 0;
    for (int around = 0; around <= most_around; ++around)
    {
      const double time =
          iterations(around + .5, best) * iteration_time(length_penalty(n + 2 * around));
      if (around == 0 || time < least)
      {
        choice = around;
        least = time;
      }
    }
    return choice;
  }
} // namespace plumbline::algebra
