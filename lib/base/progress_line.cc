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

  void ProgressLine::print() const
  {
    constexpr double least = .02; // of the work, to tell how long the rest takes
    const auto seconds_since = [](Clock::time_point start)
    { return std::chrono::duration<double>(Clock::now() - start).count(); };
    std::ostringstream line;
    line << std::fixed << std::setprecision(0) << std::setw(3) << 100 * fraction_ << " %  "
         << (what_.empty() ? "preparing" : what_) << ", " << seconds_since(step_start_) << " s";
    if (fraction_ > least)
      line << "; some " << seconds_since(start_) * (1 - fraction_) / fraction_ << " s left";
    std::cerr << (is_terminal_ ? "\r\033[K" : "") << line.str() << (is_terminal_ ? "" : "\n")
              << std::flush;
  }
} // namespace plumbline::base
