#pragma once

#include "base/progress_line.h"
#include "driver/scene_input.h"

#include <cstdint>
#include <string>
#include <vector>

// Worker processes that make the tasks of a command (--jobs): the same command with --worker, which
// takes numbers of tasks from standard input and writes what it finds to journals.
namespace plumbline::driver
{
  /// @throws InputError  the scene cannot be read by each worker
  void check_jobs(const SceneOptions &options);

  /// Makes tasks by worker processes; an interrupt ends them.
  /// @param task      what one is called, e.g. "sample"
  /// @param more      arguments of workers besides those of this command
  /// @param progress  null: is not told
  /// @return  0, or the exit code of a command whose workers did not finish all of them, which is
  /// told on standard error
  int make_by_workers(const std::vector<std::uint64_t> &tasks, const SceneOptions &options,
                      const std::string &task, const std::vector<std::string> &more,
                      base::ProgressLine *progress);
} // namespace plumbline::driver
