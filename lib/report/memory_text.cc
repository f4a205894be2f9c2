#include "report/memory_text.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "report/text_table.h"

#include <cmath>

namespace plumbline::report
{
  std::string memory_text(const std::vector<study::MemoryOfLevel> &estimates, unsigned int n_ranks,
                          double available)
  {
    Table table{"", {"method", "series", "h", "memory", "for", "fits"}, {}};
    for (const study::MemoryOfLevel &one : estimates)
      table.rows.push_back(
          {text_cell(one.method), text_cell(one.series), number_cell(one.level.h),
           text_cell(one.largest.bytes > 0 ? base::bytes_to_text(one.largest.bytes) : "little"),
           text_cell(one.largest.what), text_cell(one.largest.bytes <= available ? "yes" : "no")});
    return "estimated peak memory of " +
           (n_ranks > 1 ? "each of " + std::to_string(n_ranks) + " ranks"
                        : std::string("the run")) +
           ", besides that of the program itself" +
           (std::isfinite(available) ? "; available: " + base::bytes_to_text(available) : "") +
           "\n\n" + to_text(table) + "\ntime: not estimated before a run\n";
  }
} // namespace plumbline::report
