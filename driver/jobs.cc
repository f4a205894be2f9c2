#include "driver/jobs.h"

#include "base/error.h"
#include "base/workers.h"
#include "driver/interrupts.h"
#include "report/counted.h"

#include <algorithm>
#include <iostream>
#include <thread>

namespace plumbline::driver
{
  void check_jobs(const SceneOptions &options)
  {
    if (scene::is_read_once(options.scene_file))
      throw InputError("scene '" + options.scene_file +
                       "' is a pipe, but each worker process must read the scene again; save it "
                       "to a file and pass the name of that file");
  }

  int make_by_workers(const std::vector<std::uint64_t> &tasks, const SceneOptions &options,
                      const std::string &task, const std::vector<std::string> &more,
                      base::ProgressLine *progress)
  {
    std::vector<std::string> arguments = options.arguments;
    arguments.emplace_back("--worker");
    if (options.n_threads == 0)
      arguments.insert(
          arguments.end(),
          {"--threads",
           std::to_string(std::max(1u, std::thread::hardware_concurrency() / options.n_jobs))});
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::size_t n_waits = 0;
    const auto wait = [&](std::size_t n_done)
    {
      constexpr std::size_t rarely = 10; // of tenths of a second
      if (progress != nullptr && ++n_waits % rarely == 0)
        progress->show(std::to_string(n_done) + " of " + report::counted(tasks.size(), task),
                       static_cast<double>(n_done) / static_cast<double>(tasks.size()));
      return !is_interrupted();
    };
    int exit_code = 0;
    for (const base::BadEnding &bad : base::work_off(tasks, options.n_jobs, arguments, wait))
    {
      exit_code = bad.exit_code > 0 ? bad.exit_code : 3;
      std::cerr << "plumbline: a worker process (--jobs) " << bad.how << "; if a " << task
                << " is missing, run the same command again\n";
    }
    return exit_code;
  }
} // namespace plumbline::driver
