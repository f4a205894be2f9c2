// Runs the command as a user does, and reads what it says and leaves.
#pragma once

#include "app/command.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <wordexp.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  inline std::string read(const fs::path &file)
  {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  /// A path of this process where nothing is.
  inline fs::path temporary(const std::string &name)
  {
    const fs::path path =
        fs::path(testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_" + name);
    fs::remove_all(path);
    return path;
  }

  /// A temporary file. @return its path
  inline std::string write(const std::string &name, const std::string &text)
  {
    const fs::path file = temporary(name);
    std::ofstream(file) << text;
    return file.string();
  }

  struct Outcome
  {
    int exit_code;
    std::string out, err;
  };

  /// The command itself on two ranks.
  inline Outcome run_on_two_ranks(const std::string &arguments)
  {
    const fs::path out = temporary("ranks_out"), err = temporary("ranks_err");
    const int status =
        std::system(("timeout 120 " PLUMBLINE_MPIRUN " --allow-run-as-root --oversubscribe --mca "
                     "mpi_yield_when_idle 1 -np 2 " PLUMBLINE_COMMAND " " +
                     arguments + " >" + out.string() + " 2>" + err.string())
                        .c_str());
    const Outcome outcome{WEXITSTATUS(status), read(out), read(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  /// The command itself beside the test, silent. @return its process
  /// @param err  file for standard error
  inline pid_t start(const std::string &arguments, const std::string &err = "/dev/null")
  {
    const pid_t child = fork();
    if (child == 0)
    {
      const std::string command =
          std::string("exec ") + PLUMBLINE_COMMAND + " " + arguments + " >/dev/null 2>" + err;
      execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char *>(nullptr));
      _exit(127);
    }
    return child;
  }

  /// Send the command a signal some time after it has written a file, or after half a minute.
  /// @return  how it ended, as waitpid says it
  inline int signal_at(const std::string &arguments, const fs::path &file, int signal,
                       std::chrono::milliseconds later = {})
  {
    const pid_t child = start(arguments);
    for (int i = 0; i < 6000 && !fs::exists(file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(later);
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  /// @return  whether it still ran
  inline bool kill_at(const std::string &arguments, const fs::path &file)
  {
    return WIFSIGNALED(signal_at(arguments, file, SIGKILL));
  }

  /// @return  its exit code
  inline int interrupt_at(const std::string &arguments, const fs::path &file,
                          std::chrono::milliseconds later = {})
  {
    return WEXITSTATUS(signal_at(arguments, file, SIGINT, later));
  }

  /// A sentence may be wrapped in the text: its next lines begin with two blanks.
  inline void expect_found(const std::string &text, const std::string &part,
                           const std::string &where = "")
  {
    const std::string unwrapped = std::regex_replace(text, std::regex("\n  (?! )"), " ");
    EXPECT_TRUE(text.find(part) != std::string::npos || unwrapped.find(part) != std::string::npos)
        << part << " is not in:\n"
        << text << where;
  }

  /// Standard error but for lines of progress, which depend on the time that is taken.
  inline std::string without_progress(const std::string &err)
  {
    return std::regex_replace(err, std::regex(" *[0-9]+ %  [^\n]*\n"), "");
  }

  /// The words of a command as a shell tells them apart.
  class Words
  {
  public:
    explicit Words(const std::string &text)
    {
      if (wordexp(text.c_str(), &words_, WRDE_NOCMD | WRDE_UNDEF) != 0)
        throw std::invalid_argument("no words of a command: " + text);
    }
    ~Words() { wordfree(&words_); }
    Words(const Words &) = delete;
    Words &operator=(const Words &) = delete;
    int size() const { return static_cast<int>(words_.we_wordc); }
    char **begin() { return words_.we_wordv; } ///< a null pointer ends them

  private:
    wordexp_t words_{};
  };

  /// In a child of this process, which has all libraries: to load them takes most of a short run.
  inline Outcome run(const std::string &arguments)
  {
    const fs::path out = temporary("out"), err = temporary("err");
    Words words("plumbline " + arguments);
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0)
    {
      if (!std::freopen(out.c_str(), "w", stdout) || !std::freopen(err.c_str(), "w", stderr))
        _exit(127);
      const int exit_code = command(words.size(), words.begin());
      std::fflush(nullptr);
      _exit(exit_code);
    }
    int status = 0;
    waitpid(child, &status, 0);
    const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                          read(out), read(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  /// Bad input: one message, the exit code of bad input, and nothing is left.
  inline void expect_refused(const std::string &arguments, const std::string &message)
  {
    const fs::path folder = temporary("refused");
    const Outcome outcome = run(arguments + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
    expect_found(outcome.err, message, arguments);
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_FALSE(fs::exists(folder)) << arguments;
  }
} // namespace plumbline::app
