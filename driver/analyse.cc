#include "driver/analyse.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/first_rank.h"
#include "base/progress_line.h"
#include "base/shared_flag.h"
#include "base/workers.h"
#include "driver/interrupts.h"
#include "driver/jobs.h"
#include "driver/methods.h"
#include "driver/provenance.h"
#include "driver/writable.h"
#include "io/output_folder.h"
#include "io/point_vtu.h"
#include "io/record_journal.h"
#include "io/results_json.h"
#include "report/counted.h"
#include "report/formats.h"
#include "report/pdf.h"
#include "scene/required_keys.h"
#include "study/reference_estimate.h"
#include "study/work_of_ranks.h"

#include <algorithm>
#include <iostream>
#include <optional>

namespace plumbline::driver
{
  namespace fs = std::filesystem;

  namespace
  {
    /// The fields of a series' finest level, each to a file.
    void write_fields(const study::Records &records, const scene::Scene &scene,
                      unsigned int n_levels, const fs::path &folder)
    {
      for (const study::Record &record : records)
      {
        const auto &all = scene.study.series;
        const auto series =
            std::find_if(all.begin(), all.end(),
                         [&](const problem::Series &one) { return one.name == record.key.series; });
        const std::size_t n = series->levels.size(),
                          last = n_levels == 0 ? n : std::min<std::size_t>(n_levels, n);
        unsigned int k = 0;
        for (const auto &[name, field] : record.fields)
          if (record.key.level + 1 == last)
            io::write_vtu(field, folder / (report::slug(record.key.label()) + "_" +
                                           report::slug(record.key.series) +
                                           (++k > 1 ? "_" + std::to_string(k) : "") + ".vtu"));
      }
    }

    /// A failure that the scene expects ("method: failed") is no error of the command.
    bool is_expected_failure(const study::StudyResults &results, const study::Record &record)
    {
      const study::Key &key = record.key;
      const std::string subject = key.method + ", " + key.problem + ", " + key.series + ": verdict";
      return std::any_of(results.expectations.begin(), results.expectations.end(),
                         [&](const study::Expectation &e) {
                           return e.subject == subject &&
                                  e.expected == base::word(study::Outcome::failed) && e.holds;
                         });
    }

    /// What went wrong, on standard error.
    void tell_failures(const study::StudyResults &results)
    {
      for (const study::Record &record : results.records)
        if (const study::Key &key = record.key; !record.failure.empty())
          std::cerr << "no result: " << key.label()
                    << (key.problem.empty() ? "" : ", " + key.problem) << ", " << key.series
                    << ", h = " << key.h << ": " << record.failure << '\n';
    }

    int exit_code(const Task &task, bool check, const study::StudyResults &results)
    {
      if (!results.is_complete)
        return 130;
      for (const study::Record &record : results.records)
        if (!task.analysis.are_failures_findings && !record.failure.empty() &&
            !is_expected_failure(results, record))
          return 3;
      const bool holds = std::all_of(results.expectations.begin(), results.expectations.end(),
                                     [](const study::Expectation &e) { return e.holds; });
      return check && !holds ? 1 : 0;
    }

    /// An analysis of a scene by one process, that of the command or a worker.
    class Work
    {
    public:
      Work(const Task &task, const AnalyseOptions &options, const scene::Scene &scene,
           fs::path folder)
          : task_(task), options_(options), scene_(scene), folder_(std::move(folder)),
            journal_(journal_file(), subject())
      {
      }

      fs::path journal_file() const { return folder_ / (task_.file + ".jsonl"); }
      io::RecordJournal &journal() { return journal_; }

      /// Of what is made now, each record is stored at once.
      study::RunControl control()
      {
        study::RunControl control;
        control.n_levels = options_.n_levels;
        control.budget = options_.budget;
        control.ranks = task_.ranks;
        control.earlier = journal_.earlier();
        control.on_made = [this](const study::StudyResults &made)
        { base::on_first_rank(task_.ranks, [&] { store(made); }); };
        return control;
      }

      /// An interrupted command has left these records.
      void take_over(const study::StudyResults &earlier) const
      {
        write_all_fields(earlier.records);
        if (task_.take_over)
          task_.take_over(earlier);
      }

      /// As RunControl::share.
      /// @param exit_code  of workers, see make_by_workers; of several calls the largest
      study::StudyResults share(const study::StudyResults &head,
                                const std::vector<std::uint64_t> &tasks,
                                base::ProgressLine &progress, int &exit_code)
      {
        journal_.append(head); // which they continue
        exit_code = std::max(exit_code, make_by_workers(tasks, options_, "task", {}, &progress));
        return io::RecordJournal(journal_file(), subject()).earlier();
      }

      /// The same by ranks, of which this is the first. @note Collective, as do_own_tasks.
      study::StudyResults share(const study::StudyResults &head,
                                const std::vector<std::uint64_t> &tasks,
                                const method::Methods &methods, base::ProgressLine &progress)
      {
        journal_.append(head);
        (void)base::of_first_rank(task_.task_ranks, tasks);
        const auto show = [&](std::size_t n_done)
        {
          progress.show(std::to_string(n_done) + " of " + report::counted(tasks.size(), "task") +
                            " begun by ranks",
                        static_cast<double>(n_done) / static_cast<double>(tasks.size()));
        };
        Work(task_, options_, scene_, folder_).do_own_tasks(tasks, methods, show);
        return io::RecordJournal(journal_file(), subject()).earlier();
      }

      /// What a rank does of the tasks: one of each n, in turn another one, because methods that
      /// take longest come in the same order at each level.
      void do_own_tasks(const std::vector<std::uint64_t> &tasks, const method::Methods &methods,
                        const std::function<void(std::size_t n_begun)> &show)
      {
        const base::Communicator &ranks = task_.task_ranks;
        const std::size_t n = ranks.n_ranks();
        std::size_t round = 0;
        base::SharedFlag interrupt(ranks);
        do_tasks(
            methods, [&] { return interrupt.is_set(is_interrupted()); },
            [&](std::uint64_t &task)
            {
              const std::size_t next = round * n + (ranks.rank() + round) % n;
              show(std::min<std::size_t>(next, tasks.size()));
              if (next >= tasks.size())
                return false;
              task = tasks[next];
              ++round;
              return true;
            });
        interrupt.finish(is_interrupted);
      }

      /// What a worker does, be it a process or a rank.
      /// @param should_stop  is asked before each task
      /// @param next         gives the next task, until there are no more
      void do_tasks(const method::Methods &methods, const std::function<bool()> &should_stop,
                    const std::function<bool(std::uint64_t &task)> &next)
      {
        journal_.join();
        study::RunControl own = control();
        if (task_.take_over)
          task_.take_over(own.earlier);
        own.should_stop = should_stop;
        own.next_task = next;
        (void)run_study(task_.analysis, scene_, methods, own);
      }

    private:
      /// All that records depend on.
      std::string subject() const
      {
        return "# levels: " + std::to_string(options_.n_levels) + ", " + task_.analysis.name +
               ": " + task_.analysis.options + "\n" + scene_.text;
      }

      /// The journal last: what it has is not made again.
      void store(const study::StudyResults &made)
      {
        write_all_fields(made.records);
        journal_.append(made);
        std::error_code code;
        if (task_.has_checkpoint && !made.records.empty())
          fs::remove(study::Checkpoints{folder_}.file(), code);
      }

      void write_all_fields(const study::Records &records) const
      {
        write_fields(records, scene_, options_.n_levels, folder_ / task_.analysis.name);
      }

      const Task &task_;
      const AnalyseOptions &options_;
      const scene::Scene &scene_;
      fs::path folder_;
      io::RecordJournal journal_;
    };

    /// What an interrupted command has left. All ranks have read it before the first one writes,
    /// and go on from the same.
    study::StudyResults earlier_results(const Task &task, io::RecordJournal &journal)
    {
      const auto n_found = static_cast<double>(journal.earlier().records.size());
      if (!task.goes_on || task.ranks.largest(n_found) != -task.ranks.largest(-n_found))
        journal.forget();
      study::StudyResults earlier = journal.earlier();
      earlier.provenance = provenance();
      earlier.provenance.insert(task.provenance.begin(), task.provenance.end());
      return earlier;
    }

    /// @throws InputError  processes cannot share the work
    void check_sharing(const Task &task, const AnalyseOptions &options)
    {
      if (options.n_jobs == 1)
        return;
      check_jobs(options);
      const std::string given = "--jobs = " + std::to_string(options.n_jobs);
      if (const auto n_ranks = base::Communicator::all().n_ranks(); n_ranks > 1)
        throw InputError(given + " on " + std::to_string(n_ranks) +
                         " ranks, which share the work themselves; use one or the other");
      if (!task.goes_on)
        throw InputError(given + ": each method is compared with its own finest level (Study/"
                                 "decisive error), for which one process keeps all solutions; "
                                 "leave out --jobs, or choose another error");
    }

    /// What ranks other than the first do, until it hands out no more tasks.
    void do_tasks_of_ranks(const Task &task, const AnalyseOptions &options,
                           const scene::Scene &scene, const method::Methods &methods,
                           const fs::path &folder)
    {
      for (auto tasks = base::of_first_rank(task.task_ranks, {}); !tasks.empty();
           tasks = base::of_first_rank(task.task_ranks, {}))
      {
        Work work(task, options, scene, folder);
        if (!fs::exists(work.journal_file()))
          throw InputError(
              "rank " + std::to_string(task.task_ranks.rank()) + " does not find '" +
              work.journal_file().string() +
              "', which the first rank writes; give a folder on a file system that all "
              "ranks share (-o)");
        work.do_own_tasks(tasks, methods, [](std::size_t) {});
      }
    }

    void tell_warnings(const study::StudyResults &results)
    {
      for (const std::string &warning : results.warnings)
        std::cerr << "warning: " << warning << '\n';
    }

    void write_pages(const Task &task, const study::StudyResults &results, const fs::path &folder)
    {
      tell_warnings(results);
      report::write_study(task.view(results), results, folder);
    }

    /// What is wanted on standard output; what went wrong on standard error.
    void tell_end(const Task &task, const AnalyseOptions &options,
                  const study::StudyResults &results, const fs::path &folder, bool is_interrupted)
    {
      if (options.json)
        std::cout << io::to_json(results);
      else if (!options.quiet)
      {
        const report::View view = task.view(results);
        const std::string page = view.files.page.empty() ? task.analysis.name : view.files.page;
        std::cout << report::study_summary(view, results, (folder / (page + ".html")).string());
      }
      if (is_interrupted)
        say_interrupted(folder, task.goes_on);
      if (!task.analysis.are_failures_findings)
        tell_failures(results);
      for (const study::Expectation &one : results.expectations)
        if (results.is_complete && options.check && !one.holds)
          std::cerr << "not as expected: " << one.subject << ": found " << one.found << '\n';
    }
  } // namespace

  method::Methods check_methods(const study::Analysis &analysis, const scene::Scene &scene,
                                const method::Methods &available, unsigned int n_levels,
                                unsigned int n_jobs)
  {
    method::Methods methods = analysis.choose_methods(scene, available, n_levels, n_jobs);
    if (analysis.check)
      analysis.check(scene, methods, n_levels);
    return methods;
  }

  void share_tasks(Task &task)
  {
    task.ranks = base::Communicator::alone();
    task.task_ranks = base::Communicator::all();
    if (task.task_ranks.n_ranks() > 1)
      task.provenance["work of ranks"] = study::work_of_tasks;
  }

  int analyse(const MakeTask &make_task, const AnalyseOptions &options, const scene::Scene &scene)
  {
    if (!(options.budget >= 0))
      throw InputError(
          "--budget is negative; give CPU seconds of one method at one level, or leave "
          "it out");
    if (options.pdf)
      report::require_pdf();
    const bool is_talking =
        !options.quiet && !options.is_worker && base::Communicator::all().rank() == 0;
    std::optional<base::ProgressLine> progress(is_talking);
    const fs::path folder = output_folder(options, scene);
    const Task task = make_task({folder, is_interrupted});
    check_sharing(task, options);
    const method::Methods methods =
        check_methods(task.analysis, scene, all_methods(), options.n_levels,
                      options.is_worker ? 0 : options.n_jobs);
    progress.reset();
    if (options.is_worker)
    {
      Work(task, options, scene, folder).do_tasks(methods, is_interrupted, base::next_task);
      return 0;
    }
    const bool is_shared = options.n_jobs > 1, is_shared_by_ranks = task.task_ranks.n_ranks() > 1;
    const base::Communicator &ranks = is_shared_by_ranks ? task.task_ranks : task.ranks;
    is_shared ? watch_interrupts(end_of_workers) : watch_interrupts();
    const io::OutputFolder output(folder, {task.command, scene.name, scene.text, note}, ranks);
    base::on_first_rank(ranks, [&] { require_writable(folder / (task.file + ".json")); });
    if (is_shared_by_ranks && ranks.rank() != 0)
    {
      do_tasks_of_ranks(task, options, scene, methods, folder);
      return 0;
    }
    Work work(task, options, scene, folder);
    study::RunControl control = work.control();
    control.should_stop = [&] { return task.ranks.any(is_interrupted()); };
    control.earlier = earlier_results(task, work.journal());
    if (!task.note.empty() && task.ranks.rank() == 0)
      note(task.note);
    if (!control.earlier.records.empty() && is_talking)
      std::cerr << "continuing: " << report::counted(control.earlier.records.size(), "record")
                << " in '" << work.journal_file().string() << "' already\n";
    progress.emplace(is_talking);
    control.on_progress = [&](const std::string &what, double fraction)
    { progress->show(what, fraction); };
    int code_of_workers = 0;
    if (is_shared)
      control.share = [&](const study::StudyResults &head, const std::vector<std::uint64_t> &tasks)
      { return work.share(head, tasks, *progress, code_of_workers); };
    if (is_shared_by_ranks)
      control.share = [&](const study::StudyResults &head, const std::vector<std::uint64_t> &tasks)
      { return work.share(head, tasks, methods, *progress); };
    control.is_shared_by_level = static_cast<bool>(task.take_over);
    base::on_first_rank(task.ranks, [&] { work.take_over(control.earlier); });
    const study::StudyResults results = run_study(task.analysis, scene, methods, control);
    if (is_shared_by_ranks)
      (void)base::of_first_rank(ranks, {}); // there are no more tasks
    progress.reset();
    base::on_first_rank(task.ranks,
                        [&]
                        {
                          write_pages(task, results, folder);
                          if (options.pdf)
                            report::draw_pdf(folder);
                          if (results.is_complete)
                            work.journal().remove();
                        });
    const bool is_ended_by_worker =
        code_of_workers > 0 && !results.is_complete && !is_interrupted();
    if (task.ranks.rank() == 0)
      tell_end(task, options, results, folder, !results.is_complete && !is_ended_by_worker);
    return is_ended_by_worker ? code_of_workers : exit_code(task, options.check, results);
  }

  int analyse(const AnalysisRow &row, const AnalyseOptions &options)
  {
    if (!options.is_worker)
      end_at_interrupts();
    scene::require_keys(row.name, options.scene_file, options.overrides);
    const auto make_task = [&](const study::Checkpoints &checkpoints)
    {
      Task task{row.make({checkpoints, options.directions, true}), row.view};
      task.has_checkpoint = row.has_checkpoint;
      if (!row.has_checkpoint)
        share_tasks(task);
      return task;
    };
    return analyse(make_task, options, study::without_reference(read_scene(options)));
  }
} // namespace plumbline::driver
