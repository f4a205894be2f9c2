#include "run_parts.h"

#include "base/communicator.h"
#include "base/error.h"

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>

#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iomanip>
#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;

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

  bool has_newer_files(const scene::Scene &scene, const std::filesystem::path &than)
  {
    const std::filesystem::path folder = scene.folder;
    for (const scene::Series &series : scene.study.series)
      for (const scene::Level &level : series.levels)
        if (is_newer(folder / scene.methods.nodes.file_at(level.h), than))
          return true;
    for (const std::string &picture : scene.random.files)
      if (is_newer(folder / picture, than))
        return true;
    return is_newer(folder / scene.domain.mesh.name, than);
  }

  bool is_newer(const std::filesystem::path &file, const std::filesystem::path &than)
  {
    namespace fs = std::filesystem;
    return fs::exists(file) && fs::exists(than) &&
           fs::last_write_time(file) > fs::last_write_time(than);
  }

  void prepare_folder(const std::filesystem::path &folder)
  {
    bool is_writable = true;
    if (base::Communicator::all().rank() == 0)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      const fs::path probe = folder / ".write-test";
      is_writable = !error && (std::ofstream(probe) << "x").flush().good();
      fs::remove(probe, error);
    }
    if (base::Communicator::all().any(!is_writable))
      throw InputError("output folder '" + folder.string() +
                       "' cannot be written; give a writable one with -o");
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
