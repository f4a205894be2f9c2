#pragma once

#include <string>

// What memory and disk there is, so that what does not fit is refused before it is begun.
namespace plumbline::base
{
  /// What this process may still take [bytes]: the least of what the machine has available
  /// (MemAvailable, shared by the ranks on it as Open MPI counts them), what its control groups
  /// leave and what `ulimit -v` leaves; infinite where nothing says. What others take later is not
  /// known.
  double available_memory();

  /// What is free on the disk where a folder is, or will be [bytes]; infinite where nothing says.
  double available_disk(const std::string &folder);

  /// 1.5 GB, 320 MB: two significant digits.
  std::string bytes_to_text(double bytes);

  /// @param bytes   of one process
  /// @param what    that takes it, e.g. "Q1 at h = 1e-4, 1e8 cells"
  /// @param remedy  what the user can do, e.g. "choose a larger h (Study/h)"
  /// @param n_jobs  processes that each take it side by side (--jobs)
  /// @throws InputError  more than is available; names both numbers, and --jobs where fewer of them
  /// would fit
  void require_memory(double bytes, const std::string &what, const std::string &remedy,
                      unsigned int n_jobs = 1);

  /// The text of that error; empty where there is enough.
  std::string memory_fault(double bytes, const std::string &what, const std::string &remedy,
                           unsigned int n_jobs = 1);

  /// What is to be said when an allocation failed in spite of it.
  std::string out_of_memory();
} // namespace plumbline::base
