#include "report/spectrum_chart.h"

namespace plumbline::report
{
  DataChart spectrum_chart(const std::vector<double> &share, const std::vector<double> &kept,
                           const std::string &words)
  {
    DataChart chart = named(
        "spectrum", "Variance of the modes",
        "Eigenvalues relative to the variance of the field, and their cumulative sum: " + words +
            ".");
    chart.plot.x_label = "mode [1]";
    chart.plot.y_label = "share of the variance [1]";
    chart.plot.is_x_log = false;
    chart.data.columns = {"mode", "share", "kept"};
    Line each{"each mode", style_of(0, false), 1.8, {}, 1},
        sum{"cumulative", style_of(1, false), 1.8, {}, 1};
    for (std::size_t k = 0; k < share.size(); ++k)
    {
      const auto mode = static_cast<double>(k + 1);
      if (share[k] > 0)
        each.points.push_back({mode, share[k]});
      if (kept[k] > 0)
        sum.points.push_back({mode, kept[k]});
      chart.plot.x_ticks.push_back(mode);
      chart.data.rows.push_back({count_cell(k + 1), error_cell(share[k]), error_cell(kept[k])});
    }
    chart.plot.lines = {sum, each};
    return chart;
  }
} // namespace plumbline::report
