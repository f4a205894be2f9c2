#pragma once

#include "study/results.h"

namespace plumbline::study
{
  /// e = a + b x^p fitted to an error over a sweep, in relative residuals.
  struct PlateauFit
  {
    double a = 0, b = 0, p = 0;
    double a_uncertainty = 0; ///< how far a moves when one level is left out
  };

  /// @pre at least three levels, x decreasing, e > 0
  PlateauFit fit_plateau(const std::vector<double> &x, const std::vector<double> &e);

  /// Slope of log e over log x by least squares, with its standard error.
  struct Slope
  {
    double value = 0, uncertainty = 0;
  };
  Slope fit_slope(const std::vector<double> &x, const std::vector<double> &e);

  /// Rates, plateau and outcome from trend.x and trend.values; the rest of the trend is left alone.
  ///
  /// - converges: the errors are round-off, or the plateau a is statistically nil (within three
  ///   uncertainties, or under a tenth of the last error) and the last three levels have slope >=
  ///   3/4;
  /// - stalls: a is significant and at least 3/10 of the last error (1/10 if it exceeds ten
  /// uncertainties),
  ///   or the error grew to twice the smallest one;
  /// - undecided: neither, or fewer than three levels.
  void judge(Trend &trend);
} // namespace plumbline::study
