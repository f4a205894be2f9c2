#pragma once

#include "base/communicator.h"
#include "method/method.h"
#include "scene/capabilities.h"
#include "scene/problem.h"
#include "study/study_results.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// For analyses that take long at one place: what they go on from after they were killed.
  struct Checkpoints
  {
    std::filesystem::path folder;           ///< where it is kept
    std::function<bool()> should_stop = {}; ///< asked on the way

    std::filesystem::path file() const { return folder / "checkpoint.h5"; }
    bool is_to_stop() const { return should_stop && should_stop(); }
  };

  /// An analysis was asked to stop, and has written its checkpoint.
  struct Interrupted : std::exception
  {
  };

  /// What the places of a study have in common.
  struct Common
  {
    using Fill = std::function<void(Record &)>;

    StudyResults results; ///< so far
    Methods methods;      ///< that are run
    std::function<void(const Record &begun, const Fill &fill)> make_part = {};
    std::function<void(Record &record, const Fill &fill)> fill = {};
    std::map<std::string, std::shared_ptr<void>> slots = {};

    /// What methods and places share, and may change; made by its default constructor when it is
    /// first asked for, and there until the study ends.
    template <class T>
    T &kept(const std::string &name)
    {
      auto &slot = slots[name];
      if (!slot)
        slot = std::make_shared<T>();
      return *static_cast<T *>(slot.get());
    }
  };

  /// A level of a study, where an analysis is made by one method after the other.
  class Place
  {
  public:
    /// @param scene, common  of the study; outlive it
    Place(const scene::Scene &scene, const problem::Series &series, unsigned int level,
          bool is_finest, Common &common);

    const scene::Scene &scene() const { return scene_; } ///< with the values of this level
    const problem::Series &series() const { return series_; }
    const problem::Level &level() const { return series_.levels[level_]; }
    unsigned int number() const { return level_; } ///< of the level, from coarse to fine
    bool is_finest() const { return is_finest_; }  ///< of the levels that are run

    /// The problem of a case, made when it is first asked for.
    /// @param index  into ProblemSection::case_names()
    const problem::Problem<2> &problem(unsigned int index = 0) const;

    /// What the methods at this place share, made when it is first asked for.
    template <class T, class Make>
    const T &shared(const std::string &name, const Make &make) const
    {
      auto &slot = shared_[name];
      if (!slot)
        slot = std::make_shared<const T>(make());
      return *static_cast<const T *>(slot.get());
    }

    /// As Common::kept.
    template <class T>
    T &kept(const std::string &name) const
    {
      return common_.kept<T>(name);
    }

    const Methods &methods() const { return common_.methods; } ///< of the study

    /// Of the study so far, for what is found besides records; its lists only grow.
    StudyResults &results() const { return common_.results; }

    /// NumericalError becomes the record's failure. What fails on one rank fails on all.
    void fill(Record &record, const Common::Fill &fill) const { common_.fill(record, fill); }

    /// One of several records of a method, which takes long: it is saved as soon as it is there,
    /// an interrupt is heeded before it, and that of an earlier study is taken over.
    /// @param begun  its key
    /// @param fill   not called where it is known; NumericalError becomes its failure
    void part(const Record &begun, const Common::Fill &fill) const
    {
      common_.make_part(begun, fill);
    }

    /// Without a case and without values.
    Record record(const std::string &analysis, const Method &method) const;

  private:
    scene::Scene scene_;
    const problem::Series &series_;
    unsigned int level_;
    bool is_finest_;
    Common &common_;
    mutable std::map<std::string, std::shared_ptr<const void>> shared_;
  };

  /// Columns without units and values.
  analysis::Curve curve_of(const std::vector<std::string> &names);

  /// Append a number to each column.
  void add_row(analysis::Curve &curve, const std::vector<double> &row);

  /// An analysis: all that the one loop (run_study) and the one command need to know of it.
  struct Analysis
  {
    std::string name;  ///< of files and records, e.g. "stability"
    std::string title; ///< of pages
    /// What the scene is changed to before it is analysed; empty: nothing.
    std::function<void(scene::Scene &)> prepare = {};
    /// The methods of a scene, checked, and with memory for all levels.
    /// @param n_jobs  processes that do the same side by side
    std::function<Methods(const scene::Scene &, const Methods &available, unsigned int n_levels,
                          unsigned int n_jobs)>
        choose_methods = {};
    /// What else is refused before the first record, where that takes a moment; samples are not
    /// asked one by one. Empty: nothing.
    std::function<void(const scene::Scene &, const Methods &, unsigned int n_levels)> check = {};
    /// What comes before the first method at a place that has something to do, e.g. a reference;
    /// its errors end the study. Empty: nothing.
    std::function<void(const Place &)> begin = {};
    /// What one method finds at one level: a record, or several that differ in case or variant.
    /// NumericalError becomes the failure of a record.
    std::function<Records(const Place &, const Method &)> analyse = {};
    bool has_parts = false; ///< `analyse` makes its records by Place::part
    /// What is entered into records once all of them are there; empty: nothing.
    std::function<void(const scene::Scene &, Common &)> complete = {};
    /// Trends, powers, verdicts and expectations of its own; empty: none.
    std::function<void(const scene::Scene &, StudyResults &)> conclude = {};
    bool has_decisive_error = false;   ///< that of the scene
    bool are_failures_findings = true; ///< of methods; else numerical failures (exit code 3)
    /// The names of scalars, and of a field, that samples count, or how those names end; empty: all
    /// scalars.
    std::vector<std::string> sampled = {};
    /// The field that samples count, by its last component; its points stand for h² each. Empty:
    /// none.
    std::string sampled_field = {};
    /// Further words that records depend on, besides the scene.
    std::string options = {};

    bool is_sampled(const std::string &scalar) const;
  };

  struct RunControl
  {
    unsigned int n_levels = 0; ///< the first so many of each series; 0: all
    double budget = 0;         ///< leave out what is expected to take longer [CPU s]; 0: nothing
    std::function<void(const std::string &what, double fraction)> on_progress = {};
    std::function<bool()> should_stop = {}; ///< asked before each method at each level, and part
    /// What was made just now: records, with the statements that came with them, see
    /// for_each_statement_list.
    std::function<void(const StudyResults &)> on_made = {};
    /// Records that need not be made again, with what was found besides them, and provenance.
    StudyResults earlier = {};
    /// Lets other processes do tasks and returns all that is finished then, as `earlier`; what
    /// is missing is not computed here, and the study is incomplete. Empty: no other processes.
    /// @param head  results without records and statements
    std::function<StudyResults(const StudyResults &head, const std::vector<std::uint64_t> &tasks)>
        share = {};
    bool is_shared_by_level = false; ///< share() once per level, as with a budget; else once
    /// In such a process, which does only these tasks: the next one, until there are no more.
    std::function<bool(std::uint64_t &task)> next_task = {};
    base::Communicator ranks = base::Communicator::alone(); ///< that run this study together
  };

  /// All methods at all levels of a scene's series: the one loop for every analysis. A task is one
  /// method at one level, or all of them if the scene has a reference.
  /// @throws InputError  as the analysis; what else goes wrong is in a record's failure
  StudyResults run_study(const Analysis &analysis, scene::Scene scene, const Methods &methods,
                         const RunControl &control = {});
} // namespace plumbline::study
