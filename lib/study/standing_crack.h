#pragma once

#include "method/method.h"
#include "scene/scene.h"
#include "study/results.h"
#include "study/strip_growth.h"

#include <optional>

namespace plumbline::study
{
  /// A strip with a standing crack by one method at one level.
  struct StripRow
  {
    std::string method;
    method::MethodFamily family = method::MethodFamily::meshfree;
    std::string series;
    double h = 0, horizon = 0; ///< [length]
    method::RiceStrip strip;
    method::StripState state;
    double release = 0; ///< G, by another strip whose crack is a column longer [μ length]
    std::optional<StripGrowth> growth; ///< of a crack like it, by rules, if the scene wants it
    double seconds = 0;                ///< CPU time of both
    std::string failure;

    double m() const { return horizon / h; }
    /// One of strip_quantities; NaN where it is not known.
    double quantity(const std::string &name) const;
    /// G/W1 - 1: 0 but for what the strip's ends do, whatever the method does at the tip.
    double imbalance() const { return release / state.intact - 1; }
  };

  /// W1, tip energy and opening, and of growth what it is over the law's toughness; in a field of
  /// K: G, over K²/E', and opening.
  std::vector<std::string> strip_quantities(const scene::StripSection &strip);

  /// q(h) = limit + C h^rate through the three finest levels.
  struct StripLimit
  {
    std::string method, series, quantity;
    method::MethodFamily family = method::MethodFamily::meshfree;
    double limit = 0, rate = 0;
    double change = 0; ///< of the limit, were the finest level left out; NaN: three levels
  };

  struct StripResults
  {
    std::string scene_name, purpose;
    scene::StripSection strip;
    double mu = 1; ///< in which energies are to be read [force/length^2]
    std::vector<StripRow> rows;
    std::vector<StripLimit> limits;
    bool is_complete = true; ///< else it was interrupted
  };

  /// @throws InputError  a method that solves none; what else it cannot do is in `failure`
  StripRow stand_crack(const method::Method &method, const scene::Scene &scene,
                       const problem::Series &series, const problem::Level &level);

  /// Of each method, series over h alone, and quantity, as far as three levels show one: those
  /// whose last two steps go one way and shrink.
  std::vector<StripLimit> strip_limits(const scene::StripSection &strip,
                                       const std::vector<StripRow> &rows);

  /// Between which values the limits of a quantity lie in a series, of so many methods, at least
  /// two, whose limits change by at most a twentieth with the finest level: rules and Galerkin
  /// spaces share no quadrature, so that it says how far both are right.
  struct StripAgreement
  {
    std::string quantity, series;
    double least = 0, largest = 0;
    std::size_t n_methods = 0;
  };
  std::vector<StripAgreement> strip_agreements(const std::vector<StripLimit> &limits);

  /// What does not hold of Expected/strip; an imbalance above 1e-2, a strip too short, too. Rates
  /// are those of the limits, through the three finest levels, to Expected/rate tolerance.
  std::vector<std::string> strip_faults(const StripResults &results,
                                        const scene::ExpectedSection &expected);
} // namespace plumbline::study
