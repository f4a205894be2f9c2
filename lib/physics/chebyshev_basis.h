#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace plumbline::physics
{
  /// The transform from values at the n Chebyshev points cos(π (i + ½) / n) of [-1, 1] to
  /// coefficients: row-major, shape (n, n).
  inline std::vector<double> chebyshev_transform(unsigned int n)
  {
    std::vector<double> transform;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        // the angle in its first turn: after sixty of them its rounding would look like noise of
        // the function
        transform.push_back((k == 0 ? 1. : 2.) / n *
                            std::cos(M_PI * ((k * (2 * i + 1)) % (4 * n)) / (2. * n)));
    return transform;
  }

  /// Σ_k c_k T_k(s), c_k = series[k].*entry, by Clenshaw's recurrence.
  /// @param series  at least one term
  template <class Series, class Term>
  double chebyshev_sum(const Series &series, double Term::*entry, double s)
  {
    double last = 0, sum = 0;
    for (std::size_t k = series.size() - 1; k > 0; --k)
    {
      const double next = series[k].*entry + 2 * s * sum - last;
      last = sum;
      sum = next;
    }
    return series[0].*entry + s * sum - last;
  }

  /// T_0 ... T_{n-1} at a place of [-1, 1].
  inline std::vector<double> chebyshev_polynomials(double s, unsigned int n)
  {
    std::vector<double> values(n);
    for (unsigned int k = 0; k < n; ++k)
      values[k] = k == 0 ? 1 : k == 1 ? s : 2 * s * values[k - 1] - values[k - 2];
    return values;
  }
} // namespace plumbline::physics
