#include "scene/kernel_table.h"

#include "base/csv.h"

namespace plumbline::scene
{
  std::vector<std::array<double, 2>> read_kernel_table(const std::string &file)
  {
    base::Csv csv(file, {"t", "rho"});
    std::vector<std::array<double, 2>> rows;
    while (csv.next())
      rows.push_back({csv.number("t"), csv.number("rho")});
    return rows;
  }
} // namespace plumbline::scene
