#include "driver/sample.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/first_rank.h"
#include "base/number_text.h"
#include "base/progress_line.h"
#include "base/workers.h"
#include "driver/interrupts.h"
#include "driver/methods.h"
#include "io/output_folder.h"
#include "report/counted.h"
#include "report/formats.h"
#include "report/pdf.h"
#include "report/sample_files.h"
#include "report/sample_points.h"
#include "report/sampling_page.h"
#include "study/growth_analysis.h"
#include "study/sample_taker.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <thread>

namespace plumbline::driver
{
  namespace fs = std::filesystem;

  namespace
  {
    scene::Scene read(const SampleOptions &options)
    {
      if (scene::is_read_once(options.scene_file))
        throw InputError("scene '" + options.scene_file +
                         "' is a pipe, but each sampling process must read the scene again; save "
                         "it to a file and pass the name of that file");
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

    /// All that samples depend on.
    std::string subject_of(const SampleOptions &options, const scene::Scene &scene)
    {
      return "# levels: " + std::to_string(options.n_levels) + "\n" + scene.text;
    }

    /// A sample, with the reason if it fails.
    study::SampleRecord take(const scene::Scene &scene, const study::SamplingPlan &plan,
                             std::size_t sample, const report::SampleFiles &files)
    {
      study::SampleRecord record;
      record.sample = sample;
      try
      {
        record.cases = study::sample_taker(scene, all_methods())
                           .take(plan.at(scene, sample),
                                 files.folder() / ("sample_" + std::to_string(sample)));
      }
      catch (const std::exception &error) // of any kind, out of memory too: the others go on
      {
        record.failure = error.what();
      }
      return record;
    }

    /// What a worker does: samples whose numbers come from standard input.
    int take_samples(const scene::Scene &scene, const study::SamplingPlan &plan,
                     const report::SampleFiles &files)
    {
      base::end_with_parent();
      for (std::uint64_t number = 0; base::next_task(number);)
        if (number < plan.values.size())
          files.write(take(scene, plan, number, files));
      return 0;
    }

    /// The number of processes of each rank that take samples at the same time.
    unsigned int n_processes(const SampleOptions &options, const study::SamplingPlan &plan)
    {
      return static_cast<unsigned int>(
          std::min<std::size_t>(options.n_jobs, std::max<std::size_t>(1, plan.values.size())));
    }

    /// @param n_jobs  processes side by side, of which all take what this one finds best: what
    /// memory they find themselves depends on the others
    std::vector<std::string> worker_arguments(const SampleOptions &options,
                                              const scene::Scene &scene, unsigned int n_jobs,
                                              const fs::path &folder)
    {
      const unsigned int n_threads =
          options.n_threads > 0
              ? options.n_threads
              : std::max(1u, std::thread::hardware_concurrency() / options.n_jobs);
      std::vector<std::string> arguments = {
          "sample",    options.scene_file,       "--worker", "-o", folder.string(),
          "--threads", std::to_string(n_threads)};
      for (const scene::Override &one : options.overrides)
        arguments.insert(arguments.end(), {"--set", one.key + "=" + one.value});
      if (study::is_growth(scene))
        arguments.insert(
            arguments.end(),
            {"--set", "Fracture/solver=" + base::word(study::expected_size(scene, n_jobs).solver)});
      if (!options.methods.empty())
        arguments.insert(arguments.end(), {"--methods", options.methods});
      if (options.n_levels > 0)
        arguments.insert(arguments.end(), {"--levels", std::to_string(options.n_levels)});
      return arguments;
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

    /// How long the rest will take, once some samples are there.
    class Forecast
    {
    public:
      Forecast(std::size_t n_left, bool is_wanted) : n_left_(n_left), is_wanted_(is_wanted) {}

      void tell(std::size_t n_done)
      {
        constexpr double worth_saying = 30; // [s]
        if (!is_wanted_ || n_done == 0 || is_said_)
          return;
        is_said_ = true;
        const double each = seconds() / static_cast<double>(n_done);
        const double left = each * static_cast<double>(n_left_ - n_done);
        if (left > worth_saying)
          std::cerr << n_left_ << " samples; by the first of them the others will take some "
                    << report::rounded_seconds(left) << '\n';
      }

    private:
      double seconds() const
      {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      }
      std::size_t n_left_;
      bool is_wanted_, is_said_ = false;
      std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    };

    /// All samples that are not there yet.
    void take_all(const SampleOptions &options, const scene::Scene &scene,
                  const study::SamplingPlan &plan, const report::SampleFiles &files,
                  const fs::path &folder)
    {
      const base::Communicator communicator = base::Communicator::all();
      const unsigned int n_jobs = n_processes(options, plan);
      std::vector<std::uint64_t> due;
      for (std::size_t i = communicator.rank(); i < plan.values.size(); i += communicator.n_ranks())
        if (!files.read(i)) // there is none, or it is not whole
        {
          files.remove(i);
          due.push_back(i);
        }
      const bool is_talking = !options.quiet && communicator.rank() == 0;
      if (is_talking && due.size() < plan.values.size() && communicator.n_ranks() == 1)
        std::cerr << "continuing: " << report::counted(plan.values.size() - due.size(), "sample")
                  << " in '" << folder.string() << "' already\n";
      if (is_talking && study::is_growth(scene))
        tell_size(scene, due.size(), n_jobs, communicator.n_ranks());
      base::ProgressLine progress(is_talking);
      Forecast forecast(due.size(), is_talking);
      const auto n_done = [&]
      {
        return static_cast<std::size_t>(
            std::count_if(due.begin(), due.end(), [&](std::uint64_t i) { return files.has(i); }));
      };
      std::size_t n_waits = 0;
      const auto wait = [&]
      {
        constexpr std::size_t rarely = 10; // of tenths of a second
        if (is_talking && ++n_waits % rarely == 0)
        {
          const std::size_t n = n_done();
          forecast.tell(n);
          progress.show(std::to_string(n) + " of " + std::to_string(due.size()) + " samples",
                        static_cast<double>(n) / static_cast<double>(due.size()));
        }
        return !is_interrupted();
      };
      const std::vector<std::string> endings =
          base::work_off(due, n_jobs, worker_arguments(options, scene, n_jobs, folder), wait);
      for (const std::string &how : endings)
        std::cerr << "plumbline: a process of samples " << how
                  << "; its sample is not there, the same command tries it again\n";
    }
  } // namespace

  int sample(const SampleOptions &options)
  {
    if (!options.is_worker)
      end_at_interrupts();
    if (options.pdf)
      report::require_pdf();
    const scene::Scene scene = read(options);
    const study::SamplingPlan plan = study::make_sampling_plan(scene);
    const fs::path folder = output_folder(options, scene);
    const report::SampleFiles files(folder / "samples", subject_of(options, scene));
    if (options.is_worker)
      return take_samples(scene, plan, files);

    study::sample_taker(scene, all_methods()).check(scene, folder, n_processes(options, plan));
    const base::Communicator communicator = base::Communicator::all();
    const io::OutputFolder output(folder, {"sample", scene.name, scene.text, note}, communicator);
    base::on_first_rank(communicator,
                        [&]
                        {
                          if (!files.are_there())
                            files.begin();
                        });
    watch_interrupts("\ninterrupted: ending the sampling processes, then writing the results of "
                     "finished samples; press Ctrl-C again to stop at once\n");
    take_all(options, scene, plan, files, folder);
    communicator.wait();
    if (communicator.rank() != 0)
      return 0;

    const study::SamplingResults results =
        conclude_samples(scene, plan, [&](std::size_t i) { return files.read(i); });
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
