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

    std::atomic<const char *> last_notice = ""; ///< of a second signal

    /// Async-signal-safe.
    void write_text(const char *text)
    {
      const int error = errno;
      (void)!write(STDERR_FILENO, text, std::strlen(text));
      errno = error;
    }

    void end_now(int signal, const char *text)
    {
      std::signal(signal, SIG_DFL);
      write_text(text);
      std::raise(signal); // is delivered when the handler returns
    }

    void end_on_second(int signal)
    {
      end_now(signal, last_notice);
    }

    /// The first signal ends the run after the present solve; a second one, of either kind, ends it
    /// at once.
    void on_interrupt(int)
    {
      interrupted = 1;
      for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, end_on_second);
      write_text(notice);
    }

    void end_on_interrupt(int signal)
    {
      end_now(signal, notice);
    }

    void handle_interrupts(const char *text, void (*handler)(int))
    {
      const bool is_first = base::Communicator::all().rank() == 0;
      notice = is_first ? text : "";
      last_notice = is_first ? "\ninterrupted again: ended at once; finished results are kept "
                               "('plumbline report FOLDER' shows those of 'run')\n"
                             : "";
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
