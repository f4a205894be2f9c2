#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Processes that take numbers of tasks from a pipe, so that none waits while there is work, and one
// that ends badly takes its own task with it alone.
namespace plumbline::base
{
  /// Of this process: the next number, until there are no more.
  bool next_task(std::uint64_t &number);

  /// End with the process that began this one, however it ends.
  void end_with_parent();

  /// Run this command with other arguments in n processes that take tasks from standard input.
  /// @param on_wait  called ten times a second; false: end them now
  /// @return  how processes ended that a signal ended, or that ended with an exit code other than
  /// 0, in words; others were begun in their place
  std::vector<std::string> work_off(const std::vector<std::uint64_t> &tasks, unsigned int n,
                                    const std::vector<std::string> &arguments,
                                    const std::function<bool()> &on_wait);
} // namespace plumbline::base
