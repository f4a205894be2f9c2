#pragma once

#include "method/rice_strip.h"
#include "scene/scene.h"
#include "study/analysis.h"
#include "study/strip_growth.h"

namespace plumbline::study
{
  /// What is found of a strip with a stationary crack, as a record.
  ///
  /// Scalars: "W1" and "tip energy" between grips [μ length, μ length²], "K^2/E'" and "G" (over
  /// K²/E') in a field of K; "release", G by another strip whose crack is a column longer; "G/W1 -
  /// 1", which is 0 but for what the strip's ends do; "opening" at the last cells behind the tip
  /// [length]; "growth peak", "growth mean", "growth released" and "growth bonds" of StripGrowth,
  /// over the law's toughness. Curve "opening": from the tip, opening.
  /// @param release  [μ length]
  Record strip_record(Record record, const method::RiceStrip &strip,
                      const method::StripState &state, double release,
                      const std::optional<StripGrowth> &growth);

  /// Of quantities of a method and series, q(h) = limit + C h^rate through the three finest levels,
  /// as far as they show one: where the last two steps go one way and shrink. Series over h alone.
  /// @param records  method by method, series by series, coarse to fine
  std::vector<Limit> find_limits(const Records &records,
                                 const std::vector<std::string> &quantities);

  /// Between which values the limits of a quantity lie in a series, of so many methods, at least
  /// two, whose limits change by at most a twentieth with the finest level: rules and Galerkin
  /// spaces share no quadrature, so that it says how far both are right.
  struct Agreement
  {
    std::string quantity, series;
    double least = 0, largest = 0;
    std::size_t n_methods = 0;
  };
  std::vector<Agreement> find_agreements(const std::vector<Limit> &limits);

  /// Expected/strip: a quantity at each level, or "QUANTITY limit" and "QUANTITY rate" of each
  /// series; rates to Expected/rate tolerance. And what is never right: a level without a result, a
  /// strip whose ends are too near, |G/W1 - 1| > 1e-2.
  std::vector<Expectation> check_strip(const StudyResults &results,
                                       const scene::ExpectedSection &expected);

  /// Strips with a stationary crack. Facts: "edges", "height", "crack" and "mu".
  Analysis strip_analysis();
} // namespace plumbline::study
