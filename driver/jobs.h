#pragma once

#include "base/progress_line.h"
#include "driver/scene_input.h"

#include <cstdint>
#include <string>
#include <vector>

// Worker processes that do the tasks of a command (--jobs): the same command with --worker, which
// reads task numbers from standard input and writes its results to journals.
namespace plumbline::driver
{
  /// @throws InputError  the workers cannot read the scene again
  void check_jobs(const SceneOptions &options);

  /// Carries out tasks in worker processes; an interrupt ends them.
  /// @param task      what one is called, e.g. "sample"
  /// @param more      arguments of workers besides those of this command
  /// @param progress  null: progress is not shown
  /// @return  0, or the command's exit code if the workers did not finish all tasks, which is
  /// reported on standard error
  int make_by_workers(const std::vector<std::uint64_t> &tasks, const SceneOptions &options,
                      const std::string &task, const std::vector<std::string> &more,
                      base::ProgressLine *progress);
} // namespace plumbline::driver
