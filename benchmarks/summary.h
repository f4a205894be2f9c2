#pragma once

#include "machine.h"

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace plumbline::benchmarks
{
  /// What one iteration of a benchmark cannot do without, by a model that stands where it is used:
  /// all numbers that come in or go out, moved once, no arithmetic but that of the formula, and the
  /// loads of its operands.
  struct Work
  {
    double flop = 0;        ///< additions and multiplications
    double loads = 0;       ///< numbers brought to registers [bytes]
    double bytes = 0;       ///< moved from and to where the working set lies
    double working_set = 0; ///< all that an iteration touches: which memory serves it [bytes]
  };

  /// Counters of a benchmark.
  /// @param units    what time is given by, e.g. "bonds"
  /// @param n_units  of one iteration
  void count(benchmark::State &state, const std::string &units, double n_units,
             const Work &work = {});

  /// A further rate.
  void count_also(benchmark::State &state, const std::string &units, double n_units);

  /// The usual table, and after it what the machine can do at most and how far each benchmark is
  /// from that: the fraction of the limit that comes first, arithmetic, loads or memory. Then how
  /// many times slower the sparse matrix is than the other backends.
  class Summary : public benchmark::ConsoleReporter
  {
  public:
    Summary(); ///< measures the machine, and once more at the end
    void ReportRuns(const std::vector<Run> &runs) override;
    void Finalize() override;

  private:
    struct Row
    {
      std::string name, units;
      double seconds; ///< of CPU time, an iteration
      std::map<std::string, double> counters;
    };

    void print_machine(const Machine &before, const Machine &after) const;
    void print_rows(const Machine &machine) const;
    void print_ratios() const;

    Machine before_;
    std::vector<Row> rows_;
  };
} // namespace plumbline::benchmarks
