#include "study/stationary_crack.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "physics/state_based.h"
#include "study/preflight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace plumbline::study
{
  namespace
  {
    /// What a strip can yield, in the order of tables; growth has no limits: what lattices trap has
    /// no power of h.
    const std::vector<std::string> quantities = {"W1", "tip energy", "G", "opening"};

    int cells(double length, double h)
    {
      return static_cast<int>(std::lround(length / h));
    }

    struct PowerLaw
    {
      double limit = 0, rate = 0;
    };

    /// q(h) = limit + C h^rate through three points, h falling.
    std::optional<PowerLaw> find_power_law(const std::array<double, 3> &h,
                                           const std::array<double, 3> &q)
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
      return PowerLaw{q[2] - C * std::pow(h[2], below), below};
    }

    /// Through the level `last` and the two before it.
    std::optional<PowerLaw> find_power_law(const std::vector<const Record *> &levels,
                                           std::size_t last, const std::string &quantity)
    {
      std::array<double, 3> h{}, q{};
      for (std::size_t i = 0; i < 3; ++i)
      {
        h[i] = levels[last + i - 2]->key.h;
        q[i] = (*levels[last + i - 2])[quantity];
      }
      return find_power_law(h, q);
    }

    /// Levels that failed, or whose strip ends too near to the tip.
    std::vector<Expectation> check_balance(const Records &records)
    {
      constexpr double worst_imbalance = 1e-2;
      std::vector<Expectation> missed;
      for (const Record &record : records)
      {
        const std::string where = record.key.method + ", h = " + base::to_text(record.key.h, 4);
        if (!record.failure.empty())
          missed.push_back({where, "a result", record.failure, false});
        else if (record.has("W1") && !(std::abs(record["G/W1 - 1"]) <= worst_imbalance))
          missed.push_back({where, "G = W1 to " + base::to_text(worst_imbalance, 2),
                            "G = " + base::to_text(1 + record["G/W1 - 1"], 6) +
                                " W1: the strip's ends are too near; raise Strip/length, and set "
                                "Strip/crack to its middle",
                            false});
      }
      return missed;
    }

    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() > end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    /// Of a quantity at each level, or of its limit or rate in each series.
    std::vector<double> values_of(const StudyResults &results, const scene::Expected &one)
    {
      const auto is_meant = [&](const auto &found)
      { return found.method == one.method && (one.series.empty() || found.series == one.series); };
      std::vector<double> values;
      for (const Limit &limit : results.limits)
        if (is_meant(limit))
        {
          if (one.problem == limit.quantity + " limit")
            values.push_back(limit.value);
          else if (one.problem == limit.quantity + " rate")
            values.push_back(limit.rate);
        }
      for (const Record &record : results.records)
        if (is_meant(record.key) && record.has(one.problem))
          values.push_back(record[one.problem]);
      return values;
    }

    bool is_for_lattices(const Method &method)
    {
      return method.can().count(method::Capability::lattice) > 0;
    }

    Methods named(const scene::Scene &scene, const Methods &available)
    {
      for (const scene::Expected &expected : scene.expected.all)
        (void)find_method(available, expected.method, "Expected");
      Methods methods = named_methods(scene, available, is_for_lattices);
      for (const auto &method : methods)
      {
        if (!is_for_lattices(*method))
          throw InputError("Methods/names: " + method->name() +
                           " is not for lattices, as strips are (Strip/length); take Galerkin "
                           "methods on quadrilaterals (Q1, DGQ1, ...) and meshfree rules");
        if (method->strip_solver() == nullptr)
          throw InputError("Methods/names: " + method->name() +
                           " solves no strip with a crack (Strip/length)");
      }
      return methods;
    }

    /// Nothing is made before its memory is there.
    void check_size(const scene::Scene &scene, const problem::Level &level, const Methods &methods,
                    unsigned int n_jobs)
    {
      constexpr double most_cells = 10000; // along a side
      const double m = level.horizon / level.h, n_height = scene.strip.height / level.h,
                   n_length = scene.strip.length / level.h, n_cells = n_height * n_length;
      const std::string what = "a strip of " + base::to_text(n_cells, 3) + " cells",
                        remedy = "choose a larger h (Study/h)";
      if (std::max(n_height, n_length) > most_cells)
        throw InputError(what + " has more than 10000 along a side; " + remedy);
      // as of growth: bonds with their books, and entries of the factor; or fields, and the intact
      // strip's two full matrices
      const double of_rules = 400 * .5 * M_PI * m * m * n_cells +
                              16 * 6 * m * m * n_cells * std::log2(std::max(2., n_cells)),
                   n_across = 4 * (n_height + 2 * m),
                   of_galerkin = 16 * 300 * n_cells + 16 * n_across * n_across;
      for (const auto &method : methods)
        base::require_memory(method->family() == MethodFamily::meshfree ? of_rules : of_galerkin,
                             what + " by " + method->name(), remedy, n_jobs);
    }

    Methods choose_for_strips(const scene::Scene &scene, const Methods &available,
                              unsigned int n_levels, unsigned int n_jobs)
    {
      if (!scene.strip.is_there())
        throw InputError("scene '" + scene.name +
                         "': Strip/length is 0, so that there is no strip; give it and "
                         "Strip/crack, or use 'plumbline run'");
      Methods methods = named(scene, available);
      for (const problem::Series &series : scene.study.series)
        for (std::size_t i = 0; i < series.levels.size() && (n_levels == 0 || i < n_levels); ++i)
          check_size(scene, series.levels[i], methods, n_jobs);
      return methods;
    }

    Records analyse(const Place &place, const Method &method)
    {
      const scene::Scene &scene = place.scene();
      const problem::Level &level = place.level();
      method::RiceStrip strip{cells(scene.strip.height, level.h),
                              cells(scene.strip.length, level.h),
                              cells(scene.strip.crack, level.h),
                              level.h,
                              {}};
      if (scene.strip.edges == scene::StripEdges::K_field)
        strip.K_tip = strip.n_crack + .5;
      const auto influence = physics::influence_function<2>(scene.kernel.profile, level.horizon);
      const method::StripSolver &solver = *method.strip_solver();
      const method::StripState state = solver.solve_strip(strip, influence);
      method::RiceStrip longer = strip;
      ++longer.n_crack;
      const double release =
          (state.energy - solver.solve_strip(longer, influence).energy) / level.h;
      std::optional<StripGrowth> growth;
      if (scene.strip.n_growth > 0)
        growth = grow_through_strip(solver,
                                    {strip,
                                     scene.strip.n_growth,
                                     {1, 1},
                                     problem::SurfaceTerms::uncorrected,
                                     scene.geometry.backend},
                                    influence);
      return {strip_record(place.record("strip", method), strip, state, release, growth)};
    }

    void conclude(const scene::Scene &scene, StudyResults &results)
    {
      results.facts = {{"edges", base::word(scene.strip.edges)},
                       {"height", base::to_text(scene.strip.height, 4)},
                       {"crack", base::to_text(scene.strip.crack, 4)},
                       {"mu", base::to_text(scene.material.lame()({}).mu, 4)}};
      results.limits = find_limits(results.records, quantities);
      if (results.is_complete)
        results.expectations = check_strip(results, scene.expected);
    }
  } // namespace

  Record strip_record(Record record, const method::RiceStrip &strip,
                      const method::StripState &state, double release,
                      const std::optional<StripGrowth> &growth)
  {
    record.cost.n_unknowns = state.n_unknowns;
    record.set("unknowns", static_cast<double>(state.n_unknowns));
    record.set("energy", state.energy, "mu length^2");
    record.set("release", release, "mu length");
    record.set("opening", state.opening.back(), "length");
    if (strip.K_tip)
    {
      record.set("K^2/E'", state.intact, "mu length");
      record.set("G", release / state.intact);
    }
    else
    {
      record.set("W1", state.intact, "mu length");
      record.set("tip energy", state.tip_energy(strip), "mu length^2");
      record.set("G/W1 - 1", release / state.intact - 1);
    }
    if (growth)
    {
      record.set("growth peak", growth->peak);
      record.set("growth mean", growth->mean);
      record.set("growth released", growth->released);
      record.set("growth bonds", growth->bonds);
    }
    // rules have nodes at the centres of columns
    const double shift = record.key.family == MethodFamily::meshfree ? .5 : 0;
    analysis::Curve opening = {{"from the tip", "length", {}}, {"opening", "length", {}}};
    for (std::size_t i = 0; i < state.opening.size(); ++i)
    {
      opening[0].values.push_back(
          (static_cast<double>(i + 1) - shift - static_cast<double>(state.opening.size())) *
          strip.h);
      opening[1].values.push_back(state.opening[i]);
    }
    record.curves["opening"] = std::move(opening);
    return record;
  }

  std::vector<Limit> find_limits(const Records &records, const std::vector<std::string> &quantities)
  {
    std::vector<Limit> limits;
    for (auto begin = records.begin(); begin != records.end();)
    {
      const auto end = std::find_if(begin, records.end(),
                                    [&](const Record &record)
                                    { return !record.key.is_same_series(begin->key); });
      for (const std::string &quantity : quantities)
      {
        std::vector<const Record *> levels;
        for (auto record = begin; record != end; ++record)
          if (record->has(quantity))
            levels.push_back(&*record);
        if (levels.size() < 3)
          continue;
        const std::size_t last = levels.size() - 1;
        const auto law = find_power_law(levels, last, quantity);
        if (!law)
          continue;
        const auto before = last > 2 ? find_power_law(levels, last - 1, quantity) : std::nullopt;
        limits.push_back({begin->key.method, begin->key.series, quantity, law->limit, law->rate,
                          before ? std::abs(law->limit - before->limit)
                                 : std::numeric_limits<double>::quiet_NaN()});
      }
      begin = end;
    }
    return limits;
  }

  std::vector<Agreement> find_agreements(const std::vector<Limit> &limits)
  {
    constexpr double certain = .05;
    std::vector<Agreement> all;
    for (const Limit &one : limits)
    {
      if (!(one.change <= certain * std::abs(one.value)))
        continue;
      const auto at =
          std::find_if(all.begin(), all.end(),
                       [&](const Agreement &other)
                       { return other.quantity == one.quantity && other.series == one.series; });
      if (at == all.end())
      {
        all.push_back({one.quantity, one.series, one.value, one.value, 1});
        continue;
      }
      at->least = std::min(at->least, one.value);
      at->largest = std::max(at->largest, one.value);
      ++at->n_methods;
    }
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const Agreement &one) { return one.n_methods < 2; }),
              all.end());
    return all;
  }

  std::vector<Expectation> check_strip(const StudyResults &results,
                                       const scene::ExpectedSection &expected)
  {
    std::vector<Expectation> checked = check_balance(results.records);
    const auto list = [](const std::vector<double> &values)
    {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : " ") + base::to_text(value, 8);
      return text;
    };
    for (const scene::Expected &one : expected.all)
    {
      const bool is_run =
          std::any_of(results.records.begin(), results.records.end(),
                      [&](const Record &record) { return record.key.method == one.method; });
      if (one.kind != scene::ExpectedKind::strip || !is_run)
        continue;
      const std::vector<double> values = values_of(results, one);
      // of the first levels alone, if there are no more
      bool holds = !values.empty() && values.size() <= one.values.size();
      for (std::size_t i = 0; holds && i < values.size(); ++i)
        holds =
            std::abs(values[i] - one.values[i]) <=
            (ends_with(one.problem, " rate") ? expected.rate_tolerance
                                             : expected.error_tolerance * std::abs(one.values[i]));
      checked.push_back({"Expected/strip: " + one.text, list(one.values),
                         values.empty() ? "no such value" : list(values), holds});
    }
    return checked;
  }

  Analysis strip_analysis()
  {
    Analysis analysis{"strip", "Stationary crack"};
    analysis.choose_methods = choose_for_strips;
    analysis.analyse = analyse;
    analysis.conclude = conclude;
    analysis.sampled = quantities;
    for (const char *const name :
         {"release", "growth peak", "growth mean", "growth released", "growth bonds"})
      analysis.sampled.emplace_back(name);
    return analysis;
  }
} // namespace plumbline::study
