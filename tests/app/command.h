// Runs the command as a user does, and reads what it says and leaves.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/types.h>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  std::string read(const fs::path &file);

  nlohmann::json parse_json(const std::string &text);
  nlohmann::json read_json(const fs::path &file);

  /// A path of this process where nothing is.
  fs::path temporary(const std::string &name);

  /// A temporary file. @return its path
  std::string write(const std::string &name, const std::string &text);

  struct Outcome
  {
    int exit_code;
    std::string out, err;
  };

  /// The command itself on two ranks.
  Outcome run_on_two_ranks(const std::string &arguments);

  /// The command itself beside the test, silent. @return its process
  /// @param err  file for standard error
  pid_t start(const std::string &arguments, const std::string &err = "/dev/null");

  /// Send the command a signal some time after it has written a file, or after half a minute.
  /// @return  how it ended, as waitpid says it
  int signal_at(const std::string &arguments, const fs::path &file, int signal,
                std::chrono::milliseconds later = {});

  /// @return  whether it still ran
  bool kill_at(const std::string &arguments, const fs::path &file);

  /// @return  its exit code
  int interrupt_at(const std::string &arguments, const fs::path &file,
                   std::chrono::milliseconds later = {});

  /// A sentence may be wrapped in the text: its next lines begin with two blanks.
  void expect_found(const std::string &text, const std::string &part,
                    const std::string &where = "");

  /// Standard error but for lines of progress, which depend on the time that is taken.
  std::string without_progress(const std::string &err);

  /// In a child of this process, which has all libraries: to load them takes most of a short run.
  Outcome run(const std::string &arguments);

  /// Bad input: one message, the exit code of bad input, and nothing is left.
  void expect_refused(const std::string &arguments, const std::string &message);
} // namespace plumbline::app
