#pragma once

#include "base/communicator.h"
#include "measures.h"
#include "report/view.h"
#include "study/crack_analysis.h"
#include "study/dispersion.h"
#include "study/growth_analysis.h"
#include "study/stability.h"
#include "study/stationary_crack.h"

#include <map>

namespace plumbline::app
{
  struct AnalyseOptions : MeasureOptions
  {
    double budget = 0; ///< of one method at one level [CPU s]; 0: any
    bool check = false;
  };

  /// An analysis and how its results are shown.
  struct AnalysisRow
  {
    study::Analysis analysis;
    report::View (*view)(const study::StudyResults &) = report::default_view;
    std::string command = analysis.name; ///< whose files they are
    /// Pages and files of results, and what is printed of them; empty: as the view.
    std::function<void(const study::StudyResults &, const std::filesystem::path &folder)> write =
        {};
    std::function<std::string(const study::StudyResults &, const std::filesystem::path &folder)>
        summary = {};
    std::string file = analysis.name; ///< the stem of its journal and numbers
    bool goes_on = true;              ///< from what an interrupted command has left
    bool has_checkpoint = false;      ///< see study::Checkpoints
    base::Communicator ranks = base::Communicator::alone(); ///< that share the work
    std::map<std::string, std::string> provenance = {};     ///< besides versions and machine
    std::string note = {};                                  ///< for people, before it begins
  };

  /// An analysis that keeps its checkpoints, and other files of its own, where it is told.
  using MakeRow = std::function<AnalysisRow(const study::Checkpoints &)>;

  AnalysisRow stability_row();
  AnalysisRow strip_row();
  AnalysisRow dispersion_row(const study::AskedDirections &directions);
  AnalysisRow crack_row(const study::Checkpoints &checkpoints);
  AnalysisRow growth_row(const study::Checkpoints &checkpoints);

  /// Run an analysis over the study of a scene; print tables and verdicts; write ANALYSIS.html, .md
  /// and .json, charts to ANALYSIS/, and there the fields of each series' finest level as VTU. A
  /// command that was interrupted or killed takes over what it had finished, from ANALYSIS.jsonl
  /// and checkpoint.h5. On several ranks the first one of the row talks and writes.
  /// @return exit code: 0; with check 1 if an expectation does not hold; 3 if a record failed
  ///         where that is no finding, nor expected by the scene; 130 if it was interrupted
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn; all else is written before that
  int analyse(const MakeRow &make_row, const AnalyseOptions &options);

  /// The same of a scene that is read already.
  int analyse(const MakeRow &make_row, const AnalyseOptions &options, const scene::Scene &scene);
} // namespace plumbline::app
