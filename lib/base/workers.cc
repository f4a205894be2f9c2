#include "base/workers.h"

#include "base/error.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>
#include <thread>

extern char **environ;

namespace plumbline::base
{
  namespace
  {
    /// The environment variable with the number of the process that began this one.
    constexpr const char *parent = "PLUMBLINE_PARENT";

    /// A number is written and read in one piece: pipes keep so few bytes together.
    constexpr std::size_t n_bytes = sizeof(std::uint64_t);

    /// Without what would make a process a rank of this one's run.
    /// @param own  also in it
    std::vector<char *> own_environment(std::string &own)
    {
      std::vector<char *> result;
      for (char **one = environ; *one != nullptr; ++one)
      {
        const std::string text = *one;
        const bool is_of_ranks = text.rfind("OMPI_", 0) == 0 || text.rfind("PMIX_", 0) == 0 ||
                                 text.rfind("PMI_", 0) == 0 || text.rfind("PRTE_", 0) == 0;
        if (!is_of_ranks && text.rfind(std::string(parent) + "=", 0) != 0)
          result.push_back(*one);
      }
      result.push_back(own.data());
      result.push_back(nullptr);
      return result;
    }

    class Pipe
    {
    public:
      Pipe()
      {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0)
          throw NumericalError(std::string("no pipe can be made: ") + std::strerror(errno));
        fcntl(ends_[1], F_SETFL, O_NONBLOCK);
      }
      ~Pipe()
      {
        close(ends_[0]);
        close_writing();
      }
      Pipe(const Pipe &) = delete;
      Pipe &operator=(const Pipe &) = delete;

      int reading() const { return ends_[0]; }
      std::size_t n_unread() const
      {
        int n = 0;
        ioctl(ends_[0], FIONREAD, &n);
        return static_cast<std::size_t>(n) / n_bytes;
      }
      bool write(std::uint64_t number) const
      {
        return ::write(ends_[1], &number, n_bytes) == static_cast<ssize_t>(n_bytes);
      }
      void close_writing()
      {
        if (ends_[1] >= 0)
          close(ends_[1]);
        ends_[1] = -1;
      }

    private:
      std::array<int, 2> ends_{};
    };

    pid_t begin(const std::vector<std::string> &arguments, int input)
    {
      std::vector<std::string> all = {"plumbline"};
      all.insert(all.end(), arguments.begin(), arguments.end());
      std::vector<char *> pointers;
      for (std::string &one : all)
        pointers.push_back(one.data());
      pointers.push_back(nullptr);
      std::string own = std::string(parent) + "=" + std::to_string(getpid());
      std::vector<char *> environment = own_environment(own);
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
      pid_t process = 0;
      const int error = posix_spawn(&process, "/proc/self/exe", &actions, nullptr, pointers.data(),
                                    environment.data());
      posix_spawn_file_actions_destroy(&actions);
      if (error != 0)
        throw NumericalError(std::string("no process can be started: ") + std::strerror(error));
      return process;
    }

    /// `how` is empty if it ended well.
    BadEnding ending(int status)
    {
      if (WIFSIGNALED(status))
        return {std::string("was ended by a signal (") + strsignal(WTERMSIG(status)) + ")"};
      if (const int code = WEXITSTATUS(status); code != 0)
        return {"ended with exit code " + std::to_string(code), code};
      return {};
    }
  } // namespace

  bool next_task(std::uint64_t &number)
  {
    ssize_t n = 0;
    do
      n = read(STDIN_FILENO, &number, n_bytes);
    while (n < 0 && errno == EINTR);
    return n == static_cast<ssize_t>(n_bytes);
  }

  void end_with_parent()
  {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const char *const number = getenv(parent);
    if (number != nullptr && std::to_string(getppid()) != number) // it had ended before
      raise(SIGTERM);
  }

  std::vector<BadEnding> work_off(const std::vector<std::uint64_t> &tasks, unsigned int n,
                                  const std::vector<std::string> &arguments,
                                  const std::function<bool(std::size_t n_done)> &on_wait)
  {
    using namespace std::chrono_literals;
    Pipe pipe;
    std::set<pid_t> processes;
    std::vector<BadEnding> endings;
    for (unsigned int i = 0; i < std::min<std::size_t>(n, tasks.size()); ++i)
      processes.insert(begin(arguments, pipe.reading()));
    std::size_t n_given = 0;
    bool is_stopped = false;
    const auto stop = [&]
    {
      is_stopped = true;
      for (const pid_t process : processes)
        kill(process, SIGTERM);
    };
    while (!processes.empty())
    {
      while (n_given < tasks.size() && pipe.write(tasks[n_given]))
        ++n_given;
      if (n_given == tasks.size())
        pipe.close_writing();
      const std::size_t n_taken = n_given - pipe.n_unread();
      // Ctrl-C reaches all processes at once: it is noticed here before they are seen to have ended
      if (!on_wait(n_taken - std::min(n_taken, processes.size())) && !is_stopped)
        stop();
      int status = 0;
      for (pid_t process = 0; (process = waitpid(-1, &status, WNOHANG)) > 0;)
      {
        if (processes.erase(process) == 0 || is_stopped)
          continue;
        const BadEnding bad = ending(status);
        if (bad.how.empty())
          continue;
        endings.push_back(bad);
        // each has taken a task with it, so that there is an end to this, unless it never began one
        constexpr int of_bad_input = 2;
        if (bad.exit_code == of_bad_input)
          stop();
        else if (bad.exit_code == 0 && endings.size() <= tasks.size())
          processes.insert(begin(arguments, pipe.reading()));
      }
      std::this_thread::sleep_for(100ms);
    }
    return endings;
  }
} // namespace plumbline::base
