#include "report/memory_text.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "report/text_table.h"

#include <cmath>

namespace plumbline::report
{
  std::string memory_text(const std::vector<study::MemoryOfLevel> &estimates, unsigned int n_ranks,
                          double available, unsigned int n_here)
  {
    const bool is_of_each = n_ranks > 1, is_of_all = n_here > 1;
    Table table{"",
                {"method", "series", "h", is_of_each ? "memory of each rank" : "memory", "for",
                 is_of_all ? "all fit here" : "fits"},
                {}};
    for (const study::MemoryOfLevel &one : estimates)
      table.rows.push_back(
          {text_cell(one.method), text_cell(one.series), number_cell(one.level.h),
           text_cell(one.largest.bytes > 0 ? base::bytes_to_text(one.largest.bytes) : "little"),
           text_cell(one.largest.what),
           text_cell(n_here * one.largest.bytes <= available ? "yes" : "no")});
    return "estimated peak memory of " +
           (n_ranks > 1 ? "each of " + std::to_string(n_ranks) + " ranks"
                        : std::string("the run")) +
           ", besides that of the program itself" +
           (std::isfinite(available)
                ? "; available" +
                      std::string(is_of_all ? " to all ranks on this machine: " : ": ") +
                      base::bytes_to_text(available)
                : "") +
           "\n\n" + to_text(table);
  }

  namespace
  {
    std::string constants(const algebra::Rates &rates)
    {
      constexpr double micro = 1e6, nano = 1e9;
      return "time = work + α messages + β bytes sent; assumed: α = " +
             rounded(micro * rates.latency) + " µs, β = 1 / (" + rounded(1 / (nano * rates.byte)) +
             " GB/s),\nwork " + rounded(nano * rates.bond) +
             " ns per entry of the operator at a node, " + rounded(nano * rates.level) +
             " ns per value and level of a\nsine transform, " + rounded(nano * rates.value) +
             " ns per number of a vector (benchmarks/ranks measures them)";
    }

    std::vector<Cell> cells(const study::TimeOfLevel &level, const std::string &operation,
                            const algebra::ModelTime &time)
    {
      constexpr double milli = 1e3, mega = 1e-6;
      return {text_cell(level.method),
              text_cell(level.series),
              number_cell(level.level.h),
              count_cell(level.layout.block),
              count_cell(level.layout.n_working()),
              text_cell(operation),
              number_cell(milli * time.seconds()),
              number_cell(milli * time.work),
              number_cell(milli * time.messages),
              number_cell(milli * time.bytes),
              count_cell(time.sent.n_messages),
              number_cell(mega * static_cast<double>(time.sent.n_bytes))};
    }
  } // namespace

  std::string times_text(const std::vector<study::TimeOfLevel> &times, unsigned int n_ranks,
                         const algebra::Rates &rates)
  {
    if (times.empty())
      return "\ntime: predicted only where several ranks share the work on one box in slabs\n";
    Table table{"",
                {"method", "series", "h", "planes", "ranks at work", "operation", "time [ms]",
                 "work [ms]", "latency [ms]", "bandwidth [ms]", "messages", "sent [MB]"},
                {}};
    for (const study::TimeOfLevel &one : times)
    {
      const bool is_solved = one.iteration.seconds() > 0;
      table.rows.push_back(cells(one, is_solved ? "operator" : "forces", one.apply));
      if (is_solved)
      {
        table.rows.push_back(cells(one, "preconditioner", one.precondition));
        table.rows.push_back(cells(one, "CG iteration", one.iteration));
      }
    }
    return "\npredicted time and messages of each of " + std::to_string(n_ranks) + " ranks\n" +
           constants(rates) + "\n\n" + to_text(without_empty_columns(table));
  }
} // namespace plumbline::report
