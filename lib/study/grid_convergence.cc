#include "study/grid_convergence.h"

#include "study/trend.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    double rms_of_difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> difference;
      for (std::size_t i = 0; i < a.size(); ++i)
        difference.push_back(a[i] - b[i]);
      return root_mean_square(difference);
    }
  } // namespace

  double root_mean_square(const std::vector<double> &values)
  {
    double squares = 0;
    for (const double value : values)
      squares += value * value / static_cast<double>(values.size());
    return std::sqrt(squares);
  }

  GridConvergence grid_convergence(const std::vector<double> &h,
                                   const std::vector<std::vector<double>> &values, double most)
  {
    GridConvergence found;
    const std::size_t n = h.size();
    if (n >= 2)
      found.last_change = rms_of_difference(values[n - 1], values[n - 2]);
    if (n < 3)
      return found;
    const std::vector<double> x = {h[n - 3], h[n - 2]};
    const double before = rms_of_difference(values[n - 1], values[n - 3]);
    if (!(found.last_change > 0) || !(before > found.last_change) || !std::isfinite(before))
      return found;
    const double order = own_rate(x, {before, found.last_change}, h[n - 1]);
    if (!(std::pow(.5, order) <= slowest_contraction))
      return found;
    found.order = std::min(order, most);
    const double growth = std::pow(h[n - 2] / h[n - 1], found.order);
    for (std::size_t i = 0; i < values[n - 1].size(); ++i)
      found.correction.push_back((values[n - 1][i] - values[n - 2][i]) / (growth - 1));
    return found;
  }
} // namespace plumbline::study
