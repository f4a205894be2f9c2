#include "base/memory.h"

#include "base/error.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace plumbline::base
{
  namespace
  {
    namespace fs = std::filesystem;
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    /// A line "key: number kB" of a file of the kernel's [bytes].
    double kernel_bytes(const std::string &file, const std::string &key)
    {
      std::ifstream in(file);
      for (std::string line; std::getline(in, line);)
        if (line.compare(0, key.size(), key) == 0)
          return 1024 * std::atof(line.c_str() + key.size());
      return unlimited;
    }

    /// A file that holds one number; unlimited where there is none, or "max" in it.
    double number_in(const fs::path &file)
    {
      double value = 0;
      return std::ifstream(file) >> value ? value : unlimited;
    }

    /// What the control groups of this process leave, its own and those above (versions 2 and 1).
    double control_group_bytes()
    {
      double least = unlimited;
      std::ifstream groups("/proc/self/cgroup"); // lines number:controllers:/path
      for (std::string line; std::getline(groups, line);)
      {
        const auto second = line.find(':', line.find(':') + 1);
        const bool is_unified = line.compare(0, 3, "0::") == 0;
        if (second == std::string::npos ||
            (!is_unified && line.substr(0, second).find("memory") == std::string::npos))
          continue;
        const fs::path root = is_unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        const char *const limit = is_unified ? "memory.max" : "memory.limit_in_bytes";
        const char *const used = is_unified ? "memory.current" : "memory.usage_in_bytes";
        for (fs::path own = fs::path(line.substr(second + 1)).relative_path();;
             own = own.parent_path())
        {
          const double most = number_in(root / own / limit);
          if (most < unlimited)
            least = std::min(least, std::max(0., most - number_in(root / own / used)));
          if (own.empty())
            break;
        }
      }
      return least;
    }

    double address_space_bytes()
    {
      rlimit limit{};
      if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return unlimited;
      const double taken = kernel_bytes("/proc/self/status", "VmSize:");
      return std::max(0., static_cast<double>(limit.rlim_cur) - taken);
    }

    /// Ranks of this run on this machine.
    double n_local_ranks()
    {
      const char *const text = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
      return text == nullptr ? 1 : std::max(1., std::atof(text));
    }
  } // namespace

  double available_memory()
  {
    const double shared =
        std::min(kernel_bytes("/proc/meminfo", "MemAvailable:"), control_group_bytes());
    return std::min(shared / n_local_ranks(), address_space_bytes());
  }

  double available_disk(const std::string &folder)
  {
    std::error_code code;
    fs::path existing = fs::absolute(folder, code);
    while (!fs::exists(existing, code) && existing.has_relative_path())
      existing = existing.parent_path();
    const auto space = fs::space(existing, code);
    return code ? unlimited : static_cast<double>(space.available);
  }

  std::string bytes_to_text(double bytes)
  {
    std::ostringstream text;
    const bool is_large = bytes >= .95e9;
    const double value = bytes / (is_large ? 1e9 : 1e6);
    const double digit = value > 0 ? std::pow(10, std::floor(std::log10(value)) - 1) : 1;
    text << std::round(value / digit) * digit << (is_large ? " GB" : " MB");
    return text.str();
  }

  std::string memory_fault(double bytes, const std::string &what, const std::string &remedy,
                           unsigned int n_jobs)
  {
    const double available = available_memory();
    if (n_jobs * bytes <= available)
      return {};
    return what + ": needs some " + bytes_to_text(bytes) + " of memory" +
           (n_jobs > 1 ? " in each of " + std::to_string(n_jobs) + " processes (--jobs)" : "") +
           ", and " + bytes_to_text(available) + " are available; " +
           (bytes <= available ? "lower --jobs, or " : "") + remedy;
  }

  void require_memory(double bytes, const std::string &what, const std::string &remedy,
                      unsigned int n_jobs)
  {
    if (const std::string fault = memory_fault(bytes, what, remedy, n_jobs); !fault.empty())
      throw InputError(fault);
  }

  std::string out_of_memory()
  {
    const double resident = kernel_bytes("/proc/self/status", "VmRSS:");
    return "memory ran out: this process holds " +
           bytes_to_text(resident < unlimited ? resident : 0) + ", and " +
           bytes_to_text(available_memory()) +
           " are left; choose a larger h or a smaller horizon (Study), or a machine with more";
  }
} // namespace plumbline::base
