#include "report/sampling_page.h"

#include "report/page_parts.h"
#include "report/seeds.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using study::CaseStatistics;
    using study::SamplingResults;
    using study::SetStatistics;

    Cell known_error(const std::optional<double> &value)
    {
      return value ? error_cell(*value) : empty_cell();
    }

    std::vector<Cell> names(const CaseStatistics &one)
    {
      return {text_cell(one.of.method), text_cell(one.of.problem), text_cell(one.of.series),
              number_cell(one.of.h)};
    }

    /// Only where sets differ by them.
    Cell modes_cell(const SamplingResults &results, unsigned int n_modes)
    {
      return results.sampling.modes.empty() ? empty_cell() : count_cell(n_modes);
    }

    bool is_own(const SamplingResults &results)
    {
      return results.target == base::word(scene::Target::finest);
    }

    const char *const words_of_own =
        "No exact statistics are known. Errors are differences to the last set at each method's "
        "finest level: at coarser levels of mesh, samples and modes, at that level of samples and "
        "modes alone, so that it is in no advice and not in the charts over h and time.";

    const SetStatistics *best(const SamplingResults &results)
    {
      return results.cases.empty() || results.cases.back().sets.empty()
                 ? nullptr
                 : &results.cases.back().sets.back();
    }

    /// What the rule is, and what its weights do.
    std::string rule_words(const SamplingResults &r)
    {
      const auto &sampling = r.sampling;
      std::string text = base::word(sampling.rule);
      if (sampling.rule == random::SampleRule::smolyak)
        text += " (growth " + base::word(sampling.growth) + ")";
      if (sampling.rule == random::SampleRule::monte_carlo)
        text += " (Sampling/seed = " + std::to_string(sampling.seed) + ")";
      text += ", " + std::to_string(r.random.laws().size()) + " variables, " +
              std::to_string(r.n_samples) + " samples in all sets";
      if (r.spectrum)
        text += ". " + words_of(*r.spectrum);
      if (const std::string seeds = seed_words(r.random, r.n_samples); !seeds.empty())
        text += ". " + seeds;
      if (const SetStatistics *const set = best(r))
        text += ". Weights of the largest set: sum of sizes " + rounded(set->sum_of_sizes) +
                ", noise √Σw² " + rounded(set->noise) +
                (set->noise > 1 ? ", by which independent errors of samples grow"
                                : ", by which independent errors of samples shrink");
      return text + ".";
    }

    std::string verdict(const SamplingResults &r, const std::vector<std::string> &faults)
    {
      std::string text = r.is_complete ? "" : "Not all samples are there yet. ";
      if (!r.failures.empty())
        text += std::to_string(r.failures.size()) + " of " + std::to_string(r.n_samples) +
                " samples failed. ";
      if (!r.cheapest.empty())
      {
        const study::CheapestPair &pair = r.cheapest.back();
        text +=
            std::string("Cheapest to ") +
            (is_own(r) ? "a difference of the mean" : "an error of the mean") + " of " +
            short_power(pair.target) + ": " + pair.method + " at h = " + rounded(pair.h) +
            " with count " + std::to_string(pair.count) +
            (r.sampling.modes.empty() ? "" : " and " + std::to_string(pair.n_modes) + " modes") +
            ", error " + rounded(pair.error) + ", " + rounded_seconds(pair.seconds) + " of CPU. ";
      }
      for (const std::string &fault : faults)
        text += "EXPECTED: " + fault + ". ";
      if (const SetStatistics *const set = best(r); set != nullptr && r.cheapest.empty())
        for (const auto &[name, s] : set->quantities)
          if (name.size() > 2 && name.compare(0, 2, "K ") == 0)
            text += "Mean of " + name + " " + rounded(s.mean) +
                    (s.deviation() ? ", deviation " + rounded(*s.deviation()) : "") +
                    (s.standard_error > 0 ? ", standard error " + rounded(s.standard_error) : "") +
                    ". ";
      return text.empty() ? "All samples are there." : text;
    }

    Table cheapest_table(const SamplingResults &r)
    {
      Table table;
      table.columns = {"error of the mean below",
                       "method",
                       "problem",
                       "series",
                       "h",
                       "modes",
                       "count",
                       "error",
                       "CPU seconds"};
      for (const study::CheapestPair &pair : r.cheapest)
        table.rows.push_back({text_cell(short_power(pair.target)), text_cell(pair.method),
                              text_cell(pair.problem), text_cell(pair.series), number_cell(pair.h),
                              modes_cell(r, pair.n_modes), count_cell(pair.count),
                              error_cell(pair.error), number_cell(pair.seconds)});
      return without_empty_columns(table);
    }

    Table failure_table(const SamplingResults &r)
    {
      Table table;
      table.columns = {"sample", "values", "reason"};
      for (const study::SampleFailure &failure : r.failures)
      {
        std::string values;
        for (const double value : failure.values)
          values += (values.empty() ? "" : ", ") + rounded(value);
        table.rows.push_back(
            {count_cell(failure.sample), text_cell(values), text_cell(failure.reason)});
      }
      return table;
    }

    Table samples_table(const CaseStatistics &one)
    {
      Table table;
      std::size_t n = 0;
      for (const auto &[name, values] : one.values)
      {
        table.columns.emplace_back(name);
        n = std::max(n, values.size());
      }
      for (std::size_t i = 0; i < n; ++i)
      {
        table.rows.emplace_back();
        for (const auto &[name, values] : one.values)
          table.rows.back().push_back(i < values.size() ? number_cell(values[i]) : empty_cell());
      }
      return table;
    }

    std::string findings(const SamplingResults &r)
    {
      std::string text;
      for (const std::string &one : r.findings)
        text += "<li>" + escape_html(one) + "</li>\n";
      return text.empty() ? "" : "<ul>\n" + text + "</ul>\n";
    }

    std::string page_of(const SamplingResults &r, const std::vector<std::string> &faults,
                        const std::filesystem::path &dir)
    {
      std::vector<std::string> facts = {base::word(r.sampling.rule),
                                        std::to_string(r.n_samples) + " samples"};
      if (r.n_expected > 0)
        facts.push_back(faults.empty() ? "✓ as expected" : "✗ not as expected");
      const std::string header = page::plain_header(r.scene_name, "sample", r.purpose, facts);
      std::string pictures;
      for (const DataChart &chart : sampling_charts(r))
        pictures += page::figure(
            dir / "sample" / chart.plot.file, chart.name + "-", chart.plot.title,
            chart.caption + " Data: <code>sample/" + chart.name + ".csv</code>", false);
      if (has_damage_maps(r))
        pictures += page::figure(dir / "sample/damage.svg", "damage-", "Where bonds are broken",
                                 "Mean and deviation over the samples of the largest set, of the "
                                 "part of each node's bonds that is broken or cut.",
                                 false);
      std::string numbers = is_own(r) ? page::paragraph(words_of_own) : "";
      numbers += to_html(sampling_field_table(r));
      if (!r.cheapest.empty())
        numbers += page::paragraph("Pairs of h and samples that reach an error most cheaply.") +
                   to_html(cheapest_table(r));
      numbers +=
          page::paragraph("Quantities at the finest level.") + to_html(sampling_quantity_table(r));
      if (!r.failures.empty())
        numbers +=
            page::paragraph("Samples that failed; the others stand.") + to_html(failure_table(r));
      return page::document(
          r.scene_name, "sample", header,
          page::section("picture", "What samples say",
                        "<p class=\"answer\">" + escape_html(verdict(r, faults)) + "</p>\n" +
                            findings(r) + "<div class=\"grid\">\n" + pictures + "</div>\n") +
              page::section("numbers", "Numbers", numbers) +
              page::section("rule", "Rule and samples", page::paragraph(rule_words(r))) +
              page::section(
                  "scene", "The scene",
                  page::folded("as read", "<pre>" + escape_html(r.scene_text) + "</pre>")));
    }

    Json known(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }

    Json known(const std::optional<double> &value)
    {
      return value ? known(*value) : Json();
    }

    Json to_json(const SetStatistics &set)
    {
      Json json{{"count", set.count},
                {"modes", set.n_modes},
                {"samples", set.n_samples},
                {"missing", set.n_missing},
                {"sum_of_sizes", set.sum_of_sizes},
                {"noise", set.noise},
                {"seconds", set.seconds},
                {"mean_size", set.mean_size},
                {"deviation_size", set.deviation_size},
                {"standard_error", set.standard_error},
                {"negative_variance_part", set.negative_part},
                {"mean_error", known(set.mean_error)},
                {"deviation_error", known(set.deviation_error)},
                {"mean_uncertainty", set.mean_uncertainty},
                {"deviation_uncertainty", set.deviation_uncertainty},
                {"quantities", Json::object()}};
      for (const auto &[name, s] : set.quantities)
        json["quantities"][name] = {{"mean", known(s.mean)},
                                    {"variance", known(s.variance)},
                                    {"deviation", known(s.deviation())},
                                    {"standard_error", known(s.standard_error)},
                                    {"least", known(s.least)},
                                    {"largest", known(s.largest)}};
      return json;
    }
  } // namespace

  Table sampling_field_table(const SamplingResults &results)
  {
    Table table;
    table.columns = {"method",
                     "problem",
                     "series",
                     "h",
                     "modes",
                     "count",
                     "samples",
                     "missing",
                     "‖mean‖",
                     "‖deviation‖",
                     "error of the mean",
                     "error of the deviation",
                     "standard error",
                     "noise",
                     "CPU seconds"};
    for (const CaseStatistics &one : results.cases)
      for (const SetStatistics &set : one.sets)
      {
        std::vector<Cell> row = names(one);
        const bool is_random = results.sampling.rule == random::SampleRule::monte_carlo;
        for (const Cell &cell :
             {modes_cell(results, set.n_modes), count_cell(set.count), count_cell(set.n_samples),
              known(set.n_missing > 0, count_cell(set.n_missing)), number_cell(set.mean_size),
              number_cell(set.deviation_size), known_error(set.mean_error),
              known_error(set.deviation_error), known(is_random, error_cell(set.standard_error)),
              number_cell(set.noise), number_cell(set.seconds)})
          row.push_back(cell);
        table.rows.push_back(std::move(row));
      }
    return without_empty_columns(table);
  }

  Table sampling_quantity_table(const SamplingResults &results)
  {
    Table table;
    table.columns = {"method",         "problem", "series",  "h",    "quantity",
                     "modes",          "count",   "samples", "mean", "deviation",
                     "standard error", "least",   "largest"};
    for (const CaseStatistics &one : results.cases)
    {
      for (const SetStatistics &set : one.sets)
        for (const auto &[name, s] : set.quantities)
        {
          if (!one.is_finest)
            continue;
          std::vector<Cell> row = names(one);
          for (const Cell &cell :
               {text_cell(name), modes_cell(results, set.n_modes), count_cell(set.count),
                count_cell(set.n_samples), number_cell(s.mean),
                s.deviation() ? number_cell(*s.deviation())
                              : text_cell("unknown: variance " + rounded(s.variance)),
                known(s.standard_error > 0, error_cell(s.standard_error)), number_cell(s.least),
                number_cell(s.largest)})
            row.push_back(cell);
          table.rows.push_back(std::move(row));
        }
    }
    return without_empty_columns(table);
  }

  std::string sampling_text(const SamplingResults &r)
  {
    std::string text = r.scene_name + ": " + r.purpose + "\n\n" + to_text(sampling_field_table(r)) +
                       "\n" + to_text(sampling_quantity_table(r)) + "\n" +
                       wrapped(rule_words(r), 120) + "\n";
    if (is_own(r))
      text += wrapped(words_of_own, 120) + "\n";
    for (const std::string &finding : r.findings)
      text += "- " + wrapped(finding, 120, 2) + "\n";
    return text + "\n" + wrapped(verdict(r, {}), 120) + "\n";
  }

  std::string sampling_json(const SamplingResults &r)
  {
    const bool has_field = r.random.field != scene::FieldKind::none;
    Json json{{"scene", r.scene_name},
              {"rule", base::word(r.sampling.rule)},
              {"growth", base::word(r.sampling.growth)},
              {"seed", r.sampling.seed},
              {"field_seed", has_field ? Json(r.random.seed) : Json()},
              {"target", r.target},
              {"n_samples", r.n_samples},
              {"variance_kept", r.spectrum ? Json(r.spectrum->variance_kept()) : Json()},
              {"spectrum", r.spectrum ? Json(r.spectrum->share) : Json::array()},
              {"is_complete", r.is_complete},
              {"findings", r.findings},
              {"failures", Json::array()},
              {"cheapest", Json::array()},
              {"cases", Json::array()},
              {"scene_text", r.scene_text}};
    for (const auto &failure : r.failures)
      json["failures"].push_back(
          {{"sample", failure.sample}, {"values", failure.values}, {"reason", failure.reason}});
    for (const auto &pair : r.cheapest)
      json["cheapest"].push_back({{"target", pair.target},
                                  {"method", pair.method},
                                  {"problem", pair.problem},
                                  {"series", pair.series},
                                  {"h", pair.h},
                                  {"count", pair.count},
                                  {"modes", pair.n_modes},
                                  {"error", pair.error},
                                  {"seconds", pair.seconds}});
    for (const CaseStatistics &one : r.cases)
    {
      Json entry{{"method", one.of.method}, {"problem", one.of.problem},
                 {"series", one.of.series}, {"level", one.of.level},
                 {"h", one.of.h},           {"horizon", one.of.horizon},
                 {"sets", Json::array()}};
      for (const SetStatistics &set : one.sets)
        entry["sets"].push_back(to_json(set));
      json["cases"].push_back(std::move(entry));
    }
    return json.dump(2) + "\n";
  }

  namespace
  {
    std::string markdown(const SamplingResults &r, const std::vector<std::string> &faults)
    {
      std::string text = "# Samples: " + r.scene_name + "\n\n" + verdict(r, faults) + "\n\n" +
                         to_markdown(sampling_field_table(r)) + "\n" +
                         to_markdown(sampling_quantity_table(r)) + "\n" + rule_words(r) + "\n\n";
      if (is_own(r))
        text += std::string(words_of_own) + "\n\n";
      for (const std::string &finding : r.findings)
        text += "- " + finding + "\n";
      return text;
    }
  } // namespace

  void write_sampling(const SamplingResults &results, const std::vector<std::string> &faults,
                      const std::filesystem::path &dir)
  {
    write_file(dir / "sample.json", sampling_json(results));
    write_file(dir / "sample.md", markdown(results, faults));
    write_file(dir / "sample/fields.csv", to_csv(sampling_field_table(results)));
    write_file(dir / "sample/quantities.csv", to_csv(sampling_quantity_table(results)));
    for (const CaseStatistics &one : results.cases)
      write_file(dir / ("sample/samples_" +
                        slug(one.of.method + "_" + one.of.problem + "_" + one.of.series + "_" +
                             rounded(one.of.h)) +
                        ".csv"),
                 to_csv(samples_table(one)));
    write_with_pictures(
        dir / "sample.html",
        [&]
        {
          write_charts(sampling_charts(results), dir / "sample");
          write_damage_maps(results, dir / "sample");
        },
        [&] { return page_of(results, faults, dir); });
  }
} // namespace plumbline::report
