#include "run_parts.h"

#include "base/communicator.h"

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>

#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iomanip>
#include <iostream>

namespace plumbline::app
{
  namespace
  {
    volatile std::sig_atomic_t interrupted = 0;
    /// The first signal ends the run after the present solve; a second one ends it at once.
    void on_interrupt(int signal)
    {
      interrupted = 1;
      std::signal(signal, SIG_DFL);
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

  void watch_interrupts()
  {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
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

  std::map<std::string, std::string> provenance()
  {
    return {{"plumbline", PLUMBLINE_VERSION},
            {"deal.II", DEAL_II_PACKAGE_VERSION},
            {"compiler", __VERSION__},
            {"processor", processor()},
            {"threads", std::to_string(dealii::MultithreadInfo::n_threads())},
            {"ranks", std::to_string(base::Communicator::all().n_ranks())}};
  }

  ProgressLine::ProgressLine(bool is_wanted) : is_on_(is_wanted && isatty(STDERR_FILENO) != 0) {}

  ProgressLine::~ProgressLine()
  {
    if (is_shown_)
      std::cerr << "\r\033[K" << std::flush;
  }

  void ProgressLine::show(const std::string &what, double fraction)
  {
    using namespace std::chrono_literals;
    if (!is_on_ || std::chrono::steady_clock::now() - start_ < 2s)
      return;
    is_shown_ = true;
    std::cerr << "\r\033[K" << std::setw(3) << static_cast<int>(100 * fraction) << " %  " << what
              << std::flush;
  }
} // namespace plumbline::app
