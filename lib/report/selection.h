#pragma once

#include "study/study_results.h"

#include <string>
#include <vector>

namespace plumbline::report
{
  /// One problem with one series: a column of the verdict table, a chart, a table of errors.
  struct Case
  {
    std::string problem, series;
    std::string slug; ///< for file names, unique among the cases of one result
    std::string title() const { return series.empty() ? problem : problem + ", " + series; }
  };

  struct MethodName
  {
    std::string name;
    study::MethodFamily family = study::MethodFamily::meshfree;
    bool is_reference() const { return family == study::MethodFamily::reference; }
  };

  /// In the order in which they were run.
  std::vector<Case> cases(const study::StudyResults &results);
  std::vector<MethodName> methods(const study::StudyResults &results);

  /// The trend of the error that verdicts rest on; nullptr if there is none.
  const study::Trend *decisive_trend(const study::StudyResults &results, const std::string &method,
                                     const Case &one);

  /// The problem with the most errors above round-off, the first of several: a problem that most
  /// methods solve exactly tells little about work and rates. Empty without a run.
  std::string telling_problem(const study::StudyResults &results);

  /// The runs of one method on one case, coarse to fine.
  std::vector<const study::Record *> runs_of(const study::StudyResults &results,
                                             const std::string &method, const Case &one);

  /// The decisive error of a run; NaN if the run has none.
  double decisive_error(const study::StudyResults &results, const study::Record &run);

  /// A length agrees with another if it does to this fraction: both are printed from the same
  /// scene.
  constexpr double same_length = 1e-9;

  /// The rate of a trend between the level with parameter x and the one before, see
  /// study::observed_rate.
  double rate_at(const study::Trend &trend, double x);

  /// What varies over the levels, as the trends say.
  study::Axis axis_of(const study::StudyResults &results, const Case &one);

  /// Of decisive errors, in words.
  std::string unit_of_errors(const study::StudyResults &results);

  /// "nodal Linf | exact" in words: "nodal L∞ against exact".
  std::string error_words(const std::string &error);

  /// ✓, ✗, ? or –.
  std::string outcome_symbol(study::Outcome outcome);

  /// The verdict's own words, or those of the outcome if it has none.
  std::string verdict_words(const study::Trend &trend);
} // namespace plumbline::report
