#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace plumbline::uq
{
  /// Statistics of a quantity over samples.
  struct Statistics
  {
    double mean = 0;
    double variance = 0; ///< Σ w (q - mean)²; rules with negative weights may give a negative one
    double least = 0, largest = 0;
    double standard_error = 0; ///< of the mean of independent samples; else 0
    double confidence = 0; ///< so far to both sides of the mean reaches its 95 % interval; as above

    /// √variance; nothing of a negative one, which has no root: the rule cannot tell.
    std::optional<double> deviation() const;
  };

  /// Over the standard error of the mean of n independent samples so far to both sides reaches the
  /// interval that holds the true mean with 95 % confidence: the quantile of Student's t, exact
  /// where samples have a normal law; 12.7 of two, 1.96 of many.
  /// @pre n > 1
  double confidence_factor(std::size_t n);

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
    /// Negative ones that rounding makes of 0 are 0; those that rules with negative weights make
    /// are not.
    /// @param n_independent  > 1: of so many independent samples; else by weights alone
    std::vector<double> variance(std::size_t n_independent = 0) const;
    /// For pictures alone, 0 of a negative variance, which has no root.
    std::vector<double> deviation(std::size_t n_independent = 0) const;

  private:
    double weights_ = 0;
    // of differences to the first sample; sizes_: of squares by the sizes of weights
    std::vector<double> first_, sum_, squares_, sizes_;
  };
} // namespace plumbline::uq
