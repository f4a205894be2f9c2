#pragma once

#include "report/plot.h"
#include "report/selection.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  enum class ChartKind
  {
    work_precision, ///< decisive error against CPU seconds
    convergence,    ///< decisive error against what varies, h or horizon
    error_map,      ///< where each method errs, see maps.h
    solution,       ///< the solution by one method, see maps.h
    memory,         ///< decisive error against peak memory
    pairs,          ///< decisive error against the pairs summed in one operator application
    iterations      ///< of the linear solver, against what varies
  };

  /// One picture, charts/NAME.svg, and its data, charts/NAME.csv.
  struct Chart
  {
    ChartKind kind = ChartKind::convergence;
    std::string name, title;
    std::string problem, series; ///< series empty for the overall chart
  };

  /// Whether all series of the problem are in one picture.
  bool is_overall(const Chart &chart);

  /// The charts that these results have points for. The first is the overall work-precision
  /// chart: of the telling problem, with each method's points that no other series of it beats.
  std::vector<Chart> list_charts(const study::StudyResults &results);

  /// The same style for a method in every chart.
  Style style_of(const std::vector<MethodName> &methods, const std::string &name);

  /// Draw all charts into dir/charts, in one gnuplot process; charts.gp draws them again. A point
  /// whose error is zero or not a number, or whose cost is zero, is left out of the picture, and
  /// its value is an empty field in the CSV. Errors below round-off stand in a strip (see Strip) of
  /// the picture, and as they are in the CSV.
  /// @throws NumericalError  gnuplot is missing or fails; InputError  dir cannot be written
  std::vector<Chart> write_charts(const study::StudyResults &results,
                                  const std::filesystem::path &dir);
} // namespace plumbline::report
