#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Processes that read task numbers from a pipe, so that none waits while there is work, and one
// that fails loses only its own task.
namespace plumbline::base
{
  /// Of this process: the next number, until there are no more.
  bool next_task(std::uint64_t &number);

  /// End with the process that began this one, however it ends, or at once if it has ended.
  void end_with_parent();

  /// How a process ended that had not finished its task.
  struct BadEnding
  {
    std::string how;   ///< e.g. "was ended by a signal (Killed)"
    int exit_code = 0; ///< 0: a signal ended it
  };

  /// Run this command with other arguments in n processes that read tasks from standard input. A
  /// process that a signal ends is replaced; one that ends with an exit code other than 0 is not.
  /// Exit code 2 (bad input) ends all of them, since the others would end in the same way.
  /// @param on_wait  called ten times a second with the number of finished tasks; false: end them
  /// now
  std::vector<BadEnding> work_off(const std::vector<std::uint64_t> &tasks, unsigned int n,
                                  const std::vector<std::string> &arguments,
                                  const std::function<bool(std::size_t n_done)> &on_wait);
} // namespace plumbline::base
