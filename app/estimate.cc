#include "estimate.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "methods.h"
#include "report/text_table.h"
#include "study/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumbline::app
{
  int print_estimate(const RunOptions &options, const scene::Scene &scene)
  {
    if (scene.time.is_dynamic() && !scene.domain.is_in_space())
      throw InputError("--estimate: the memory of transient analyses is estimated in three "
                       "dimensions only; in the plane, run the first levels only (--levels)");
    const base::Communicator ranks = base::Communicator::all();
    method::Methods methods = study::choose_methods(scene, all_methods());
    if (scene.reference.method && !scene.time.is_dynamic())
    {
      const auto reference =
          study::find_method(all_methods(), *scene.reference.method, "Reference/method");
      if (std::none_of(methods.begin(), methods.end(),
                       [&](const auto &one) { return one->name() == reference->name(); }))
        methods.push_back(reference);
    }
    const auto estimates =
        study::estimate_memory(scene, methods, options.n_levels, ranks.n_ranks());
    if (ranks.rank() != 0)
      return 0;
    const double available = base::available_memory();
    report::Table table{"", {"method", "series", "h", "memory", "for", "fits"}, {}};
    for (const study::MemoryOfLevel &one : estimates)
      table.rows.push_back(
          {report::text_cell(one.method), report::text_cell(one.series),
           report::number_cell(one.level.h),
           report::text_cell(one.largest.bytes > 0 ? base::bytes_to_text(one.largest.bytes)
                                                   : "little"),
           report::text_cell(one.largest.what),
           report::text_cell(one.largest.bytes <= available ? "yes" : "no")});
    std::cout << "estimated peak memory of "
              << (ranks.n_ranks() > 1 ? "each of " + std::to_string(ranks.n_ranks()) + " ranks"
                                      : "the run")
              << ", besides that of the program itself"
              << (std::isfinite(available) ? "; available: " + base::bytes_to_text(available) : "")
              << "\n\n"
              << report::to_text(table) << "\ntime: not estimated before a run\n";
    return 0;
  }
} // namespace plumbline::app
