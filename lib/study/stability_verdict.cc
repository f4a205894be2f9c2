#include "study/stability.h"

#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    std::string number(double value)
    {
      std::ostringstream text;
      text << std::setprecision(4) << value;
      return text.str();
    }

    std::string place(const StabilityRow &row)
    {
      return "m = " + number(row.m()) + ", h = " + number(row.h);
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
              number(d.smallest_weight_ratio) + " of their area");
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
        return std::to_string(s.n_zero) + " zero-energy modes";
      if (!s.is_definite())
        return "the symmetric part is not positive definite, smallest eigenvalue " +
               number(s.smallest) + " of " + number(s.largest);
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

    /// The power of h, or of the horizon, with which the coercivity constant falls at the finest
    /// three levels of a series; 0 if there are fewer.
    double decay(const std::vector<StabilityRow> &rows, const std::string &series)
    {
      constexpr std::size_t n_levels = 3;
      constexpr double least_ratio = 2; // between sizes, for a trend
      std::vector<double> h, horizon, smallest;
      for (const StabilityRow &row : rows)
        if (row.series == series && is_sound(row))
        {
          h.push_back(row.h);
          horizon.push_back(row.horizon);
          smallest.push_back(row.stability.smallest);
        }
      std::vector<double> &x = h.empty() || h.front() == h.back() ? horizon : h;
      if (x.size() < n_levels || x[x.size() - n_levels] < least_ratio * x.back())
        return 0;
      const auto last = [](const std::vector<double> &values)
      { return std::vector<double>(values.end() - n_levels, values.end()); };
      return fit_slope(last(x), last(smallest)).value;
    }
  } // namespace

  StabilityVerdict judge(const std::vector<StabilityRow> &rows)
  {
    constexpr double most_decay = .5;
    StabilityVerdict result{rows.front().method, "unstable", "", ""};
    const auto first_not = [&](const auto &is)
    { return std::find_if_not(rows.begin(), rows.end(), is); };
    const StabilityRow *lowest = nullptr;
    for (const StabilityRow &row : rows)
    {
      if (const double power = decay(rows, row.series); power > most_decay)
      {
        result.explanation = "the coercivity constant falls like the mesh size or horizon to the "
                             "power " +
                             number(power) + " in series " + row.series;
        return result;
      }
      if (is_sound(row) &&
          (lowest == nullptr || row.stability.smallest < lowest->stability.smallest))
        lowest = &row;
    }
    if (lowest == nullptr)
    {
      result.explanation = "no level is sound: " + defect(rows.back());
      return result;
    }
    const std::string coercive = "coercive with " + number(lowest->stability.smallest) +
                                 " or more (least at " + place(*lowest) + ")";
    if (first_not(is_good) == rows.end())
    {
      result.verdict = "stable";
      result.explanation = coercive;
      return result;
    }
    result.verdict = "conditionally stable";
    for (const auto &is : {is_good, is_sound})
      if (const auto m = threshold(rows, is))
      {
        const auto bad = first_not(is);
        result.condition = bad == rows.end() ? "A stays positive definite" : "m >= " + number(*m);
        const auto doubtful =
            std::find_if(rows.begin(), rows.end(),
                         [&](const StabilityRow &row) { return is(row) && !is_good(row); });
        result.explanation = coercive;
        if (bad != rows.end())
          result.explanation += "; at " + place(*bad) + " " + defect(*bad);
        if (doubtful != rows.end())
          result.explanation += "; at " + place(*doubtful) + " " + doubt(*doubtful);
        return result;
      }
    result.verdict = "unstable";
    const auto bad = first_not(is_sound);
    result.explanation = "at " + place(*bad) + " " + defect(*bad) +
                         ", and no bound on m parts this "
                         "from levels where it is not so";
    return result;
  }
} // namespace plumbline::study
