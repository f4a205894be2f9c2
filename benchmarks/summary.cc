#include "summary.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <sstream>

#include <unistd.h>

namespace plumbline::benchmarks
{
  namespace
  {
    constexpr double per_giga = 1e-9;

    benchmark::Counter rate(double n)
    {
      return {n, benchmark::Counter::kIsIterationInvariantRate};
    }

    std::string format(const char *how, double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), how, value);
      return text;
    }

    /// Three digits without powers of ten.
    std::string short_number(double value)
    {
      return value <= 0 ? "-" : format(value < 100 ? "%.3g" : "%.0f", value);
    }

    double value(const std::map<std::string, double> &counters, const std::string &name)
    {
      const auto at = counters.find(name);
      return at == counters.end() ? 0 : at->second;
    }
  } // namespace

  void count(benchmark::State &state, const std::string &units, double n_units, const Work &work)
  {
    state.SetLabel(units);
    count_also(state, units, n_units);
    if (work.flop > 0)
      state.counters["flop/s"] = rate(work.flop);
    if (work.loads > 0)
      state.counters["loads/s"] = rate(work.loads);
    if (work.bytes > 0)
    {
      state.counters["bytes/s"] = rate(work.bytes);
      state.counters["working set"] = work.working_set;
    }
  }

  void count_also(benchmark::State &state, const std::string &units, double n_units)
  {
    state.counters[units + "/s"] = rate(n_units);
  }

  Summary::Summary()
      : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_ColorTabular : OO_Tabular),
        before_(measure_machine())
  {
    for (const Machine::Level &level : before_.levels)
      benchmark::AddCustomContext(level.name + " [GB/s]",
                                  format("%.1f", level.bandwidth() * per_giga));
    benchmark::AddCustomContext("L1 loads [GB/s]", format("%.1f", before_.loads * per_giga));
    benchmark::AddCustomContext("arithmetic [Gflop/s]", format("%.1f", before_.flop * per_giga));
  }

  void Summary::ReportRuns(const std::vector<Run> &runs)
  {
    ConsoleReporter::ReportRuns(runs);
    for (const Run &run : runs)
    {
      if (run.run_type != Run::RT_Iteration || run.error_occurred)
        continue;
      Row row{run.benchmark_name(),
              run.report_label,
              run.cpu_accumulated_time / static_cast<double>(run.iterations),
              {}};
      for (const auto &[name, counter] : run.counters)
        row.counters[name] = counter.value;
      rows_.push_back(row);
    }
  }

  void Summary::print_machine(const Machine &before, const Machine &after) const
  {
    std::ostream &out = GetOutputStream();
    out << "\nOne core of this machine at most, measured before and after the benchmarks\n";
    const auto line = [&](const std::string &what, double first, double second, const char *unit)
    {
      const double change = std::abs(second - first) / std::max(first, second);
      constexpr double noisy = .1;
      out << "  " << std::left << std::setw(24) << what << std::right << std::setw(8)
          << format("%.1f", first * per_giga) << std::setw(8) << format("%.1f", second * per_giga)
          << ' ' << unit << (change > noisy ? "  (unsteady: others use this machine)" : "") << '\n';
    };
    for (std::size_t i = 0; i < before.levels.size(); ++i)
    {
      line(before.levels[i].name + ", triad", before.levels[i].triad, after.levels[i].triad,
           "GB/s");
      line(before.levels[i].name + ", sum", before.levels[i].sum, after.levels[i].sum, "GB/s");
    }
    line("L1 loads, any alignment", before.loads, after.loads, "GB/s");
    line("arithmetic", before.flop, after.flop, "Gflop/s");
  }

  void Summary::print_rows(const Machine &machine) const
  {
    std::size_t longest = 0;
    for (const Row &row : rows_)
      longest = std::max(longest, row.name.size());
    const auto line = [&](const std::string &name, const std::string &time,
                          const std::string &units, const std::string &flop,
                          const std::string &bytes, const std::string &limit,
                          const std::string &fraction)
    {
      GetOutputStream() << "  " << std::left << std::setw(static_cast<int>(longest)) << name
                        << std::right << std::setw(9) << time << ' ' << std::left << std::setw(10)
                        << units << std::right << std::setw(8) << flop << std::setw(7) << bytes
                        << "  " << std::left << std::setw(11) << limit << std::right << std::setw(6)
                        << fraction << '\n';
    };
    line("benchmark", "ns", "one of", "Gflop/s", "GB/s", "bound by", "of it");
    for (const Row &row : rows_)
    {
      const double per_second = value(row.counters, row.units + "/s");
      if (per_second == 0)
        continue; // a whole solve
      const double flop = value(row.counters, "flop/s"), bytes = value(row.counters, "bytes/s");
      const Machine::Level &level = machine.serving(value(row.counters, "working set"));
      const std::pair<double, std::string> limits[] = {
          {flop / machine.flop, "arithmetic"},
          {value(row.counters, "loads/s") / machine.loads, "L1 loads"},
          {bytes / level.bandwidth(), level.name}};
      const auto &[fraction, limit] = *std::max_element(std::begin(limits), std::end(limits));
      line(row.name, short_number(1e9 / per_second), row.units,
           flop > 0 ? format("%.1f", flop * per_giga) : "-",
           bytes > 0 ? format("%.1f", bytes * per_giga) : "-", fraction > 0 ? limit : "-",
           fraction > 0 ? format("%.0f %%", 100 * fraction) : "-");
    }
  }

  void Summary::print_ratios() const
  {
    std::map<std::string, double> seconds;
    for (const Row &row : rows_)
      seconds[row.name] = row.seconds;
    std::ostringstream lines;
    for (const auto &[name, time] : seconds)
      for (const std::string backend : {"direct", "fft"})
        if (const auto at = name.find("/" + backend + "/"); at != std::string::npos)
        {
          std::string sparse = name;
          sparse.replace(at + 1, backend.size(), "sparse");
          if (seconds.count(sparse) > 0)
            lines << "  " << name << ": " << seconds.at(sparse) / time << '\n';
        }
    if (!lines.str().empty())
      GetOutputStream() << "\nCPU time of the sparse matrix over that of the same operator by\n"
                        << lines.str();
  }

  void Summary::Finalize()
  {
    const Machine after = measure_machine();
    print_machine(before_, after);
    GetOutputStream() << "\nHow far from that: CPU time a unit; arithmetic done and bytes moved at "
                         "least, by the models in the sources;\nthe limit that comes first and the "
                         "fraction reached of it. No model (-): branches and functions, whose "
                         "instructions\nbenchmarks/guard counts\n";
    print_rows(best_of(before_, after));
    print_ratios();
  }
} // namespace plumbline::benchmarks
