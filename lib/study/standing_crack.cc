#include "study/standing_crack.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "physics/state_based.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace plumbline::study
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /// In which strips a quantity is known.
    enum class Known
    {
      in_all,
      between_grips,
      in_field_of_K,
      of_growth ///< between grips, with Strip/growth
    };

    struct Quantity
    {
      std::string_view name;
      Known known;
      double (*of)(const StripRow &);
    };

    /// In the order of tables.
    constexpr std::array quantities = {
        Quantity{"W1", Known::between_grips, [](const StripRow &row) { return row.state.intact; }},
        Quantity{"tip energy", Known::between_grips,
                 [](const StripRow &row) { return row.state.tip_energy(row.strip); }},
        Quantity{"G", Known::in_field_of_K,
                 [](const StripRow &row) { return row.release / row.state.intact; }},
        Quantity{"opening", Known::in_all,
                 [](const StripRow &row) { return row.state.opening.back(); }},
        Quantity{"growth peak", Known::of_growth,
                 [](const StripRow &row) { return row.growth->peak; }},
        Quantity{"growth mean", Known::of_growth,
                 [](const StripRow &row) { return row.growth->mean; }},
        Quantity{"growth released", Known::of_growth,
                 [](const StripRow &row) { return row.growth->released; }},
        Quantity{"growth bonds", Known::of_growth,
                 [](const StripRow &row) { return row.growth->bonds; }}};

    bool is_known(const Quantity &quantity, const scene::StripSection &strip)
    {
      const bool is_field = strip.edges == scene::StripEdges::K_field;
      switch (quantity.known)
      {
      case Known::between_grips:
        return !is_field;
      case Known::in_field_of_K:
        return is_field;
      case Known::of_growth:
        return !is_field && strip.n_growth > 0;
      default:
        return true;
      }
    }

    /// Null where there is none of that name.
    const Quantity *find_quantity(const std::string &name)
    {
      const auto *const found =
          std::find_if(quantities.begin(), quantities.end(),
                       [&](const Quantity &quantity) { return quantity.name == name; });
      return found == quantities.end() ? nullptr : found;
    }

    int cells(double length, double h)
    {
      return static_cast<int>(std::lround(length / h));
    }

    struct Limit
    {
      double value = 0, rate = 0;
    };

    /// Of q(h) = limit + C h^rate through three points, h falling.
    std::optional<Limit> find_limit(const std::array<double, 3> &h, const std::array<double, 3> &q)
    {
      constexpr double slowest = .25, fastest = 8;
      const double first = q[0] - q[1], second = q[1] - q[2];
      const auto ratio = [&](double rate)
      {
        return (std::pow(h[0], rate) - std::pow(h[1], rate)) /
               (std::pow(h[1], rate) - std::pow(h[2], rate));
      };
      double below = slowest, above = fastest; // the ratio rises with the rate
      if (!(first / second >= ratio(below) && first / second <= ratio(above)))
        return {}; // up and down, or not at all
      while (above - below > 1e-10)
      {
        const double middle = .5 * (below + above);
        (ratio(middle) < first / second ? below : above) = middle;
      }
      const double C = second / (std::pow(h[1], below) - std::pow(h[2], below));
      return Limit{q[2] - C * std::pow(h[2], below), below};
    }

    /// Over the levels of a method and series, coarse to fine, whose last one is `last`.
    std::optional<Limit> find_limit(const std::vector<const StripRow *> &levels, std::size_t last,
                                    const std::string &quantity)
    {
      std::array<double, 3> h{}, q{};
      for (std::size_t i = 0; i < 3; ++i)
      {
        h[i] = levels[last + i - 2]->h;
        q[i] = levels[last + i - 2]->quantity(quantity);
      }
      return find_limit(h, q);
    }

    /// Of rows that failed, or whose strip ends too near to the tip.
    std::vector<std::string> imbalances(const std::vector<StripRow> &rows)
    {
      constexpr double worst_imbalance = 1e-2;
      std::vector<std::string> faults;
      for (const StripRow &row : rows)
        if (!row.failure.empty())
          faults.push_back(row.method + ", h = " + base::to_text(row.h, 4) + ": " + row.failure);
        else if (!row.strip.K_tip && !(std::abs(row.imbalance()) <= worst_imbalance))
          faults.push_back(row.method + ", h = " + base::to_text(row.h, 4) + ": G is " +
                           base::to_text(row.release / row.state.intact, 6) +
                           " W1, so that the strip's ends are too near; raise Strip/length, "
                           "and set Strip/crack to its middle");
      return faults;
    }

    bool is_rate(const scene::Expected &one)
    {
      const std::string end = " rate";
      return one.problem.size() > end.size() &&
             one.problem.compare(one.problem.size() - end.size(), end.size(), end) == 0;
    }

    /// Of a quantity at each level, or of its limit or rate in each series.
    std::vector<double> values_of(const StripResults &results, const scene::Expected &one)
    {
      const auto is_meant = [&](const auto &found)
      { return found.method == one.method && (one.series.empty() || found.series == one.series); };
      std::vector<double> values;
      for (const StripLimit &limit : results.limits)
        if (is_meant(limit))
        {
          if (one.problem == limit.quantity + " limit")
            values.push_back(limit.limit);
          else if (one.problem == limit.quantity + " rate")
            values.push_back(limit.rate);
        }
      const std::vector<std::string> names = strip_quantities(results.strip);
      for (const StripRow &row : results.rows)
        if (is_meant(row) && row.failure.empty() &&
            std::find(names.begin(), names.end(), one.problem) != names.end())
          values.push_back(row.quantity(one.problem));
      return values;
    }
  } // namespace

  std::vector<std::string> strip_quantities(const scene::StripSection &strip)
  {
    std::vector<std::string> names;
    for (const Quantity &quantity : quantities)
      if (is_known(quantity, strip))
        names.emplace_back(quantity.name);
    return names;
  }

  double StripRow::quantity(const std::string &name) const
  {
    const Quantity *const found = find_quantity(name);
    if (found == nullptr || (found->known == Known::of_growth && !growth))
      return unknown;
    return found->of(*this);
  }

  StripRow stand_crack(const method::Method &method, const scene::Scene &scene,
                       const problem::Series &series, const problem::Level &level)
  {
    StripRow row{
        method.name(), method.family(), series.name, level.h, level.horizon, {}, {}, 0, {}, 0, {}};
    row.strip = {cells(scene.strip.height, level.h),
                 cells(scene.strip.length, level.h),
                 cells(scene.strip.crack, level.h),
                 level.h,
                 {}};
    if (scene.strip.edges == scene::StripEdges::K_field)
      row.strip.K_tip = row.strip.n_crack + .5;
    const auto influence = physics::influence_function(scene.kernel.profile, level.horizon);
    const base::CpuTimer timer;
    try
    {
      row.state = method.solve_strip(row.strip, influence);
      method::RiceStrip longer = row.strip;
      ++longer.n_crack;
      row.release = (row.state.energy - method.solve_strip(longer, influence).energy) / level.h;
    }
    catch (const NumericalError &error)
    {
      row.failure = error.what();
    }
    row.seconds = timer.seconds();
    return row;
  }

  std::vector<StripLimit> strip_limits(const scene::StripSection &strip,
                                       const std::vector<StripRow> &rows)
  {
    std::vector<StripLimit> limits;
    for (auto begin = rows.begin(); begin != rows.end();)
    {
      const auto end =
          std::find_if(begin, rows.end(),
                       [&](const StripRow &row)
                       { return row.method != begin->method || row.series != begin->series; });
      std::vector<const StripRow *> levels;
      for (auto row = begin; row != end; ++row)
        if (row->failure.empty())
          levels.push_back(&*row);
      for (const std::string &quantity : strip_quantities(strip))
      {
        if (levels.size() < 3)
          break;
        // what lattices trap has no power of h
        if (find_quantity(quantity)->known == Known::of_growth)
          continue;
        const std::size_t last = levels.size() - 1;
        const auto limit = find_limit(levels, last, quantity);
        if (!limit)
          continue;
        const auto before = last > 2 ? find_limit(levels, last - 1, quantity) : std::nullopt;
        limits.push_back({begin->method, begin->series, quantity, begin->family, limit->value,
                          limit->rate, before ? std::abs(limit->value - before->value) : unknown});
      }
      begin = end;
    }
    return limits;
  }

  std::vector<StripAgreement> strip_agreements(const std::vector<StripLimit> &limits)
  {
    constexpr double certain = .05;
    std::vector<StripAgreement> all;
    for (const StripLimit &one : limits)
    {
      if (!(one.change <= certain * std::abs(one.limit)))
        continue;
      const auto at =
          std::find_if(all.begin(), all.end(),
                       [&](const StripAgreement &other)
                       { return other.quantity == one.quantity && other.series == one.series; });
      if (at == all.end())
      {
        all.push_back({one.quantity, one.series, one.limit, one.limit, 1});
        continue;
      }
      at->least = std::min(at->least, one.limit);
      at->largest = std::max(at->largest, one.limit);
      ++at->n_methods;
    }
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const StripAgreement &one) { return one.n_methods < 2; }),
              all.end());
    return all;
  }

  std::vector<std::string> strip_faults(const StripResults &results,
                                        const scene::ExpectedSection &expected)
  {
    std::vector<std::string> faults = imbalances(results.rows);
    for (const scene::Expected &one : expected.all)
    {
      if (one.kind != scene::ExpectedKind::strip)
        continue;
      const std::vector<double> values = values_of(results, one);
      const std::string line = "Expected/strip = '" + one.text + "', but ";
      // of the first levels alone, if there are no more
      if (values.empty() || values.size() > one.values.size())
        faults.push_back(line + "there are " + std::to_string(values.size()) + " such values");
      for (std::size_t i = 0; i < std::min(values.size(), one.values.size()); ++i)
      {
        const double tolerance = is_rate(one) ? expected.rate_tolerance
                                              : expected.error_tolerance * std::abs(one.values[i]);
        if (!(std::abs(values[i] - one.values[i]) <= tolerance))
          faults.push_back(line + "number " + std::to_string(i + 1) + " is " +
                           base::to_text(values[i], 8));
      }
    }
    return faults;
  }
} // namespace plumbline::study
