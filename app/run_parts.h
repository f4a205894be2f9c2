#pragma once

#include "scene/scene.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

// What commands that solve have in common.
namespace plumbline::app
{
  /// From now on the first SIGINT or SIGTERM asks to end after the present solve; a second one ends
  /// the process.
  void watch_interrupts();
  bool is_interrupted();

  /// Says on the terminal where the results of an interrupted command are, which it takes over when
  /// it is run again.
  /// @return  its exit code
  int say_interrupted(const std::filesystem::path &folder);

  /// Versions and machine, for results.
  std::map<std::string, std::string> provenance();

  /// One line that is rewritten, on a terminal, after the first two seconds.
  class ProgressLine
  {
  public:
    explicit ProgressLine(bool is_wanted);
    ~ProgressLine();
    void show(const std::string &what, double fraction);

  private:
    bool is_on_, is_shown_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };
} // namespace plumbline::app
