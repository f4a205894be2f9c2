#pragma once

#include <filesystem>

namespace plumbline::driver
{
  /// From now on SIGINT or SIGTERM ends the process, with a line on standard error, also where the
  /// parent process ignores them.
  void end_at_interrupts();

  /// From now on the first SIGINT or SIGTERM asks to end after the present solve; a second one ends
  /// the process.
  /// @param notice  is written at the first signal, and outlives all of them
  void watch_interrupts(const char *notice =
                            "\ninterrupted: ends after the current solve or time step, which may "
                            "take a while, and writes the results so far; Ctrl-C again: ends now, "
                            "finished results are kept\n");
  /// The notice if worker processes do the work (see driver/jobs.h).
  constexpr auto end_of_workers =
      "\ninterrupted: ending the worker processes, then writing the results of finished tasks; "
      "press Ctrl-C again to stop at once\n";
  bool is_interrupted();

  /// Says on the terminal where the results of an interrupted command are, and whether the same
  /// command continues from them.
  /// @param goes_on  it does; otherwise it starts again from the beginning
  /// @return  its exit code
  int say_interrupted(const std::filesystem::path &folder, bool goes_on = true);
} // namespace plumbline::driver
