#pragma once

#include "base/communicator.h"
#include "scene/scene.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

// What commands that solve have in common.
namespace plumbline::app
{
  /// From now on SIGINT or SIGTERM ends the process, with a line on standard error, also where the
  /// parent process ignores them.
  void end_at_interrupts();

  /// From now on the first SIGINT or SIGTERM asks to end after the present solve; a second one ends
  /// the process.
  /// @param notice  is written at the first signal, and outlives all of them
  void watch_interrupts(const char *notice =
                            "\ninterrupted: finishing the current solve or time step, then writing "
                            "the results so far; press Ctrl-C again to stop at once\n");
  bool is_interrupted();

  /// Says on the terminal where the results of an interrupted command are, which it takes over when
  /// it is run again.
  /// @return  its exit code
  int say_interrupted(const std::filesystem::path &folder);

  /// Do something on the first of these ranks. If it fails, all of them stop. @note Collective.
  void on_first_rank(const base::Communicator &ranks, const std::function<void()> &action);

  /// Versions and machine, for results.
  std::map<std::string, std::string> provenance();

  /// What is being done, for how long, and how long it may still take: on a terminal a line that is
  /// rewritten every second, elsewhere a line after one second and then every 10 seconds. On
  /// standard error.
  class ProgressLine
  {
  public:
    explicit ProgressLine(bool is_wanted);
    ~ProgressLine();
    /// @param fraction  of the work that is done
    void show(const std::string &what, double fraction);

  private:
    using Clock = std::chrono::steady_clock;

    void run();
    void print() const;

    bool is_on_, is_terminal_;
    std::string what_;
    double fraction_ = 0;
    bool is_done_ = false;
    Clock::time_point start_ = Clock::now(), step_start_ = start_;
    std::mutex mutex_; ///< of all of the above
    std::condition_variable changed_;
    std::thread thread_;
  };
} // namespace plumbline::app
