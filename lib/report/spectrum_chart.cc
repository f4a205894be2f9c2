#include "report/spectrum_chart.h"

namespace plumbline::report
{
  DataChart spectrum_chart(const uq::Spectrum &spectrum)
  {
    DataChart chart = named("spectrum", "Variance that modes hold",
                            "Eigenvalues over the variance of the whole field, and their sums: " +
                                words_of(spectrum) + ".");
    chart.plot.x_label = "mode";
    chart.plot.y_label = "share of the variance";
    chart.plot.is_x_log = false;
    chart.data.columns = {"mode", "share", "kept"};
    Line each{"of each mode", style_of(0, false), 1.8, {}, 1},
        sum{"of all up to it", style_of(1, false), 1.8, {}, 1};
    for (std::size_t k = 0; k < spectrum.share.size(); ++k)
    {
      const auto mode = static_cast<double>(k + 1);
      if (spectrum.share[k] > 0)
        each.points.push_back({mode, spectrum.share[k]});
      if (spectrum.kept[k] > 0)
        sum.points.push_back({mode, spectrum.kept[k]});
      chart.data.rows.push_back(
          {count_cell(k + 1), error_cell(spectrum.share[k]), error_cell(spectrum.kept[k])});
    }
    chart.plot.lines = {sum, each};
    return chart;
  }
} // namespace plumbline::report
