// A machine that has little memory left.
#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <fstream>

namespace plumbline::algebra
{
  /// While it lives this process may take so many bytes more.
  class LittleMemory
  {
  public:
    explicit LittleMemory(std::size_t bytes)
    {
      getrlimit(RLIMIT_AS, &before_);
      std::size_t pages = 0; // of the whole process, of 4096 bytes
      std::ifstream("/proc/self/statm") >> pages;
      const rlimit limit{4096 * pages + bytes, before_.rlim_max};
      setrlimit(RLIMIT_AS, &limit);
    }
    ~LittleMemory() { setrlimit(RLIMIT_AS, &before_); }
    LittleMemory(const LittleMemory &) = delete;
    LittleMemory &operator=(const LittleMemory &) = delete;

  private:
    rlimit before_{};
  };
} // namespace plumbline::algebra
