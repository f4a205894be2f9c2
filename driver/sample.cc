#include "driver/sample.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/progress_line.h"
#include "base/workers.h"
#include "driver/interrupts.h"
#include "driver/jobs.h"
#include "driver/methods.h"
#include "io/output_folder.h"
#include "io/record_journal.h"
#include "report/counted.h"
#include "report/formats.h"
#include "report/pdf.h"
#include "report/sample_points.h"
#include "report/sampling_page.h"
#include "study/growth_analysis.h"
#include "study/sample_taker.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

namespace plumbline::driver
{
  namespace fs = std::filesystem;

  namespace
  {
    scene::Scene read(const SampleOptions &options)
    {
      check_jobs(options);
      scene::Scene scene = read_scene(options);
      if (!scene.sampling.is_there())
        throw InputError("scene '" + scene.name +
                         "': Sampling/rule = none, so that there are no samples; write tensor, "
                         "Smolyak, Monte Carlo or quasi-Monte Carlo, or use 'plumbline " +
                         (scene.fracture.is_there() ? "grow'" : "run'"));
      if (options.n_levels > 0)
        for (problem::Series &series : scene.study.series)
          series.levels.resize(std::min<std::size_t>(options.n_levels, series.levels.size()));
      return scene;
    }

    /// A journal for each sample, which has its records in one line or is not there.
    struct SampleJournals
    {
      fs::path folder;
      std::string subject; ///< all that samples depend on

      fs::path file(std::size_t sample) const
      {
        std::array<char, 32> name{};
        std::snprintf(name.data(), name.size(), "%06zu.jsonl", sample);
        return folder / name.data();
      }

      std::optional<study::Records> read(std::size_t sample) const
      {
        study::StudyResults taken = io::RecordJournal(file(sample), subject).earlier();
        if (taken.analysis.empty()) // also where the file is not whole, or of another subject
          return {};
        return std::move(taken.records);
      }

      void write(std::size_t sample, study::Records records) const
      {
        study::StudyResults taken;
        taken.analysis = "sample";
        taken.records = std::move(records);
        io::RecordJournal(file(sample), subject).append(taken);
      }
    };

    /// The records of a sample, or one with the reason if it fails.
    study::Records take(const scene::Scene &scene, const study::SamplingPlan &plan,
                        std::size_t sample, const fs::path &folder)
    try
    {
      return study::sample_taker(scene, all_methods())
          .take(plan.at(scene, sample), folder / ("sample_" + std::to_string(sample)));
    }
    catch (const std::exception &error) // of any kind, out of memory too: the others go on
    {
      study::Record failed;
      failed.failure = error.what();
      failed.key.h = scene.study.series.front().levels.front().h;
      failed.key.horizon = scene.study.series.front().levels.front().horizon;
      return {failed};
    }

    /// What a worker does: samples whose numbers come from standard input.
    int take_samples(SampleOptions options, const SampleJournals &journals)
    {
      if (!options.growth_solver.empty())
        options.overrides.push_back({"Fracture/solver", options.growth_solver});
      const scene::Scene scene = read(options);
      const study::SamplingPlan plan = study::make_sampling_plan(scene);
      for (std::uint64_t number = 0; base::next_task(number);)
        if (number < plan.values.size())
          journals.write(number, take(scene, plan, number, journals.folder));
      return 0;
    }

    /// The number of processes of each rank that take samples at the same time.
    unsigned int n_processes(const SampleOptions &options, const study::SamplingPlan &plan)
    {
      return static_cast<unsigned int>(
          std::min<std::size_t>(options.n_jobs, std::max<std::size_t>(1, plan.values.size())));
    }

    /// How long samples of growth will take, before there is one.
    /// @param n_jobs  of each rank
    void tell_size(const scene::Scene &scene, std::size_t n, unsigned int n_jobs,
                   unsigned int n_ranks)
    {
      constexpr double worth_saying = 30; // [s]
      const study::GrowthSize size = study::expected_size(scene, n_jobs);
      const unsigned int n_in_all = n_jobs * n_ranks;
      const double all = size.seconds * static_cast<double>(n) / n_in_all;
      if (all > worth_saying)
        std::cerr << n << (n > 1 ? " samples of " : " sample of ") << base::to_text(size.n_nodes, 6)
                  << " nodes: some " << report::rounded_seconds(size.seconds) << " each, "
                  << report::rounded_seconds(all) << " in all by " << n_in_all
                  << (n_in_all > 1 ? " processes" : " process")
                  << ", to a factor of two and for straight cracks of "
                  << base::to_text(size.n_breaks, 4)
                  << " bonds; those that wind take up to three times as long\n";
    }

    /// All samples that are not there yet.
    void take_all(const SampleOptions &options, const scene::Scene &scene,
                  const study::SamplingPlan &plan, const SampleJournals &journals,
                  const fs::path &folder)
    {
      const base::Communicator communicator = base::Communicator::all();
      const unsigned int n_jobs = n_processes(options, plan);
      std::vector<std::uint64_t> due;
      for (std::size_t i = communicator.rank(); i < plan.values.size(); i += communicator.n_ranks())
        if (!journals.read(i))
        {
          fs::remove(journals.file(i)); // of another subject, or not whole
          due.push_back(i);
        }
      const bool is_talking = !options.quiet && communicator.rank() == 0;
      if (is_talking && due.size() < plan.values.size() && communicator.n_ranks() == 1)
        std::cerr << "continuing: " << report::counted(plan.values.size() - due.size(), "sample")
                  << " in '" << folder.string() << "' already\n";
      if (is_talking && study::is_growth(scene))
        tell_size(scene, due.size(), n_jobs, communicator.n_ranks());
      base::ProgressLine progress(is_talking);
      std::vector<std::string> arguments;
      if (study::is_growth(scene)) // all take what is best here: memory that they find is shared
        arguments = {"--growth-solver", base::word(study::expected_size(scene, n_jobs).solver)};
      (void)make_by_workers(due, options, "sample", arguments, &progress);
    }
  } // namespace

  int sample(const SampleOptions &options)
  {
    if (!options.is_worker)
      end_at_interrupts();
    if (options.pdf)
      report::require_pdf();
    const scene::Scene scene = read(options);
    const fs::path folder = output_folder(options, scene);
    const SampleJournals journals{
        folder / "samples", "# levels: " + std::to_string(options.n_levels) + "\n" + scene.text};
    if (options.is_worker)
      return take_samples(options, journals);
    if (fs::exists(journals.folder) && !fs::is_directory(journals.folder))
      throw InputError("'" + journals.folder.string() +
                       "' is a file, but samples are written to a folder of this name; remove the "
                       "file, or choose another output folder (-o)");

    const study::SamplingPlan plan = study::make_sampling_plan(scene);
    study::sample_taker(scene, all_methods()).check(scene, folder, n_processes(options, plan));
    const base::Communicator communicator = base::Communicator::all();
    const io::OutputFolder output(folder, {"sample", scene.name, scene.text, note}, communicator);
    watch_interrupts(end_of_workers);
    take_all(options, scene, plan, journals, folder);
    communicator.wait();
    if (communicator.rank() != 0)
      return 0;

    const study::SamplingResults results =
        conclude_samples(scene, plan, [&](std::size_t i) { return journals.read(i); });
    const std::vector<std::string> faults = sampling_faults(results, scene.expected);
    report::write_sampling(results, faults, folder);
    report::write_sample_points(plan, results.variables, folder / "sample" / "weights.csv");
    if (scene.output.fields && results.spectrum)
      report::write_modes(*scene.random.source->expansion(), scene.domain.origin,
                          folder / "sample" / "modes.csv");
    if (options.pdf)
      report::draw_pdf(folder);
    if (options.json)
      std::cout << report::sampling_json(results);
    else if (!options.quiet)
      std::cout << report::sampling_summary(results, (folder / "sample.html").string());
    for (const study::SampleFailure &failure : results.failures)
      std::cerr << "sample " << failure.sample << " failed: " << failure.reason << '\n';
    if (is_interrupted())
      return say_interrupted(folder);
    if (!results.failures.empty() || !results.is_complete)
      return 3;
    for (const std::string &fault : faults)
      if (options.check)
        std::cerr << fault << '\n';
    return options.check && !faults.empty() ? 1 : 0;
  }
} // namespace plumbline::driver
