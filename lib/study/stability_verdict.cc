#include "study/stability.h"

#include "base/number_text.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace plumbline::study
{
  namespace
  {
    std::string place(const StabilityRow &row, const std::string &variable)
    {
      return "m = " + base::to_text(row.m(), 4) + ", h = " + base::to_text(row.h, 4) +
             (variable.empty() ? "" : ", " + variable + " = " + base::to_text(row.value, 4));
    }

    bool is_sound(const StabilityRow &row)
    {
      return row.failure.empty() && row.stability.is_definite();
    }

    /// What keeps a sound level from being good; empty: nothing.
    std::string doubt(const StabilityRow &row)
    {
      constexpr double rounding = 1e-12;
      const Diagnostics &d = row.stability.diagnostics;
      const algebra::SignCheck &signs = row.stability.signs;
      std::string text;
      const auto add = [&](bool is, const std::string &what)
      { text += is ? (text.empty() ? "" : ", ") + what : ""; };
      add(d.n_negative_weights > 0 && d.smallest_weight_ratio < -rounding,
          std::to_string(d.n_negative_weights) + " negative weights, down to " +
              base::to_text(d.smallest_weight_ratio, 4) + " of their area");
      add(d.rank < d.n_conditions, "moment conditions of rank " + std::to_string(d.rank) + " of " +
                                       std::to_string(d.n_conditions));
      add(signs.n_parts > 1, "bonds leave " + std::to_string(signs.n_parts) + " separate parts");
      return text;
    }

    bool is_good(const StabilityRow &row)
    {
      return is_sound(row) && doubt(row).empty();
    }

    std::string defect(const StabilityRow &row)
    {
      if (!row.failure.empty())
        return row.failure;
      const Stability &s = row.stability;
      if (s.n_zero > 0)
        return s.zero_modes() + " zero-energy modes";
      if (!s.is_definite())
        return "the symmetric part is not positive definite, smallest eigenvalue " +
               base::to_text(s.smallest, 4) + " of " + base::to_text(s.largest, 4);
      return doubt(row);
    }

    /// The m from which on all levels are so and below which none is.
    std::optional<double> threshold(const std::vector<StabilityRow> &rows,
                                    const std::function<bool(const StabilityRow &)> &is)
    {
      double lowest = std::numeric_limits<double>::infinity(), highest_not = 0;
      for (const StabilityRow &row : rows)
        if (is(row))
          lowest = std::min(lowest, row.m());
        else
          highest_not = std::max(highest_not, row.m());
      if (std::isfinite(lowest) && lowest > highest_not * (1 + 1e-9))
        return lowest;
      return {};
    }

    /// The slope of log y over log x at the finest three levels that have a value.
    double power(const std::vector<double> &x, const std::vector<double> &y)
    {
      constexpr std::size_t n_levels = 3;
      constexpr double least_ratio = 2; // between sizes, for a trend
      std::vector<double> last_x, last_y;
      for (std::size_t i = x.size(); i-- > 0 && last_x.size() < n_levels;)
        if (y[i] > 0)
        {
          last_x.insert(last_x.begin(), x[i]);
          last_y.insert(last_y.begin(), y[i]);
        }
      if (last_x.size() < n_levels || last_x.front() < least_ratio * last_x.back())
        return std::numeric_limits<double>::quiet_NaN();
      return fit_slope(last_x, last_y).value;
    }
  } // namespace

  std::vector<StabilityTrend> stability_trends(const std::vector<StabilityRow> &rows)
  {
    std::vector<StabilityTrend> trends;
    for (const StabilityRow &first : rows)
    {
      if (std::any_of(trends.begin(), trends.end(),
                      [&](const StabilityTrend &t)
                      { return t.method == first.method && t.series == first.series; }))
        continue;
      std::vector<double> h, horizon, smallest, largest, inverse_norm;
      for (const StabilityRow &row : rows)
        if (row.method == first.method && row.series == first.series)
        {
          const Stability &s = row.stability; // all 0 where there is no operator
          h.push_back(row.h);
          horizon.push_back(row.horizon);
          smallest.push_back(is_sound(row) ? s.smallest : 0);
          largest.push_back(s.largest);
          inverse_norm.push_back(s.inverse_norm);
        }
      const Axis axis = h.front() == h.back() ? Axis::horizon : Axis::mesh_size;
      const auto &x = axis == Axis::horizon ? horizon : h;
      trends.push_back({first.method, first.series, axis, power(x, smallest), power(x, largest),
                        power(x, inverse_norm)});
    }
    return trends;
  }

  StabilityVerdict judge(const std::vector<StabilityRow> &rows, const std::string &variable)
  {
    constexpr double most_decay = .5;
    StabilityVerdict result{rows.front().method, StabilityAnswer::unstable, "", ""};
    const auto first_not = [&](const auto &is)
    { return std::find_if_not(rows.begin(), rows.end(), is); };
    for (const StabilityTrend &trend : stability_trends(rows))
      if (trend.smallest > most_decay)
      {
        result.explanation = "the coercivity constant falls like " + base::word(trend.axis) +
                             " to the power " + base::to_text(trend.smallest, 4) + " in series " +
                             trend.series;
        return result;
      }
    const StabilityRow *lowest = nullptr;
    for (const StabilityRow &row : rows)
      if (is_sound(row) &&
          (lowest == nullptr || row.stability.smallest < lowest->stability.smallest))
        lowest = &row;
    if (lowest == nullptr)
    {
      result.explanation = "no level is sound: " + defect(rows.back());
      return result;
    }
    const std::string coercive = "coercive with " + base::to_text(lowest->stability.smallest, 4) +
                                 " or more (least at " + place(*lowest, variable) + ")";
    if (first_not(is_good) == rows.end())
    {
      result.verdict = StabilityAnswer::stable;
      result.explanation = coercive;
      return result;
    }
    result.verdict = StabilityAnswer::conditional;
    for (const auto &is : {is_good, is_sound})
      if (const auto m = threshold(rows, is))
      {
        const auto bad = first_not(is);
        result.condition =
            bad == rows.end() ? "A stays positive definite" : "m >= " + base::to_text(*m, 4);
        const auto doubtful =
            std::find_if(rows.begin(), rows.end(),
                         [&](const StabilityRow &row) { return is(row) && !is_good(row); });
        result.explanation = coercive;
        if (bad != rows.end())
          result.explanation += "; at " + place(*bad, variable) + " " + defect(*bad);
        if (doubtful != rows.end())
          result.explanation += "; at " + place(*doubtful, variable) + " " + doubt(*doubtful);
        return result;
      }
    result.verdict = StabilityAnswer::unstable;
    const auto bad = first_not(is_sound);
    result.explanation = "at " + place(*bad, variable) + " " + defect(*bad) +
                         ", and no bound on m parts this "
                         "from levels where it is not so";
    return result;
  }
} // namespace plumbline::study
