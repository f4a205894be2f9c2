#include "report/sampling_page.h"

#include "report/counted.h"
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
        "No exact statistics are known. Errors are differences from the last set at the finest "
        "level "
        "of each method. At the finest level itself they show the effect of samples and modes "
        "alone; it is therefore left out of the advice and of the charts versus h and CPU time.";

    const char *const words_of_interpolant =
        "Error of the interpolant: the maximum of ‖u(ξ) − u^Q(ξ)‖, L2, over at most 32 samples of "
        "the last set that the set does not contain; u^Q is the polynomial through the samples of "
        "the set (Fan et al. 2022, section 3.2). Lebesgue constant: largest factor by which u^Q "
        "amplifies errors of samples; if two are given, it lies between them.";

    bool has_interpolant(const SamplingResults &results)
    {
      for (const CaseStatistics &one : results.cases)
        for (const SetStatistics &set : one.sets)
          if (set.interpolation_error || set.lebesgue)
            return true;
      return false;
    }

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
      const std::size_t n_variables = r.random.laws().size();
      std::string text = "Sampling rule: " + base::word(sampling.rule);
      if (sampling.rule == uq::SampleRule::smolyak)
        text += " (growth " + base::word(sampling.growth) + ")";
      if (sampling.rule == uq::SampleRule::monte_carlo)
        text += " (Sampling/seed = " + std::to_string(sampling.seed) + ")";
      text += ", " + counted(n_variables, "variable") + ", " + counted(r.n_samples, "sample") +
              " in all sets";
      if (r.spectrum)
        text += ". " + words_of(*r.spectrum);
      if (const std::string seeds = study::seed_words(r.random, r.n_samples); !seeds.empty())
        text += ". " + seeds;
      if (r.sampling.is_axis())
        text += ". The variables are not random: they run from end to end of their intervals, over "
                "which means and deviations are taken by the trapezoidal rule";
      else if (const SetStatistics *const set = best(r))
        text += ". Weights w of the largest set: Σ|w| = " + rounded(set->sum_of_sizes) +
                ", amplification factor of the sampling noise ‖w‖₂ = " + rounded(set->noise) +
                (set->noise > 1 ? " (independent errors of the samples are amplified)"
                                : " (independent errors of the samples are reduced)");
      if (sampling.rule == uq::SampleRule::monte_carlo)
        text += ". Confidence intervals of means (95 %, Student's t) do not include errors that "
                "all samples have in common, such as that of h";
      return text + ".";
    }

    std::string words_of_modes(const SamplingResults &r, unsigned int n_modes)
    {
      return r.sampling.modes.empty() ? "" : " and " + counted(n_modes, "mode");
    }

    bool is_toughness(const std::string &quantity)
    {
      return quantity.compare(0, 2, "K ") == 0;
    }

    /// Means of the largest set: of the stress intensities if there are any, or else of the first
    /// few quantities that vary.
    std::string mean_words(const SamplingResults &r)
    {
      constexpr std::size_t most = 5;
      const SetStatistics *const set = best(r);
      if (set == nullptr || r.sampling.is_axis())
        return "";
      const bool has_toughness =
          std::any_of(set->quantities.begin(), set->quantities.end(),
                      [](const auto &one) { return is_toughness(one.first); });
      std::string text;
      std::size_t n = 0;
      for (const auto &[name, s] : set->quantities)
        if (n < most && (has_toughness ? is_toughness(name) : !is_constant(s)))
          text += std::string(n++ == 0 ? "" : "; ") + name + " " + rounded(s.mean) +
                  (s.deviation() ? ", standard deviation " + rounded(*s.deviation()) : "") +
                  (s.standard_error > 0
                       ? ", standard error " + rounded(s.standard_error) +
                             ", 95 % confidence interval " + rounded(s.mean - s.confidence) +
                             " to " + rounded(s.mean + s.confidence)
                       : "");
      const study::SampleCase &of = r.cases.back().of;
      return text.empty() ? ""
                          : "Means by " + of.method + " at h = " + rounded(of.h) + " over " +
                                counted(set->n_samples, "sample") + ": " + text + ". ";
    }

    /// Of all sets but those of a level that is its own target.
    std::string least_error_words(const SamplingResults &r)
    {
      const CaseStatistics *of = nullptr;
      const SetStatistics *least = nullptr;
      for (const CaseStatistics &one : r.cases)
        for (const SetStatistics &set : one.sets)
          if (!one.is_target_level && set.mean_error &&
              (least == nullptr || *set.mean_error < *least->mean_error))
          {
            of = &one;
            least = &set;
          }
      return least == nullptr
                 ? ""
                 : "The smallest error of the mean, " + rounded(*least->mean_error) +
                       " [unit of the field], is that of " + of->of.method +
                       " at h = " + rounded(of->of.h) + " with count " +
                       std::to_string(least->count) + words_of_modes(r, least->n_modes) + ". ";
    }

    std::string verdict(const SamplingResults &r, const std::vector<std::string> &faults)
    {
      std::string text = r.is_complete ? "" : "Not all samples have been computed yet. ";
      if (!r.failures.empty())
        text += std::to_string(r.failures.size()) + " of " + counted(r.n_samples, "sample") +
                " failed. ";
      if (!r.cheapest.empty())
      {
        const study::CheapestPair &pair = r.cheapest.back();
        text += mean_words(r) + pair.method + " at h = " + rounded(pair.h) + " with count " +
                std::to_string(pair.count) + words_of_modes(r, pair.n_modes) +
                " is the cheapest choice with a relative " + (is_own(r) ? "difference" : "error") +
                " of the mean below " + short_power(pair.target) + ": error at most " +
                rounded(pair.error) + " [unit of the field] with this count and larger ones, " +
                rounded_seconds(pair.seconds) + " of CPU time. ";
      }
      else
      {
        const std::string means = mean_words(r);
        text += means.empty() ? least_error_words(r) : means;
      }
      for (std::size_t i = 0; i < faults.size(); ++i)
        text += (i == 0 ? "Not as expected: " : "; ") + faults[i] +
                (i + 1 == faults.size() ? ". " : "");
      if (!text.empty())
        text.pop_back(); // the space after the last sentence
      return text.empty() ? "All samples have been computed." : text;
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
                                        counted(r.n_samples, "sample")};
      if (r.n_expected > 0)
        facts.push_back(faults.empty() ? "✓ as expected" : "✗ not as expected");
      Data data = page::begin("sample", r.scene_name, r.purpose, facts);
      data["verdict"] = verdict(r, faults);
      data["findings"] = r.findings;
      data["has_findings"] = !r.findings.empty();
      data["charts"] = page::charts(sampling_charts(r), dir, "sample");
      if (has_damage_maps(r))
        data["charts"].push_back(page::figure(
            {dir / "sample/damage.svg", "damage-", "Damage: broken bonds",
             "Mean and standard deviation, over the samples of the largest set, of the fraction of "
             "each node's bonds that is broken or cut." +
                 std::string(best(r)->negative_part > 0
                                 ? " Where the variance is negative, the deviation is drawn as 0."
                                 : ""),
             "Picture", "sample/damage.svg"}));
      data["has_results"] = !r.findings.empty() || !data["charts"].empty();
      data["own"] = is_own(r) ? words_of_own : "";
      data["fields"] = page::table(sampling_field_table(r));
      data["interpolant"] = has_interpolant(r) ? words_of_interpolant : "";
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
        {heading(r.scene_name, r.purpose)},
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
