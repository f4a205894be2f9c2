#include "report/sampling_page.h"

#include "report/counted.h"
#include "report/text_table.h"
#include "study/rule_comparison.h"
#include "study/sampling_balance.h"
#include "study/seeds.h"

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
      return results.cases.empty() ? nullptr : results.cases.back().leading();
    }

    /// Where there are several.
    std::string by_rule(const SamplingResults &results, uq::SampleRule rule)
    {
      return results.sampling.has_several_rules() ? " by " + base::word(rule) : "";
    }

    /// What a rule's weights do.
    std::string weight_words(const SamplingResults &r, const SetStatistics &set)
    {
      return ". Weights w of the largest set" + by_rule(r, set.rule) +
             ": Σ|w| = " + rounded(set.sum_of_sizes) +
             ", amplification factor of the sampling noise ‖w‖₂ = " + rounded(set.noise) +
             (set.noise > 1 ? " (independent errors of the samples are amplified)"
                            : " (independent errors of the samples are reduced)");
    }

    /// What the rules are, and what their weights do.
    std::string rule_words(const SamplingResults &r)
    {
      const auto &sampling = r.sampling;
      const std::size_t n_variables = r.random.laws().size();
      std::string text = sampling.has_several_rules() ? "Sampling rules: " : "Sampling rule: ";
      for (std::size_t i = 0; i < sampling.rules.size(); ++i)
      {
        text += (i == 0 ? "" : ", ") + base::word(sampling.rules[i]);
        if (sampling.rules[i] == uq::SampleRule::smolyak)
          text += " (growth " + base::word(sampling.growth) + ")";
        if (sampling.rules[i] == uq::SampleRule::monte_carlo)
          text += " (Sampling/seed = " + std::to_string(sampling.seed) + ")";
      }
      text += ", " + counted(n_variables, "variable") + ", " + counted(r.n_samples, "sample") +
              " in all sets";
      if (r.spectrum)
        text += ". " + words_of(*r.spectrum);
      if (const std::string seeds = study::seed_words(r.random, r.n_samples); !seeds.empty())
        text += ". " + seeds;
      if (r.sampling.is_axis())
        text += ". The variables are not random: they run from end to end of their intervals, over "
                "which means and deviations are taken by the trapezoidal rule";
      else if (!r.cases.empty())
        for (const uq::SampleRule rule : sampling.rules)
          if (const SetStatistics *const set = r.cases.back().last_of(rule))
            text += weight_words(r, *set);
      if (std::count(sampling.rules.begin(), sampling.rules.end(), uq::SampleRule::monte_carlo) > 0)
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
      const study::Key &of = r.cases.back().of;
      return text.empty() ? ""
                          : "Means by " + of.method + " at h = " + rounded(of.h) + " over " +
                                counted(set->n_samples, "sample") + by_rule(r, set->rule) + ": " +
                                text + ". ";
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
                       std::to_string(least->count) + words_of_modes(r, least->n_modes) +
                       by_rule(r, least->rule) + ". ";
    }

    /// Of the least target, which several rules may reach.
    const study::CheapestPair &cheapest_of_rules(const SamplingResults &r)
    {
      const study::CheapestPair *least = &r.cheapest.back();
      for (const study::CheapestPair &pair : r.cheapest)
        if (pair.target == least->target && pair.problem == least->problem &&
            pair.series == least->series && pair.seconds < least->seconds)
          least = &pair;
      return *least;
    }

    std::string verdict(const SamplingResults &r, const std::vector<std::string> &faults)
    {
      std::string text = r.is_complete ? "" : "Not all samples have been computed yet. ";
      if (!r.failures.empty())
        text += std::to_string(r.failures.size()) + " of " + counted(r.n_samples, "sample") +
                " failed. ";
      if (!r.cheapest.empty())
      {
        const study::CheapestPair &pair = cheapest_of_rules(r);
        text += mean_words(r) + pair.method + " at h = " + rounded(pair.h) + " with count " +
                std::to_string(pair.count) + words_of_modes(r, pair.n_modes) +
                by_rule(r, pair.rule) + " is the cheapest choice with a relative " +
                (is_own(r) ? "difference" : "error") + " of the mean below " +
                short_power(pair.target) + ": error at most " + rounded(pair.error) +
                " [unit of the field] with this count and larger ones, " +
                rounded_seconds(pair.seconds) + " of CPU time. ";
      }
      else
      {
        const std::string means = mean_words(r);
        text += means.empty() ? least_error_words(r) : means;
      }
      if (!r.comparisons.empty())
        text += words_of(r.comparisons.front()) + ". ";
      for (std::size_t i = 0; i < faults.size(); ++i)
        text += (i == 0 ? "Not as expected: " : "; ") + faults[i] +
                (i + 1 == faults.size() ? ". " : "");
      if (!text.empty())
        text.pop_back(); // the space after the last sentence
      return text.empty() ? "All samples have been computed." : text;
    }

    /// A sentence for each method and level; before them those of rules that the verdict has not.
    std::vector<std::string> balance(const SamplingResults &r)
    {
      std::vector<std::string> sentences;
      for (std::size_t i = 1; i < r.comparisons.size(); ++i)
        sentences.push_back(words_of(r.comparisons[i]));
      for (const study::SamplingBalance &one : r.balance)
        sentences.push_back(
            words_of(one, !r.sampling.modes.empty(), r.sampling.has_several_rules()));
      return sentences;
    }

    /// In the folder of tables, without ending.
    std::string samples_file(const CaseStatistics &one)
    {
      return "samples_" + slug(one.of.method + "_" + one.of.problem + "_" + one.of.series + "_" +
                               rounded(one.of.h));
    }

    /// Of a method at its finest level.
    Part samples(const SamplingResults &r, const CaseStatistics &one)
    {
      constexpr std::size_t most_rows = 100, most_variables = 10; // that a page has room for
      Part part{"samples",
                "Samples of " + one.of.method +
                    (one.of.problem.empty() ? "" : ", " + one.of.problem) + ", " + one.of.series +
                    ", h = " + rounded(one.of.h) + by_rule(r, r.sampling.rules.front()),
                "",
                sampling_samples_table(r, one, most_rows, most_variables),
                true,
                Fold::closed};
      if (one.samples.size() > most_rows)
        part.head += ": the first " + std::to_string(most_rows) + " of " +
                     std::to_string(one.samples.size());
      if (r.variables.size() > most_variables)
        part.head += ", with the first " + std::to_string(most_variables) + " of " +
                     std::to_string(r.variables.size()) + " variables";
      part.file = samples_file(one);
      part.is_excerpt = true;
      return part;
    }

    /// What any page has.
    study::StudyResults header(const SamplingResults &r)
    {
      study::StudyResults results;
      results.analysis = "sample";
      results.scene_name = r.scene_name;
      results.purpose = r.purpose;
      results.scene_text = r.scene_text;
      return results;
    }

    View sampling_view(const SamplingResults &r, const std::vector<std::string> &faults)
    {
      constexpr std::size_t most_of_rule = 4;
      View view{"Samples"};
      view.answer = verdict(r, faults);
      view.facts = {r.sampling.rule_words(), counted(r.n_samples, "sample")};
      if (r.n_expected > 0)
        view.facts.emplace_back(faults.empty() ? "✓ as expected" : "✗ not as expected");
      view.constants = short_lines(rule_words(r), most_of_rule);
      if (is_own(r))
        view.findings.emplace_back(words_of_own);
      for (const auto &sentences : {r.findings, balance(r)})
        view.findings.insert(view.findings.end(), sentences.begin(), sentences.end());
      view.galleries = {{"picture", "Results", "", sampling_charts(r), sampling_pictures(r)}};
      Part quantities{"quantities", "Quantities at the finest level", "In the units of the scene.",
                      sampling_quantity_table(r)},
          fields{"fields", "Statistics of the field",
                 has_interpolant(r) ? words_of_interpolant : "", sampling_field_table(r)},
          rule{"rule", "Sampling rule and samples", ""};
      quantities.file = quantities.id;
      fields.file = fields.id;
      rule.lead = rule_words(r);
      view.parts = {
          quantities,
          fields,
          {"cheapest", "The cheapest choice of h and samples for each error",
           "Errors are relative to the norm of the mean.", sampling_cheapest_table(r), true},
          {"failures", "Failed samples", "Failed samples; the results are those of the others.",
           sampling_failure_table(r), true},
          rule};
      for (const CaseStatistics &one : r.cases)
      {
        if (one.is_finest && !one.samples.empty())
          view.parts.push_back(samples(r, one));
        view.tables.push_back({samples_file(one), sampling_samples_table(r, one)});
      }
      return view;
    }
  } // namespace

  std::string sampling_summary(const SamplingResults &r, const std::string &files)
  {
    return study_summary(sampling_view(r, {}), header(r), files);
  }

  void write_sampling(const SamplingResults &results, const std::vector<std::string> &faults,
                      const std::filesystem::path &dir)
  {
    write_file(dir / "sample.json", sampling_json(results));
    write_view(sampling_view(results, faults), header(results), dir);
  }
} // namespace plumbline::report
