#pragma once

#include "base/communicator.h"
#include "driver/analyses.h"
#include "driver/scene_input.h"

#include <map>

namespace plumbline::driver
{
  struct AnalyseOptions : SceneOptions
  {
    double budget = 0; ///< of one method at one level [CPU s]; 0: any
    bool check = false;
    study::AskedDirections directions; ///< see Asked
  };

  /// An analysis of a scene, and what becomes of its results.
  struct Task
  {
    study::Analysis analysis;
    report::View (*view)(const study::StudyResults &) = report::default_view;
    std::string command = analysis.name; ///< whose files they are
    std::string file = analysis.name;    ///< the stem of its journal and numbers
    bool goes_on = true;                 ///< from what an interrupted command has left
    /// Receives these earlier results, on the first rank.
    std::function<void(const study::StudyResults &earlier)> take_over = {};
    bool has_checkpoint = false;                            ///< see study::Checkpoints
    base::Communicator ranks = base::Communicator::alone(); ///< that share each method's work
    /// That share methods and levels instead, each of which one rank computes by itself.
    base::Communicator task_ranks = base::Communicator::alone();
    std::map<std::string, std::string> provenance = {}; ///< besides versions and machine
    std::string note = {};                              ///< for people, before it begins
  };

  /// Makes a task that writes its checkpoints and other files of its own to the given folder.
  using MakeTask = std::function<Task(const study::Checkpoints &)>;

  /// All ranks share the task's methods and levels, none of which is distributed in itself.
  void share_tasks(Task &task);

  /// The methods that a scene names for an analysis, after all checks that come before the first
  /// record.
  /// @param n_jobs  processes at the same time; 0: the memory has already been checked
  method::Methods check_methods(const study::Analysis &analysis, const scene::Scene &scene,
                                const method::Methods &available, unsigned int n_levels,
                                unsigned int n_jobs = 1);

  /// Run an analysis over the study of a scene, with --jobs by worker processes; print tables and
  /// verdicts; write ANALYSIS.html, .md and .json, charts to ANALYSIS/, and there the fields of
  /// each series' finest level as VTU. A command that was interrupted or killed takes over what it
  /// had finished, from ANALYSIS.jsonl and checkpoint.h5. On several ranks only the first
  /// one prints, and writes all but what belongs to one method at one level.
  /// @return exit code: 0; with check 1 if an expectation does not hold; 3 if a record failed
  ///         where that is no finding, nor expected by the scene; 130 if it was interrupted; that
  ///         of a worker that ended badly, or 3
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn; all else is written before that
  int analyse(const MakeTask &make_task, const AnalyseOptions &options, const scene::Scene &scene);

  /// The same of a row of the table, by the scene without its reference.
  int analyse(const AnalysisRow &row, const AnalyseOptions &options);
} // namespace plumbline::driver
