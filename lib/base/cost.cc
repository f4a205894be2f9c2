#include "base/cost.h"

#include <malloc.h>

#include <ctime>
#include <fstream>
#include <string>

namespace plumbline::base
{
  namespace
  {
    double process_cpu_seconds()
    {
      timespec now{};
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
      return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    /// A size line of /proc/self/status, 0 if the line is not there [bytes].
    std::size_t status_bytes(const std::string &key)
    {
      std::ifstream status("/proc/self/status");
      for (std::string line; std::getline(status, line);)
        if (line.compare(0, key.size(), key) == 0)
          return 1024 * std::stoul(line.substr(key.size()));
      return 0;
    }
  } // namespace

  void CpuTimer::restart()
  {
    start_ = process_cpu_seconds();
  }

  double CpuTimer::seconds() const
  {
    return process_cpu_seconds() - start_;
  }

  MemoryGauge::MemoryGauge()
  {
    malloc_trim(0); // memory that was freed but kept would hide what the solve takes
    std::ofstream("/proc/self/clear_refs") << "5";
    start_ = status_bytes("VmRSS:");
  }

  std::size_t MemoryGauge::peak_bytes() const
  {
    const std::size_t peak = status_bytes("VmHWM:");
    return peak > start_ ? peak - start_ : 0;
  }
} // namespace plumbline::base
