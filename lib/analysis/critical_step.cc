#include "analysis/critical_step.h"

#include "base/error.h"
#include "base/symmetric_eigen.h"

#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::analysis
{
  namespace
  {
    constexpr int most_steps = 5000;

    /// The largest eigenvalue of a tridiagonal matrix and its residual as one of the whole.
    std::pair<double, double> ritz(const Vector &alpha, const Vector &beta, double next)
    {
      const auto k = static_cast<Eigen::Index>(alpha.size());
      const auto eigen = base::tridiagonal_eigen(Eigen::VectorXd::Map(alpha.data(), k),
                                                 Eigen::VectorXd::Map(beta.data(), k - 1));
      return {eigen.values[k - 1], next * std::abs(eigen.vectors(k - 1, k - 1))};
    }
  } // namespace

  double largest_eigenvalue(const algebra::Action &symmetric, std::size_t n, double tolerance,
                            const Parts &parts)
  {
    const base::Communicator &ranks = parts.ranks;
    Vector before(n), now(n), next(n), alpha, beta;
    for (std::size_t i = 0; i < n; ++i) // orthogonal to no eigenvector, most likely
    {
      const auto number = static_cast<double>(parts.number ? parts.number(i) : i);
      now[i] = 1 + .5 * std::sin(1. + number * number);
    }
    const double start = norm(now, ranks);
    for (double &value : now)
      value /= start;
    int next_check = 10;
    for (int k = 1; k <= most_steps; ++k)
    {
      symmetric(now, next);
      alpha.push_back(dot(next, now, ranks));
      add(next, -alpha.back(), now);
      if (!beta.empty())
        add(next, -beta.back(), before);
      const double size = norm(next, ranks);
      if (!std::isfinite(size))
        break;
      const bool is_exhausted = size <= 1e-14 * std::abs(alpha[0]);
      if (k == next_check || is_exhausted)
      {
        next_check += std::max(10, k / 4);
        const auto [value, residual] = ritz(alpha, beta, size);
        if (residual <= tolerance * std::abs(value) || is_exhausted)
          return value + residual;
      }
      beta.push_back(size);
      std::swap(before, now);
      for (std::size_t i = 0; i < n; ++i)
        now[i] = next[i] / size;
    }
    throw NumericalError("the largest eigenvalue of the tangent does not settle in " +
                         std::to_string(most_steps) +
                         " steps: the operator is not symmetric or yields values that are not "
                         "finite");
  }

  double critical_step(const Motion &motion, const Scheme &scheme, const Vector &u,
                       double tolerance)
  {
    const double limit = stability_limit(scheme);
    if (!std::isfinite(limit) || limit == 0)
      return limit;
    const double largest = largest_eigenvalue(
        [&](const Vector &x, Vector &y)
        {
          motion.tangent(u, x, y);
          for (double &value : y)
            value = -value;
        },
        motion.n, tolerance, {motion.ranks, {}});
    return largest > 0 ? limit / std::sqrt(largest) : std::numeric_limits<double>::infinity();
  }
} // namespace plumbline::analysis
