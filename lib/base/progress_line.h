#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace plumbline::base
{
  /// "; some 27 s left", by the rate of the steps before; empty where they tell nothing.
  /// @param before    time that they took [s]
  /// @param in_step   time in the present one [s]
  /// @param fraction  of the work that they did
  std::string time_left(double before, double in_step, double fraction);

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
} // namespace plumbline::base
