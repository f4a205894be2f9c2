// Runs the command as a user does, and reads what it says and leaves.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
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

  /// May be called from many threads.
  inline Outcome run(const std::string &arguments)
  {
    static std::atomic<int> n_runs{0};
    const std::string number = std::to_string(n_runs++);
    const fs::path out = temporary("out" + number), err = temporary("err" + number);
    const int status = std::system((std::string(PLUMBLINE_COMMAND) + " " + arguments + " >" +
                                    out.string() + " 2>" + err.string())
                                       .c_str());
    const Outcome outcome{WEXITSTATUS(status), read(out), read(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  /// The same on two ranks.
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

  /// The command beside the test, silent. @return its process
  inline pid_t start(const std::string &arguments)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      const std::string command =
          std::string("exec ") + PLUMBLINE_COMMAND + " " + arguments + " >/dev/null 2>&1";
      execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char *>(nullptr));
      _exit(127);
    }
    return child;
  }

  /// Kill the command as soon as it has written a file, or after half a minute.
  /// @return  whether it still ran
  inline bool kill_at(const std::string &arguments, const fs::path &file)
  {
    const pid_t child = start(arguments);
    for (int i = 0; i < 6000 && !fs::exists(file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }

  inline void expect_found(const std::string &text, const std::string &part,
                           const std::string &where = "")
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text << where;
  }
} // namespace plumbline::app
