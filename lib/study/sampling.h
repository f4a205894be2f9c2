#pragma once

#include "scene/scene.h"
#include "study/study_results.h"
#include "uq/spectrum.h"
#include "uq/statistics.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Statistics of what a random scene yields, over sets of samples and levels alike.
namespace plumbline::study
{
  /// Of a field's modes; nothing where it has none. Finds them where nobody did yet.
  std::optional<uq::Spectrum> field_spectrum(const scene::RandomSection &section);

  /// Samples of one rule and count.
  struct SampleSet
  {
    uq::SampleRule rule = uq::SampleRule::none;
    unsigned int count = 0, n_modes = 0; ///< see scene::SamplingSection
    std::vector<std::size_t> samples;    ///< into SamplingPlan::values
    std::vector<double> weights;
    double sum_of_sizes = 1, noise = 1; ///< see uq::SamplePoints

    bool is_independent() const { return rule == uq::SampleRule::monte_carlo; }
  };

  /// All samples that sets take, each once.
  struct SamplingPlan
  {
    std::vector<std::vector<double>> values; ///< of the variables, shape (n_samples, n_variables)
    /// Ordered by rule, as in Sampling/rule, then by modes and by samples, both increasing.
    std::vector<SampleSet> sets;

    /// Number of the last set that has the same rule as a given set. The last set of the first rule
    /// is the leading set: pictures and tables of samples show it, and its solution at the finest
    /// level is the target "own finest level".
    /// @pre  set < sets.size()
    std::size_t last_like(std::size_t set) const;

    /// The scene at a sample; of fields that are drawn whole the realisation of its number.
    scene::Scene at(const scene::Scene &scene, std::size_t sample) const;
  };
  SamplingPlan make_sampling_plan(const scene::Scene &scene);

  /// The one field of a sample's record, see sample_study(); without values where it has none.
  const analysis::PointField &sampled_field(const Record &record);

  /// Of a case over one set.
  struct SetStatistics
  {
    uq::SampleRule rule = uq::SampleRule::none;
    unsigned int count = 0, n_modes = 0;
    std::size_t n_samples = 0; ///< that there are
    std::size_t n_missing = 0; ///< that failed: independent samples do without, rules say nothing
    double sum_of_sizes = 1, noise = 1;
    double seconds = 0; ///< CPU time of its samples
    std::map<std::string, uq::Statistics> quantities;
    // of the field, L2 over Ω
    double mean_size = 0;
    std::optional<double> deviation_size; ///< nothing where a variance is negative: it has no root
    double negative_part = 0;             ///< of Ω, where it is
    double standard_error = 0;            ///< of the mean of independent samples
    /// Against the exact field's, or, with the target "own finest level", against the leading set's
    /// at that level, whose deviations of averages over smaller cells are averaged. There is no
    /// deviation_error where a variance is negative, of this set or of the target.
    std::optional<double> mean_error, deviation_error;
    bool is_target = false; ///< this is that set, which has no errors
    // of the set's interpolant u^Q, see interpolation_error.h
    std::optional<double> interpolation_error;
    std::optional<double> lebesgue, lebesgue_bound;         ///< found, and what it does not exceed
    double mean_uncertainty = 0, deviation_uncertainty = 0; ///< of what these are held against
  };

  /// Mean and deviation of the leading set's field, for pictures.
  struct FieldStatistics
  {
    analysis::PointField places;         ///< without values
    std::vector<double> mean, deviation; ///< this is 0 where the variance is negative
  };

  struct CaseStatistics
  {
    Key of;
    bool is_finest = false; ///< level of its method
    /// Errors are against this level itself: they are of samples and modes alone.
    bool is_target_level = false;
    std::vector<SetStatistics> sets;
    std::optional<FieldStatistics> field; ///< of the finest level
    std::vector<std::size_t> samples;     ///< of the leading set, those that there are
    /// Of each quantity for these, or nothing where one has none.
    std::map<std::string, std::vector<std::optional<double>>> values;

    /// The last set of a rule; null if there is none.
    const SetStatistics *last_of(uq::SampleRule rule) const;
    /// The last set of the first rule; null if there are no sets.
    const SetStatistics *leading() const;
  };

  struct SampleFailure
  {
    std::size_t sample = 0;
    std::vector<double> values;
    std::string reason;
  };

  /// The pair of level and set that most cheaply brings the error of the mean below a target and
  /// keeps it there: with more samples and modes, and at finer levels. Of pairs that are as cheap
  /// (see cheapest.h) the one with fewer samples, then fewer modes, then the larger h. One for
  /// each rule.
  struct CheapestPair
  {
    std::string method, problem, series;
    double target = 0, error = 0, h = 0, seconds = 0;
    unsigned int count = 0, n_modes = 0;
    uq::SampleRule rule = uq::SampleRule::none;
  };

  /// Whether more samples lower the error of the mean of a method at a level.
  struct SamplingBalance
  {
    std::string method, problem, series;
    double h = 0;                          ///< [length]
    unsigned int n_modes = 0, largest = 0; ///< count of the largest set
    double error = 0;                      ///< of the mean there
    /// The least count from which on sets have an error within a tenth of that; nothing where only
    /// the largest has: samples still limit it.
    std::optional<unsigned int> enough;
    uq::SampleRule rule = uq::SampleRule::none;
  };

  /// How many samples each rule needs for an error that all of them reach: the largest of the
  /// errors of their last sets. For a method at its finest level, with all modes.
  struct RuleComparison
  {
    std::string method, problem, series;
    double h = 0;         ///< [length]
    std::string quantity; ///< whose error is compared: "mean" or "deviation"
    double error = 0;     ///< that all rules reach
    struct Need
    {
      uq::SampleRule rule = uq::SampleRule::none;
      /// Of the smallest set from which on errors exceed `error` by at most a tenth.
      std::size_t n_samples = 0;
    };
    std::vector<Need> needs; ///< few to many
  };

  struct SamplingResults
  {
    std::string scene_name, purpose, scene_text;
    scene::RandomSection random;
    scene::SamplingSection sampling;
    std::string target; ///< of errors of means, e.g. "local"; empty: none is known
    std::size_t n_samples = 0;
    std::vector<std::string> variables;      ///< their names, those of modes last
    std::vector<std::vector<double>> points; ///< their values, shape (n_samples, n_variables)
    std::optional<uq::Spectrum> spectrum;    ///< of a field of modes
    std::vector<CaseStatistics> cases;
    std::vector<SampleFailure> failures;
    std::vector<CheapestPair> cheapest;
    std::vector<SamplingBalance> balance;
    std::vector<RuleComparison> comparisons; ///< where there are several rules
    std::vector<std::string> findings;       ///< sentences for the report
    std::size_t n_expected = 0;              ///< lines of Expected/sampling
    bool is_complete = false;
  };

  /// @param read  the records of a sample as sample_study() makes them, or one that tells why it
  /// failed; nothing where it was not taken. Each is asked for once, so that fields of many samples
  /// need no memory.
  SamplingResults
  conclude_samples(const scene::Scene &scene, const SamplingPlan &plan,
                   const std::function<std::optional<Records>(std::size_t sample)> &read);

  /// What does not hold of Expected/sampling, where "variance kept" is that of the modes; one
  /// sentence each.
  std::vector<std::string> sampling_faults(const SamplingResults &results,
                                           const scene::ExpectedSection &expected);

  /// A quantity of a case over its leading set, by the name that tables give it: "error of the
  /// mean", "size of the mean" (L2, and so on), "mean of ...", "deviation of ...". With the name of
  /// a rule, "error of the mean by Monte Carlo", it is over the last set of that rule. Nothing
  /// where it is not known.
  std::optional<double> sampled_quantity(const CaseStatistics &one, const std::string &name);
} // namespace plumbline::study
