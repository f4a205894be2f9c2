#include "base/progress_line.h"

#include <unistd.h>

#include <iomanip>
#include <iostream>
#include <sstream>

namespace plumbline::base
{
  ProgressLine::ProgressLine(bool is_wanted)
      : is_on_(is_wanted), is_terminal_(isatty(STDERR_FILENO) != 0)
  {
    if (is_on_)
      thread_ = std::thread([this] { run(); });
  }

  ProgressLine::~ProgressLine()
  {
    if (!is_on_)
      return;
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (is_terminal_)
      std::cerr << "\r\033[K" << std::flush;
  }

  void ProgressLine::show(const std::string &what, double fraction)
  {
    const std::lock_guard lock(mutex_);
    what_ = what;
    fraction_ = fraction;
    step_start_ = Clock::now();
  }

  void ProgressLine::run()
  {
    std::chrono::seconds pause(1);
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, pause, [this] { return is_done_; }))
    {
      print();
      pause = std::chrono::seconds(is_terminal_ ? 1 : 10);
    }
  }

  std::string time_left(double before, double in_step, double fraction)
  {
    constexpr double least = .02, least_time = .5; // of work and time [s], to tell of the rest
    if (fraction <= least || before < least_time)
      return "";
    const double left = before * (1 - fraction) / fraction - in_step;
    std::ostringstream text;
    text << std::fixed << std::setprecision(0) << "; some " << left << " s left";
    return left > 0 ? text.str() : "; longer than expected from the steps before";
  }

  void ProgressLine::print() const
  {
    const auto seconds_since = [](Clock::time_point start)
    { return std::chrono::duration<double>(Clock::now() - start).count(); };
    std::ostringstream line;
    line << std::fixed << std::setprecision(0) << std::setw(3) << 100 * fraction_ << " %  "
         << (what_.empty() ? "preparing" : what_) << ", " << seconds_since(step_start_) << " s";
    const double in_step = seconds_since(step_start_);
    line << time_left(seconds_since(start_) - in_step, in_step, fraction_);
    std::cerr << (is_terminal_ ? "\r\033[K" : "") << line.str() << (is_terminal_ ? "" : "\n")
              << std::flush;
  }
} // namespace plumbline::base
