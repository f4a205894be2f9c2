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
  namespace
  {
    /// Those of the command, so that they are read as it has read them: what is added stands
    /// directly behind its name, where no other option can take it, or SCENE, for values of its
    /// own.
    std::vector<std::string> arguments_of_workers(const SceneOptions &options,
                                                  const std::vector<std::string> &more)
    {
      std::vector<std::string> arguments = options.arguments, added = {"--worker"};
      if (options.n_threads == 0)
      {
        const std::string option = "--threads",
                          n = std::to_string(
                              std::max(1u, std::thread::hardware_concurrency() / options.n_jobs));
        bool is_given = false; // as 0: then it takes its place
        for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--" && !is_given; ++i)
          if (arguments[i] == option && i + 1 < arguments.size())
          {
            arguments[i + 1] = n;
            is_given = true;
          }
          else if (arguments[i].rfind(option + "=", 0) == 0)
          {
            arguments[i] = option + "=" + n;
            is_given = true;
          }
        if (!is_given)
          added.insert(added.end(), {option, n});
      }
      added.insert(added.end(), more.begin(), more.end());
      arguments.insert(arguments.begin() + 1, added.begin(), added.end());
      return arguments;
    }
  } // namespace

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
    const std::vector<std::string> arguments = arguments_of_workers(options, more);
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
