#include "uq/statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::uq
{
  std::optional<double> Statistics::deviation() const
  {
    if (variance < 0)
      return {};
    return std::sqrt(variance);
  }

  double confidence_factor(std::size_t n)
  {
    constexpr double above = .025; // as much is left out on either side
    return boost::math::quantile(
        boost::math::complement(boost::math::students_t(static_cast<double>(n - 1)), above));
  }

  Statistics statistics(const std::vector<double> &values, const std::vector<double> &weights,
                        bool independent)
  {
    Statistics result;
    for (std::size_t i = 0; i < values.size(); ++i)
      result.mean += weights[i] * values[i];
    for (std::size_t i = 0; i < values.size(); ++i)
      result.variance += weights[i] * (values[i] - result.mean) * (values[i] - result.mean);
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    result.least = *least;
    result.largest = *largest;
    const auto n = static_cast<double>(values.size());
    if (independent && values.size() > 1)
    {
      result.variance *= n / (n - 1);
      result.standard_error = std::sqrt(result.variance / n);
      result.confidence = confidence_factor(values.size()) * result.standard_error;
    }
    return result;
  }

  std::vector<std::size_t> histogram(const std::vector<double> &values, unsigned int n)
  {
    std::vector<std::size_t> counts(n, 0);
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    for (const double value : values)
    {
      const double part = *largest > *least ? (value - *least) / (*largest - *least) : 0;
      ++counts[std::min(n - 1, static_cast<unsigned int>(part * n))];
    }
    return counts;
  }

  void FieldSums::add(const std::vector<double> &values, double weight)
  {
    if (first_.empty())
    {
      first_ = values;
      sum_.assign(values.size(), 0);
      squares_.assign(values.size(), 0);
      sizes_.assign(values.size(), 0);
    }
    weights_ += weight;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const double d = values[i] - first_[i];
      sum_[i] += weight * d;
      squares_[i] += weight * d * d;
      sizes_[i] += std::abs(weight) * d * d;
    }
  }

  std::vector<double> FieldSums::mean() const
  {
    std::vector<double> result = first_;
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += sum_[i] / weights_;
    return result;
  }

  std::vector<double> FieldSums::variance(std::size_t n_independent) const
  {
    constexpr double rounding = 1e-12; // of the parts, thousands of which add up
    const auto n = static_cast<double>(n_independent);
    const double factor = n_independent > 1 ? n / (n - 1) : 1;
    std::vector<double> result(sum_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      const double squares = squares_[i] - sum_[i] * sum_[i] / weights_;
      const bool is_rounding = squares < 0 && -squares <= rounding * sizes_[i];
      result[i] = is_rounding ? 0 : factor * squares / weights_;
    }
    return result;
  }

  std::vector<double> FieldSums::deviation(std::size_t n_independent) const
  {
    std::vector<double> result = variance(n_independent);
    for (double &one : result)
      one = std::sqrt(std::max(0., one));
    return result;
  }
} // namespace plumbline::uq
