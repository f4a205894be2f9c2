#include "driver/interrupts.h"

#include "base/communicator.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>

namespace plumbline::driver
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

  int say_interrupted(const std::filesystem::path &folder, bool goes_on)
  {
    std::cerr << "interrupted: what is finished is in '" << folder.string()
              << "'; the same command "
              << (goes_on ? "continues" : "starts again from the beginning") << '\n';
    return 130;
  }
} // namespace plumbline::driver
