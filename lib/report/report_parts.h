#pragma once

#include "report/selection.h"
#include "report/template.h"

#include <filesystem>

/// The parts of report.html, each data for the template of its name.
namespace plumbline::report::page
{
  /// Which method to take: one sentence over all cases, then a card for each problem and series;
  /// null where nothing can be advised.
  Data advice(const study::StudyResults &results);

  /// The answer where nothing is refined, so that no method converges or stalls: methods with their
  /// largest error, the best first; empty in other studies.
  std::string ranking(const study::StudyResults &results);

  /// Over what: "horizons", or "values of nu".
  std::string ranked_over(const study::StudyResults &results);

  /// All charts, the overall and the first convergence chart large.
  Data chart_groups(const study::StudyResults &results, const std::filesystem::path &dir);

  /// The reference's own estimates, and the differences that are too small for them.
  Data reference(const study::StudyResults &results);

  /// What was modelled, and what was left out; the check of the geometry.
  Data model(const study::StudyResults &results);

  /// How many of the scene's expectations hold; those that do not are shown, the others folded.
  /// Null where there are none.
  Data expectations(const study::StudyResults &results);
} // namespace plumbline::report::page
