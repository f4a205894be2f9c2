#include "command.h"

#include "app/command.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <wordexp.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace plumbline::app
{
  namespace
  {
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
  } // namespace

  std::string read(const fs::path &file)
  {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  fs::path temporary(const std::string &name)
  {
    const fs::path path =
        fs::path(testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_" + name);
    fs::remove_all(path);
    return path;
  }

  std::string write(const std::string &name, const std::string &text)
  {
    const fs::path file = temporary(name);
    std::ofstream(file) << text;
    return file.string();
  }

  Outcome run_on_two_ranks(const std::string &arguments)
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

  pid_t start(const std::string &arguments, const std::string &err)
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

  int signal_at(const std::string &arguments, const fs::path &file, int signal,
                std::chrono::milliseconds later)
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

  bool kill_at(const std::string &arguments, const fs::path &file)
  {
    return WIFSIGNALED(signal_at(arguments, file, SIGKILL));
  }

  int interrupt_at(const std::string &arguments, const fs::path &file,
                   std::chrono::milliseconds later)
  {
    return WEXITSTATUS(signal_at(arguments, file, SIGINT, later));
  }

  void expect_found(const std::string &text, const std::string &part, const std::string &where)
  {
    const std::string unwrapped = std::regex_replace(text, std::regex("\n  (?! )"), " ");
    EXPECT_TRUE(text.find(part) != std::string::npos || unwrapped.find(part) != std::string::npos)
        << part << " is not in:\n"
        << text << where;
  }

  std::string without_progress(const std::string &err)
  {
    return std::regex_replace(err, std::regex(" *[0-9]+ %  [^\n]*\n"), "");
  }

  Outcome run(const std::string &arguments)
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

  void expect_refused(const std::string &arguments, const std::string &message)
  {
    const fs::path folder = temporary("refused");
    const Outcome outcome = run(arguments + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
    expect_found(outcome.err, message, arguments);
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_FALSE(fs::exists(folder)) << arguments;
  }

  nlohmann::json parse_json(const std::string &text)
  {
    return nlohmann::json::parse(text);
  }

  nlohmann::json read_json(const fs::path &file)
  {
    return parse_json(read(file));
  }
} // namespace plumbline::app
