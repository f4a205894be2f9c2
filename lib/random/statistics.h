#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace plumbline::random
{
  /// Statistics of a quantity over samples.
  struct Statistics
  {
    double mean = 0;
    double variance = 0; ///< Σ w (q - mean)²; rules with negative weights may give a negative one
    double least = 0, largest = 0;
    double standard_error = 0; ///< of the mean of independent samples; else 0

    /// √variance; nothing of a negative one, which has no root: the rule cannot tell.
    std::optional<double> deviation() const;
  };

  /// @param values       one for each weight
  /// @param independent  samples of equal weights: the variance is that of n - 1
  /// @pre some values
  Statistics statistics(const std::vector<double> &values, const std::vector<double> &weights,
                        bool independent);

  /// How many of the values are in each of n equal parts of their range.
  std::vector<std::size_t> histogram(const std::vector<double> &values, unsigned int n);

  /// Mean and variance of many quantities at once, sample by sample, so that no sample is kept.
  class FieldSums
  {
  public:
    /// @param values  as many each time
    /// @param weight  over the sum of all that are added
    void add(const std::vector<double> &values, double weight);

    std::vector<double> mean() const;
    /// @param n_independent  > 1: of so many independent samples; else by weights alone
    std::vector<double> variance(std::size_t n_independent = 0) const;
    std::vector<double>
    deviation(std::size_t n_independent = 0) const; ///< 0 of a negative variance

  private:
    double weights_ = 0;
    std::vector<double> first_, sum_, squares_; ///< of differences to the first sample
  };
} // namespace plumbline::random
