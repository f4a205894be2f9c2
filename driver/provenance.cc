#include "driver/provenance.h"

#include "base/communicator.h"

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>

#include <fstream>

namespace plumbline::driver
{
  namespace
  {
    std::string processor()
    {
      std::ifstream info("/proc/cpuinfo");
      for (std::string line; std::getline(info, line);)
        if (line.compare(0, 10, "model name") == 0)
          return line.substr(line.find(':') + 2);
      return "unknown";
    }
  } // namespace

  std::map<std::string, std::string> provenance()
  {
    return {{"plumbline", PLUMBLINE_VERSION},
            {"deal.II", DEAL_II_PACKAGE_VERSION},
            {"compiler", __VERSION__},
            {"processor", processor()},
            {"threads", std::to_string(dealii::MultithreadInfo::n_threads())},
            {"ranks", std::to_string(base::Communicator::all().n_ranks())}};
  }
} // namespace plumbline::driver
