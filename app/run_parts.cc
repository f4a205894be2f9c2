#include "run_parts.h"

#include "base/communicator.h"

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace plumbline::app
{
  namespace
  {
    volatile std::sig_atomic_t interrupted = 0;
    std::atomic<const char *> notice = ""; ///< of the handlers

    /// Async-signal-safe.
    void write_notice()
    {
      const int error = errno;
      const char *const text = notice;
      (void)!write(STDERR_FILENO, text, std::strlen(text));
      errno = error;
    }

    /// The first signal ends the run after the present solve; a second one ends it at once.
    void on_interrupt(int signal)
    {
      interrupted = 1;
      std::signal(signal, SIG_DFL);
      write_notice();
    }

    void end_on_interrupt(int signal)
    {
      std::signal(signal, SIG_DFL);
      write_notice();
      std::raise(signal); // is delivered when this handler returns
    }

    void handle_interrupts(const char *text, void (*handler)(int))
    {
      notice = base::Communicator::all().rank() == 0 ? text : "";
      for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, handler);
    }

    std::string processor()
    {
      std::ifstream info("/proc/cpuinfo");
      for (std::string line; std::getline(info, line);)
        if (line.compare(0, 10, "model name") == 0)
          return line.substr(line.find(':') + 2);
      return "unknown";
    }
  } // namespace

  void end_at_interrupts()
  {
    handle_interrupts("\ninterrupted: results are missing or incomplete\n", end_on_interrupt);
  }

  void watch_interrupts(const char *text)
  {
    handle_interrupts(text, on_interrupt);
  }

  bool is_interrupted()
  {
    return interrupted != 0;
  }

  int say_interrupted(const std::filesystem::path &folder)
  {
    std::cerr << "interrupted: what is finished is in '" << folder.string()
              << "'; the same command continues\n";
    return 130;
  }

  void on_first_rank(const base::Communicator &ranks, const std::function<void()> &action)
  {
    ranks.together(
        [&]
        {
          if (ranks.rank() == 0)
            action();
        });
  }

  std::map<std::string, std::string> provenance()
  {
    return {{"plumbline", PLUMBLINE_VERSION},
            {"deal.II", DEAL_II_PACKAGE_VERSION},
            {"compiler", __VERSION__},
            {"processor", processor()},
            {"threads", std::to_string(dealii::MultithreadInfo::n_threads())},
            {"ranks", std::to_string(base::Communicator::all().n_ranks())}};
  }

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
} // namespace plumbline::app
