#include "analysis/time_series.h"

#include "analysis/motion.h"
#include "base/control_points.h"
#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::analysis
{
  namespace
  {
    /// @param n  0: the start
    double point(std::size_t k, std::size_t n, double end)
    {
      return n == 0 ? 0
                    : .5 * end *
                          (1 - std::cos(M_PI * static_cast<double>(k) / static_cast<double>(n)));
    }

    /// Barycentric weights of Chebyshev's points. Source: Berrut & Trefethen 2004,
    /// doi:10.1137/S0036144502417715, (5.4).
    double weight(std::size_t k, std::size_t n)
    {
      return (k % 2 == 0 ? 1 : -1) * (k == 0 || k == n ? .5 : 1);
    }
  } // namespace

  TimeSeries::TimeSeries(Vector value) : values_{std::move(value)} {}

  namespace
  {
    constexpr std::size_t first = 8, last = 64; ///< intervals between Chebyshev's points

    [[noreturn]] void refuse(const std::string &what, double error)
    {
      throw InputError(what +
                       ": 65 Chebyshev points up to Time/final time do not resolve it in t, "
                       "values between them differ by " +
                       base::to_text(error, 2) +
                       " of it; shorten the time, or give a field that is smoother in t");
    }
  } // namespace

  TimeSeries TimeSeries::resolve(const std::function<Vector(double)> &at, double end,
                                 double tolerance, const std::string &what, std::size_t least,
                                 const base::Communicator &ranks)
  {
    constexpr std::size_t n_controls = 3;
    TimeSeries series(end, {});
    for (std::size_t k = 0; k <= first; ++k)
      series.values_.push_back(at(point(k, first, end)));
    std::vector<std::pair<double, Vector>> controls;
    for (std::size_t n = 2 * first; n <= last; n *= 2)
    {
      std::vector<Vector> finer;
      double difference = 0, size = 0;
      Vector guess;
      for (std::size_t k = 0; k <= n; ++k)
      {
        if (k % 2 == 0)
          finer.push_back(series.values_[k / 2]);
        else
        {
          const double t = point(k, n, end);
          finer.push_back(at(t));
          series.at(t, guess);
          analysis::add(guess, -1, finer.back());
          difference = std::max(difference, norm(guess, ranks));
        }
        size = std::max(size, norm(finer.back(), ranks));
      }
      series.values_ = std::move(finer);
      // at the last n a large difference only shows that n / 2 is too small: the controls decide
      const bool is_new = difference > tolerance * size && n == last;
      if ((difference <= tolerance * size || is_new) && n + 1 >= least)
      {
        for (const double s : base::control_points(controls.empty() ? n_controls : 0))
          controls.emplace_back(s * end, at(s * end));
        for (const auto &[t, value] : controls)
          size = std::max(size, norm(value, ranks));
        difference = std::max(is_new ? 0 : difference, series.difference(controls, ranks));
      }
      series.error_ = size > 0 ? difference / size : 0;
      if (difference <= tolerance * size && n + 1 >= least)
        return series;
    }
    refuse(what, series.error_);
  }

  double TimeSeries::difference(const std::vector<std::pair<double, Vector>> &values,
                                const base::Communicator &ranks) const
  {
    double largest = 0;
    Vector guess;
    for (const auto &[t, value] : values)
    {
      at(t, guess);
      analysis::add(guess, -1, value);
      largest = std::max(largest, norm(guess, ranks));
    }
    return largest;
  }

  std::optional<std::size_t> TimeSeries::points(const std::function<Vector(double)> &at, double end)
  {
    constexpr std::size_t n_controls = 300;
    constexpr double tolerance = 1e-9;
    std::vector<std::pair<double, Vector>> controls;
    double size = 0;
    for (const double s : base::control_points(n_controls))
    {
      controls.emplace_back(s * end, at(s * end));
      size = std::max(size, norm(controls.back().second));
    }
    std::vector<Vector> all;
    for (std::size_t k = 0; k <= last; ++k)
      all.push_back(at(point(k, last, end)));
    for (std::size_t n = 2 * first; n <= last; n *= 2)
    {
      std::vector<Vector> values;
      for (std::size_t k = 0; k <= n; ++k)
        values.push_back(all[k * (last / n)]);
      if (TimeSeries(end, std::move(values)).difference(controls, base::Communicator::alone()) <=
          tolerance * size)
        return n + 1;
    }
    return {};
  }

  void TimeSeries::at(double t, Vector &value) const
  {
    const std::size_t n = values_.size() - 1;
    std::vector<double> weights(n + 1);
    double sum = 0;
    for (std::size_t k = 0; k <= n; ++k)
    {
      const double distance = n == 0 ? 0 : t - point(k, n, end_);
      if (distance == 0)
      {
        value = values_[k];
        return;
      }
      weights[k] = weight(k, n) / distance;
      sum += weights[k];
    }
    value.assign(values_[0].size(), 0);
    for (std::size_t k = 0; k <= n; ++k)
      analysis::add(value, weights[k] / sum, values_[k]);
  }

  Vector TimeSeries::at(double t) const
  {
    Vector value;
    at(t, value);
    return value;
  }

  TimeSeries TimeSeries::derivative() const
  {
    const std::size_t n = values_.size() - 1;
    const Vector zero(values_[0].size());
    TimeSeries result(end_, std::vector<Vector>(n + 1, zero));
    for (std::size_t i = 0; i <= n; ++i)
    {
      // Σ_k D_ik u_k with D_ii = -Σ_k≠i D_ik, so that constants have none
      for (std::size_t k = 0; k <= n; ++k)
        if (k != i)
        {
          const double d = weight(k, n) / weight(i, n) / (point(i, n, end_) - point(k, n, end_));
          analysis::add(result.values_[i], d, values_[k]);
          analysis::add(result.values_[i], -d, values_[i]);
        }
    }
    return result;
  }

  void TimeSeries::add(double factor, const TimeSeries &other)
  {
    if (values_.size() < other.values_.size()) // the same polynomial, by more points
    {
      const std::size_t n = other.values_.size() - 1;
      std::vector<Vector> finer;
      for (std::size_t k = 0; k <= n; ++k)
        finer.push_back(at(point(k, n, other.end_)));
      values_ = std::move(finer);
      end_ = other.end_;
    }
    for (std::size_t k = 0; k < values_.size(); ++k)
      analysis::add(values_[k], factor, other.at(point(k, values_.size() - 1, end_)));
  }
} // namespace plumbline::analysis
