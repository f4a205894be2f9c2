// plumbline: Galerkin reference solutions for nonlocal models, and verification of meshfree rules.

#include "command.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace
{
  constexpr const char *threads_of_deal_ii = "DEAL_II_NUM_THREADS=";

  /// deal.II reads the variable in a constructor of its library and aborts where it is no number
  /// above 0. The dynamic linker calls what is in .preinit_array before all such constructors; the
  /// C library works by then, streams of C++ do not.
  void check_environment(int, char **, char **environment)
  {
    const std::size_t n = std::strlen(threads_of_deal_ii);
    for (char **one = environment; *one != nullptr; ++one)
    {
      if (std::strncmp(*one, threads_of_deal_ii, n) != 0)
        continue;
      const char *const value = *one + n;
      char *end = nullptr;
      const long number = std::strtol(value, &end, 10);
      if (end != value && *end == '\0' && number > 0 && number <= 100000)
        continue;
      constexpr const char message[] =
          "plumbline: the environment variable DEAL_II_NUM_THREADS must be a whole number from 1 "
          "to 100000; unset it, or give --threads\n";
      (void)!write(STDERR_FILENO, message, sizeof message - 1);
      _exit(2);
    }
  }

  [[gnu::section(".preinit_array"), gnu::used]] void (*const first)(int, char **,
                                                                    char **) = check_environment;
} // namespace

int main(int argc, char **argv)
{
  return plumbline::app::command(argc, argv);
}
