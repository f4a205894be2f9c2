#include "study/trend.h"

#include "base/number_text.h"
#include "study/slow_power.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  namespace
  {
    /// Round-off above this fraction of how far the solution varies hides what is to be judged.
    constexpr double blurred = 1e-4;

    struct LinearFit
    {
      double a, b, residual;
    };

    /// a and b of e = a + b x^p for fixed p, by least squares of relative residuals.
    LinearFit fit_at(const std::vector<double> &x, const std::vector<double> &e, double p)
    {
      double s11 = 0, s12 = 0, s22 = 0, r1 = 0, r2 = 0;
      const double scale = x.front();
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double u = 1 / e[i], v = std::pow(x[i] / scale, p) / e[i];
        s11 += u * u;
        s12 += u * v;
        s22 += v * v;
        r1 += u;
        r2 += v;
      }
      const double determinant = s11 * s22 - s12 * s12;
      LinearFit fit{(s22 * r1 - s12 * r2) / determinant, (s11 * r2 - s12 * r1) / determinant, 0};
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double relative = (fit.a + fit.b * std::pow(x[i] / scale, p)) / e[i] - 1;
        fit.residual += relative * relative;
      }
      fit.b /= std::pow(scale, p);
      return fit;
    }

    PlateauFit best_fit(const std::vector<double> &x, const std::vector<double> &e)
    {
      constexpr double lowest = .25, highest = 8, step = .01;
      PlateauFit best;
      double residual = 1e300;
      for (double p = lowest; p <= highest; p += step)
        if (const LinearFit fit = fit_at(x, e, p); fit.residual < residual)
        {
          residual = fit.residual;
          best = {fit.a, fit.b, p, 0};
        }
      return best;
    }

  } // namespace

  PlateauFit fit_plateau(const std::vector<double> &x, const std::vector<double> &e)
  {
    PlateauFit fit = best_fit(x, e);
    for (std::size_t left_out = 0; left_out < x.size(); ++left_out)
    {
      auto fewer_x = x, fewer_e = e;
      fewer_x.erase(fewer_x.begin() + left_out);
      fewer_e.erase(fewer_e.begin() + left_out);
      fit.a_uncertainty =
          std::max(fit.a_uncertainty, std::abs(best_fit(fewer_x, fewer_e).a - fit.a));
    }
    return fit;
  }

  Slope fit_slope(const std::vector<double> &x, const std::vector<double> &e)
  {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0, mean_e = 0, sxx = 0, sxe = 0, residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      mean_x += std::log(x[i]) / n;
      mean_e += std::log(e[i]) / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      sxx += std::pow(std::log(x[i]) - mean_x, 2);
      sxe += (std::log(x[i]) - mean_x) * (std::log(e[i]) - mean_e);
    }
    Slope slope{sxe / sxx, 0};
    for (std::size_t i = 0; i < x.size(); ++i)
      residual += std::pow(std::log(e[i]) - mean_e - slope.value * (std::log(x[i]) - mean_x), 2);
    slope.uncertainty = n > 2 ? std::sqrt(residual / (n - 2) / sxx) : 0;
    return slope;
  }

  double own_rate(const std::vector<double> &x, const std::vector<double> &d, double finest)
  {
    constexpr double lowest = .25, highest = 8, step = .01;
    double best = lowest, least = 1e300;
    for (double p = lowest; p <= highest; p += step)
    {
      double s1 = 0, s2 = 0, residual = 0; // of d = C (x^p - finest^p), relative, C = s1 / s2
      std::vector<double> ratio;
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        ratio.push_back((std::pow(x[i] / finest, p) - 1) / d[i]);
        s1 += ratio.back();
        s2 += ratio.back() * ratio.back();
      }
      for (const double one : ratio)
        residual += std::pow(s1 / s2 * one - 1, 2);
      if (residual < least)
      {
        least = residual;
        best = p;
      }
    }
    return best;
  }

  namespace
  {
    /// Errors from differences to the own finest level, which has one itself.
    std::vector<double> with_own_error(const Trend &trend)
    {
      std::vector<double> errors = trend.values;
      const bool is_positive =
          std::all_of(errors.begin(), errors.end(), [](double d) { return d > 0; });
      if (trend.finest == 0 || errors.size() < 2 || !is_positive)
        return errors;
      const double p = own_rate(trend.x, errors, trend.finest);
      for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] /= 1 - std::pow(trend.finest / trend.x[i], p);
      return errors;
    }

    std::string needed_levels(std::size_t n)
    {
      return std::to_string(n) + " of the " + std::to_string(levels_for_verdict) +
             " levels that a verdict needs";
    }

    /// Round-off is erratic. Errors near its bound that fall from level to level as a plateau and a
    /// power do, to a part in a thousand, are none: the bound is for the worst case.
    bool shows_a_law(const std::vector<double> &x, const std::vector<double> &e, double bound)
    {
      constexpr double near = .01, digits = 1e-3;
      if (e.size() < levels_for_verdict || !(e.back() > near * bound) ||
          !std::is_sorted(e.rbegin(), e.rend()) || !(e.front() > (1 + digits) * e.back()))
        return false;
      const PlateauFit fit = best_fit(x, e);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!(std::abs(fit.a + fit.b * std::pow(x[i], fit.p) - e[i]) <= digits * e[i]))
          return false;
      return true;
    }

    /// Of errors whose last one is no larger than round-off.
    void judge_round_off(Trend &trend, double largest)
    {
      if (!(trend.round_off <= blurred * trend.size))
      {
        trend.reason = "round-off, up to " + base::to_text(trend.round_off, 3) +
                       ", hides the errors of a solution that "
                       "varies by " +
                       base::to_text(trend.size, 3) +
                       " only: subtract a constant from the data, which the operator does not see, "
                       "or lower Solver/tolerance";
        return;
      }
      trend.outcome = Outcome::converges;
      trend.reason = (largest <= trend.round_off ? "exact to round-off, largest error "
                                                 : "reaches round-off, from ") +
                     base::to_text(largest, 3);
    }

    /// Of errors whose fit has a plateau: it stalls, unless a slow power or a logarithm fits too.
    void judge_plateau(Trend &trend, const std::vector<double> &x, const std::vector<double> &e,
                       const PlateauFit &fit, const std::string &numbers)
    {
      // c / ln(L/x) has the rate 1/ln(L/x), above .1 while x > L / 2e4, and is fitted by a plateau
      // with a rest that falls slower than x^(1/2)
      constexpr double slowest_rest = .5, rate_of_logarithms = .1;
      const std::size_t n = x.size();
      const double last_rate = std::log(e[n - 1] / e[n - 2]) / std::log(x[n - 1] / x[n - 2]);
      const Approach approach = find_approach(x, e);
      const auto power = [](double p) { return "x^" + base::to_text(p, 2); };
      if (fit.p < slowest_rest && last_rate > rate_of_logarithms)
      {
        trend.leaning = Leaning::plateau_or_power;
        trend.reason = "a plateau or a logarithm: the remainder decreases only like " +
                       power(fit.p) + "; " + numbers;
      }
      else if (approach.kind == Approach::Kind::plateau)
      {
        trend.outcome = Outcome::stalls;
        trend.reason = "significant plateau: " + numbers;
      }
      else if (approach.kind == Approach::Kind::slow_power)
        trend.reason = "a slow power, " + power(approach.power) + " (" +
                       base::to_text(approach.low, 2) + " to " + base::to_text(approach.high, 2) +
                       "), fits better than a plateau: last error " + base::to_text(e.back(), 3) +
                       ", rate " + base::to_text(trend.rate, 3) + " ± " +
                       base::to_text(trend.rate_uncertainty, 3);
      else
      {
        constexpr double root = .5;
        const bool may_be_root = approach.low <= root && root <= approach.high;
        trend.leaning = Leaning::plateau_or_power;
        trend.reason = "plateau or a slow power " + power(may_be_root ? root : approach.power) +
                       ", run a finer level: " + numbers;
      }
    }

    /// By plateau and rate of errors above round-off.
    /// @pre  levels_for_verdict of them
    void judge_errors(Trend &trend, const std::vector<double> &x, const std::vector<double> &e)
    {
      const PlateauFit fit = fit_plateau(x, e);
      const Slope slope = fit_slope({x.end() - 3, x.end()}, {e.end() - 3, e.end()});
      const double last = e.back(), smallest = *std::min_element(e.begin(), e.end());
      trend.plateau = fit.a;
      trend.plateau_uncertainty = fit.a_uncertainty;
      trend.rate = slope.value;
      trend.rate_uncertainty = slope.uncertainty;

      // a plateau is nil if it is small beside the last error, or not so small but not significant
      // either
      const bool is_significant = fit.a > 3 * fit.a_uncertainty;
      const bool is_nil =
          std::abs(fit.a) < .1 * last || (!is_significant && std::abs(fit.a) < .3 * last);
      const bool is_rate_sure = slope.value - 2 * slope.uncertainty >= .75;
      const bool is_certain = fit.a > 10 * fit.a_uncertainty;
      // coarse levels that lie above their power law look like a plateau of the others
      const bool is_flattening = e.back() / e[e.size() - 2] > x.back() / x[x.size() - 2];
      const std::string numbers =
          "plateau " + base::to_text(fit.a, 3) + " ± " + base::to_text(fit.a_uncertainty, 3) +
          ", last error " + base::to_text(last, 3) + ", rate " + base::to_text(slope.value, 3) +
          " ± " + base::to_text(slope.uncertainty, 3);
      if (last > 2 * smallest)
      {
        trend.outcome = Outcome::stalls;
        trend.reason = "the error grows again, from " + base::to_text(smallest, 3) + " to " +
                       base::to_text(last, 3);
      }
      else if (is_nil && is_rate_sure)
      {
        trend.outcome = Outcome::converges;
        trend.reason = "no plateau: " + numbers;
      }
      else if (fit.a >= .1 * last &&
               (is_certain || (is_significant && is_flattening && fit.a >= .3 * last)))
        judge_plateau(trend, x, e, fit, numbers);
      else if (is_nil && slope.value + 2 * slope.uncertainty < .75)
        trend.reason = "no plateau, but a slow power, x^" + base::to_text(slope.value, 2) +
                       ", below 3/4: " + numbers;
      else
      {
        if (!is_significant && is_rate_sure)
          trend.leaning = Leaning::none_or_plateau;
        trend.reason = (is_nil ? "no plateau, but a rate that is not surely 3/4: "
                               : "a plateau that is neither nil nor certain, run a finer level: ") +
                       numbers;
      }
    }

    /// How an error depends on a variable.
    std::string dependence(const Trend &trend, const std::string &variable)
    {
      if (trend.values.empty())
        return "no level has this error";
      const auto at = [&](std::vector<double>::const_iterator one)
      {
        return base::to_text(*one, 4) + " at " + variable + " = " +
               base::to_text(trend.x[static_cast<std::size_t>(one - trend.values.begin())], 4);
      };
      const auto [least, most] = std::minmax_element(trend.values.begin(), trend.values.end());
      return "error from " + at(least) + " to " + at(most);
    }
  } // namespace

  double observed_rate(const Trend &trend, std::size_t i)
  {
    constexpr double above = 5; // round-off of a fifth of the error changes a rate by .3
    const bool is_there = i > 0 && i <= trend.rates.size() && i < trend.values.size();
    return is_there && std::min(trend.values[i - 1], trend.values[i]) > above * trend.round_off
               ? trend.rates[i - 1]
               : std::numeric_limits<double>::quiet_NaN();
  }

  double last_rate(const Trend &trend)
  {
    return observed_rate(trend, trend.rates.size());
  }

  void judge(Trend &trend, const std::string &variable)
  {
    if (trend.axis == Axis::variable)
    {
      trend.outcome = Outcome::undecided;
      trend.reason = dependence(trend, variable);
      return;
    }
    trend.rates.clear();
    trend.leaning = Leaning::none;
    const std::vector<double> values = with_own_error(trend);
    for (std::size_t i = 1; i < trend.x.size(); ++i)
      trend.rates.push_back(std::log(values[i] / values[i - 1]) /
                            std::log(trend.x[i] / trend.x[i - 1]));
    trend.outcome = Outcome::undecided;
    if (trend.x.size() < levels_for_verdict)
    {
      trend.reason = needed_levels(trend.x.size()) +
                     (trend.finest > 0 ? " besides the finest" : "") +
                     ": run more (Study/h, --levels)";
      return;
    }

    const double floor = shows_a_law(trend.x, values, trend.round_off) ? 0 : trend.round_off;
    if (values.back() <= floor)
      return judge_round_off(trend, *std::max_element(values.begin(), values.end()));
    std::vector<double> x, e; // a level that is exact by chance does not count
    for (std::size_t i = 0; i < trend.x.size(); ++i)
      if (values[i] > floor)
      {
        x.push_back(trend.x[i]);
        e.push_back(values[i]);
      }
    if (x.size() < levels_for_verdict)
    {
      trend.reason = needed_levels(x.size()) + " are above round-off, " + base::to_text(floor, 3);
      return;
    }
    judge_errors(trend, x, e);
  }

  double norm_of_one(const std::string &error, double area)
  {
    for (const scene::Norm norm :
         {scene::Norm::nodal_l2, scene::Norm::averages_l2, scene::Norm::field_l2,
          scene::Norm::truncation_l2, scene::Norm::bound_l2})
      if (error.find(base::word(norm) + " |") != std::string::npos)
        return std::sqrt(area);
    return 1;
  }

  bool is_truncation(const std::string &error)
  {
    return error.rfind("truncation ", 0) == 0;
  }

  bool is_bound(const std::string &error)
  {
    return error.rfind("bound ", 0) == 0;
  }

  bool is_energy(const std::string &error)
  {
    return error.rfind(base::word(scene::Norm::energy) + " |", 0) == 0;
  }

  bool is_against(const std::string &error, scene::Target target)
  {
    const std::string end = "| " + base::word(target);
    return error.size() >= end.size() &&
           error.compare(error.size() - end.size(), end.size(), end) == 0;
  }

  std::string verdict_of(scene::Regime regime, const Trend &trend)
  {
    if (trend.outcome == Outcome::failed)
      return base::word(Outcome::failed);
    if (regime == scene::Regime::variable)
      return trend.values.empty()
                 ? base::word(Outcome::undecided)
                 : "at most " + base::to_text(
                                    *std::max_element(trend.values.begin(), trend.values.end()), 4);
    if (regime == scene::Regime::horizon)
      return std::isnan(trend.rate) // too few horizons to fit one
                 ? base::word(Outcome::undecided)
                 : "rate " + base::to_text(trend.rate, 4);
    if (trend.finest > 0 && trend.outcome == Outcome::field_only)
      return "self-convergent to a wrong limit";
    const std::string name = trend.finest > 0                 ? "self-convergent"
                             : regime == scene::Regime::delta ? "AC"
                             : regime == scene::Regime::m     ? "m-convergent"
                                                              : "delta-m-convergent";
    switch (trend.outcome)
    {
    case Outcome::converges:
      return name;
    case Outcome::field_only:
      return name + " for this field only";
    case Outcome::stalls:
      return "not " + name;
    default:
      return "undecided";
    }
  }
} // namespace plumbline::study
