#include "report/sampling_page.h"

#include "report/page_parts.h"
#include "report/text_table.h"
#include "report/view.h"
#include "study/sampling_balance.h"
#include "study/seeds.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using study::CaseStatistics;
    using study::SamplingResults;
    using study::SetStatistics;

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
      if (sampling.rule == uq::SampleRule::smolyak)
        text += " (growth " + base::word(sampling.growth) + ")";
      if (sampling.rule == uq::SampleRule::monte_carlo)
        text += " (Sampling/seed = " + std::to_string(sampling.seed) + ")";
      text += ", " + std::to_string(r.random.laws().size()) + " variables, " +
              std::to_string(r.n_samples) + " samples in all sets";
      if (r.spectrum)
        text += ". " + words_of(*r.spectrum);
      if (const std::string seeds = study::seed_words(r.random, r.n_samples); !seeds.empty())
        text += ". " + seeds;
      if (r.sampling.is_axis())
        text +=
            ". Nothing is by chance: variables go from end to end, and means and deviations are "
            "those over the intervals, by the trapezoidal rule";
      else if (const SetStatistics *const set = best(r))
        text += ". Weights of the largest set: sum of sizes " + rounded(set->sum_of_sizes) +
                ", noise √Σw² " + rounded(set->noise) +
                (set->noise > 1 ? ", by which independent errors of samples grow"
                                : ", by which independent errors of samples shrink");
      if (sampling.rule == uq::SampleRule::monte_carlo)
        text += ". Intervals hold means with 95 % confidence, by Student's t, but for the errors "
                "that all samples have in common, as those of h";
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
            (is_own(r) ? "a relative difference of the mean" : "a relative error of the mean") +
            " of " + short_power(pair.target) + ": " + pair.method + " at h = " + rounded(pair.h) +
            " with count " + std::to_string(pair.count) +
            (r.sampling.modes.empty() ? "" : " and " + std::to_string(pair.n_modes) + " modes") +
            ", error " + rounded(pair.error) + ", " + rounded_seconds(pair.seconds) + " of CPU. ";
      }
      for (const std::string &fault : faults)
        text += "EXPECTED: " + fault + ". ";
      if (const SetStatistics *const set = best(r); set != nullptr && r.cheapest.empty())
        for (const auto &[name, s] : set->quantities)
          if (name.size() > 2 && name.compare(0, 2, "K ") == 0)
            text +=
                "Mean of " + name + " " + rounded(s.mean) +
                (s.deviation() ? ", deviation " + rounded(*s.deviation()) : "") +
                (s.standard_error > 0
                     ? ", standard error " + rounded(s.standard_error) + ", with 95 % confidence " +
                           rounded(s.mean - s.confidence) + " to " + rounded(s.mean + s.confidence)
                     : "") +
                ". ";
      return text.empty() ? "All samples are there." : text;
    }

    /// A sentence for each method and level.
    std::vector<std::string> balance(const SamplingResults &r)
    {
      std::vector<std::string> sentences;
      for (const study::SamplingBalance &one : r.balance)
        sentences.push_back(words_of(one, !r.sampling.modes.empty()));
      return sentences;
    }

    std::string samples_file(const CaseStatistics &one)
    {
      return "sample/samples_" +
             slug(one.of.method + "_" + one.of.problem + "_" + one.of.series + "_" +
                  rounded(one.of.h)) +
             ".csv";
    }

    /// Of each method at its finest level, folded.
    Data samples(const SamplingResults &r)
    {
      constexpr std::size_t most_rows = 100, most_variables = 10; // that a page has room for
      Data list = Data::array();
      for (const CaseStatistics &one : r.cases)
      {
        if (!one.is_finest || one.samples.empty())
          continue;
        std::string what = "Samples of " + one.of.method +
                           (one.of.problem.empty() ? "" : ", " + one.of.problem) + ", " +
                           one.of.series + ", h = " + rounded(one.of.h);
        if (one.samples.size() > most_rows)
          what += ": the first " + std::to_string(most_rows) + " of " +
                  std::to_string(one.samples.size());
        if (r.variables.size() > most_variables)
          what += ", with the first " + std::to_string(most_variables) + " of " +
                  std::to_string(r.variables.size()) + " variables";
        Data table = page::table(sampling_samples_table(r, one, most_rows, most_variables));
        table["summary"] = what;
        table["file"] = samples_file(one);
        list.push_back(std::move(table));
      }
      return list;
    }

    std::string page_of(const SamplingResults &r, const std::vector<std::string> &faults,
                        const std::filesystem::path &dir)
    {
      std::vector<std::string> facts = {base::word(r.sampling.rule),
                                        std::to_string(r.n_samples) + " samples"};
      if (r.n_expected > 0)
        facts.push_back(faults.empty() ? "✓ as expected" : "✗ not as expected");
      Data data = page::begin("sample", r.scene_name, r.purpose, facts);
      data["verdict"] = verdict(r, faults);
      data["findings"] = r.findings;
      data["has_findings"] = !r.findings.empty();
      data["charts"] = page::charts(sampling_charts(r), dir, "sample");
      if (has_damage_maps(r))
        data["charts"].push_back(page::figure(
            {dir / "sample/damage.svg", "damage-", "Where bonds are broken",
             "Mean and deviation over the samples of the largest set, of the part of each node's "
             "bonds that is broken or cut." +
                 std::string(best(r)->negative_part > 0
                                 ? " Where the variance is negative it has no root, and the "
                                   "deviation is drawn as 0."
                                 : ""),
             "Picture", "sample/damage.svg"}));
      data["own"] = is_own(r) ? words_of_own : "";
      data["fields"] = page::table(sampling_field_table(r));
      data["cheapest"] = page::table(sampling_cheapest_table(r));
      data["balance"] = balance(r);
      data["has_balance"] = !r.balance.empty();
      data["quantities"] = page::table(sampling_quantity_table(r));
      data["failures"] = page::table(sampling_failure_table(r));
      data["rule"] = rule_words(r);
      data["samples"] = samples(r);
      data["scene_text"] = r.scene_text;
      return fill("sample", data);
    }
  } // namespace

  std::string sampling_summary(const SamplingResults &r, const std::string &files)
  {
    constexpr std::size_t most_of_rule = 4, most_of_one = 2, most_sentences = 3;
    std::vector<std::string> end = {""}, sentences = r.findings;
    const auto add = [&](const std::string &words, std::size_t most, std::size_t indent = 0)
    {
      const std::vector<std::string> lines = short_lines(words, most, indent);
      end.insert(end.end(), lines.begin(), lines.end());
    };
    add(rule_words(r), most_of_rule);
    for (const std::string &one : balance(r))
      sentences.push_back(one);
    if (is_own(r))
      sentences.insert(sentences.begin(), words_of_own);
    for (std::size_t i = 0; i < std::min(most_sentences, sentences.size()); ++i)
      add("- " + sentences[i], most_of_one, 2);
    if (sentences.size() > most_sentences)
      end.push_back("  and " + std::to_string(sentences.size() - most_sentences) +
                    " more findings in the report");
    end.push_back("report: " + files);
    end.emplace_back();
    add(verdict(r, {}), most_of_one);
    return summary(
        heading(r.scene_name, r.purpose),
        {{"", "", "", sampling_quantity_table(r)}, {"", "", "", sampling_field_table(r)}}, end);
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
      for (const auto &sentences : {r.findings, balance(r)})
        for (const std::string &one : sentences)
          text += "- " + one + "\n";
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
      write_file(dir / samples_file(one), to_csv(sampling_samples_table(results, one)));
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
