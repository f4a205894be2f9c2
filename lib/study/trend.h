#pragma once

#include "scene/scene.h"
#include "study/results.h"

namespace plumbline::study
{
  /// e = a + b x^p fitted to an error over a sweep, in relative residuals.
  struct PlateauFit
  {
    double a = 0, b = 0, p = 0;
    double a_uncertainty = 0; ///< how far a moves when one level is left out
  };

  /// @pre at least four levels, x decreasing, e > 0
  PlateauFit fit_plateau(const std::vector<double> &x, const std::vector<double> &e);

  /// What a constant 1 is in the norm of an error 'norm | target', perhaps after other words: 1 for
  /// maxima, the root of Ω's area [length] for L2 norms.
  double norm_of_one(const std::string &error, double area);

  /// An error is by how much a field fails the equations, see study/truncation.h.
  bool is_truncation(const std::string &error);
  bool is_bound(const std::string &error);  ///< made of a truncation error
  bool is_energy(const std::string &error); ///< in the energy norm, see study/energy.h

  /// An error as 'norm | target' is held against this target.
  bool is_against(const std::string &error, scene::Target target);

  /// Fewer levels decide nothing.
  constexpr std::size_t levels_for_verdict = 4;

  /// Slope of log e over log x by least squares, with its standard error.
  struct Slope
  {
    double value = 0, uncertainty = 0;
  };
  Slope fit_slope(const std::vector<double> &x, const std::vector<double> &e);

  /// The rate p of differences to the finest level, d = C (x^p - finest^p), in relative residuals:
  /// those to the limit itself would be C x^p. Between 1/4 and 8, to .01.
  /// @pre x > finest > 0, d > 0
  double own_rate(const std::vector<double> &x, const std::vector<double> &d, double finest);

  /// The rate between level i - 1 and level i; NaN where there is none, or where one of the two
  /// errors is at most round-off: their ratio is noise.
  double observed_rate(const Trend &trend, std::size_t i);

  /// That between the last two levels.
  double last_rate(const Trend &trend);

  /// Rates, plateau and outcome from trend.x, values, size and round_off; the rest is left alone.
  ///
  /// - converges: the last error is round-off, where that is at most 1e-4 of how far the solution
  ///   varies; or the plateau a is nil, under
  ///   1/10 of the last error, or under 3/10 and within three uncertainties, and the slope of the
  ///   last three levels is at least 3/4 with two standard errors to spare;
  /// - stalls: a is at least 1/10 of the last error and exceeds ten uncertainties; or 3/10 and
  ///   three, and the error falls slower than x between the last two levels; and no slow power
  ///   (see find_approach) or logarithm fits as well; or the error grew to twice the smallest one;
  /// - undecided: neither, or fewer than four levels, or round-off hides the answer. A slow power
  ///   below 3/4 and an error that is either a plateau or a slow power are named in the reason.
  ///   Errors that fall by a law to 1e-3 are not taken for round-off down to 1/100 of its bound.
  /// The answer is about the given solution: a method may do better for one than for another.
  /// Where trend.finest > 0 the values are differences to the finest level; what is judged is C
  /// x^p, see `own_rate`: whether the solutions have a limit, not which.
  /// Over a variable nothing is refined: undecided, and the reason says between what values are.
  /// @param variable  its name, where that is the axis
  void judge(Trend &trend, const std::string &variable = "");

  /// The outcome in words: "AC", "not AC", "m-convergent", ..., "self-convergent" (to a limit of
  /// the method's own), "undecided", "failed"; "rate 1.98" where the horizon alone varies, "at most
  /// 0.052" where a variable does.
  std::string verdict_of(scene::Regime regime, const Trend &trend);
} // namespace plumbline::study
