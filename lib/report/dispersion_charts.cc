#include "report/dispersion_charts.h"

#include "report/dispersion_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    using study::DispersionResults;
    using study::DispersionRow;
    using study::WaveCurve;
    using study::WaveSample;

    std::vector<MethodName> methods_of(const DispersionResults &results)
    {
      std::vector<MethodName> methods;
      for (const DispersionRow &row : results.rows)
        if (std::none_of(methods.begin(), methods.end(),
                         [&](const MethodName &one) { return one.name == row.method; }))
          methods.push_back({row.method, row.side});
      return methods;
    }

    std::vector<std::string> series_of(const DispersionResults &results)
    {
      std::vector<std::string> all;
      for (const DispersionRow &row : results.rows)
        if (std::find(all.begin(), all.end(), row.series) == all.end())
          all.push_back(row.series);
      return all;
    }

    std::string suffix(const std::string &series)
    {
      return series.empty() ? "" : "_" + slug(series);
    }

    DataChart errors_chart(const DispersionResults &results, const std::string &series)
    {
      const auto methods = methods_of(results);
      DataChart chart =
          named("errors" + suffix(series), series + ": error of the longest wave's phase speed");
      chart.data.columns = {"method", "series", "h", "horizon", "nonlocal", "local"};
      for (const study::Trend &t : results.trends)
      {
        if (t.series != series)
          continue;
        chart.plot.x_label = study::label(t.axis, results.variable);
        chart.plot.y_label = "|c/c(nonlocal) - 1|, worst direction";
        Line line{t.method, style_of(methods, t.method), 1.8, {}};
        for (std::size_t i = 0; i < t.x.size(); ++i)
          if (t.values[i] > 0)
          {
            line.points.push_back({t.x[i], t.values[i]});
            chart.plot.x_ticks.push_back(t.x[i]);
          }
        chart.plot.lines.push_back(line);
      }
      chart.plot.has_slopes = results.variable.empty();
      if (!chart.plot.has_slopes)
        chart.plot.is_x_log = is_logarithmic(study::Axis::variable, chart.plot.x_ticks);
      if (!chart.plot.is_x_log)
        chart.plot.x_ticks.clear();
      if (!results.variable.empty())
        chart.data.columns.emplace_back(results.variable);
      for (const DispersionRow &row : results.rows)
        if (row.series == series && row.failure.empty())
        {
          chart.data.rows.push_back({text_cell(row.method), text_cell(row.series),
                                     number_cell(row.h), number_cell(row.horizon),
                                     number_cell(row.worst_nonlocal_error()),
                                     number_cell(row.worst_local_error())});
          if (!results.variable.empty())
            chart.data.rows.back().push_back(number_cell(row.value));
        }
      return chart;
    }

    /// What a chart of speeds shows of a sample.
    struct Speed
    {
      const char *name, *words;
      double WaveSample::*value;
      double WaveSample::*exact;
    };
    constexpr Speed phase{"phase", "phase speed", &WaveSample::phase, &WaveSample::exact_phase},
        group{"group", "group speed", &WaveSample::group, &WaveSample::exact_group};

    /// Speeds over the wavelength of all methods in one direction, the i-th of each row's curves.
    DataChart speeds_chart(const DispersionResults &results, const std::string &series,
                           std::size_t i, const Speed &speed)
    {
      const auto methods = methods_of(results);
      std::vector<const DispersionRow *> rows;
      for (const DispersionRow *row : finest_rows(results))
        if (row->series == series && !row->curves[i].samples.empty())
          rows.push_back(row);
      const std::string which = rows.empty() ? "" : title(rows[0]->curves[i]);
      DataChart chart = named(std::string(speed.name) + suffix(series) + "_" + slug(which),
                              series + ", " + which + ": " + speed.words);
      chart.plot.is_y_log = false;
      chart.plot.x_label = "wavelength [h]";
      chart.plot.y_label = std::string(speed.words) + " over the local limit's";
      chart.plot.x_ticks = {2, 3, 5, 10, 20, 50, 100, 200};
      chart.plot.frontier_label = "nonlocal";
      chart.data.columns = {"method", "series", "h", "wavelength over h", speed.name, "nonlocal"};
      Range range{std::numeric_limits<double>::max(), 1};
      for (const DispersionRow *row : rows)
      {
        const WaveCurve &curve = row->curves[i];
        Line line{row->method, style_of(methods, row->method), 1.8, {}, 8};
        for (const WaveSample &sample : curve.samples)
        {
          const double x = 2 * M_PI / (sample.k * row->h),
                       y = sample.*speed.value / curve.local_speed,
                       exact = sample.*speed.exact / curve.local_speed;
          chart.data.rows.push_back({text_cell(row->method), text_cell(series), number_cell(row->h),
                                     number_cell(x), number_cell(y), number_cell(exact)});
          if (row == rows[0] && std::isfinite(exact))
            chart.plot.frontier.push_back({x, exact});
          if (std::isfinite(y))
            line.points.push_back({x, y});
          for (const double v : {y, exact})
            if (std::isfinite(v))
              range = {std::min(range.low, v), std::max(range.high, v)};
        }
        chart.plot.lines.push_back(line);
      }
      const double margin = .05 * (range.high - std::min(range.low, 1.));
      chart.plot.y_range = Range{range.low - margin, range.high + margin};
      return chart;
    }

    bool has_points(const DataChart &chart, std::size_t least)
    {
      return std::any_of(chart.plot.lines.begin(), chart.plot.lines.end(),
                         [&](const Line &line) { return line.points.size() >= least; });
    }
  } // namespace

  std::vector<DataChart> dispersion_charts(const DispersionResults &results)
  {
    std::vector<DataChart> charts;
    const auto finest = finest_rows(results);
    const std::size_t n_curves = finest.empty() ? 0 : finest[0]->curves.size(),
                      n_polarisations = finest.empty() ? 0 : finest[0]->anisotropy.size();
    const auto add = [&](const DataChart &chart, std::size_t least)
    {
      if (has_points(chart, least))
        charts.push_back(chart);
    };
    for (const std::string &series : series_of(results))
    {
      add(errors_chart(results, series), 2);
      for (std::size_t i = 0; i < n_curves; ++i)
        add(speeds_chart(results, series, i, phase), 1);
      for (std::size_t i = 0; i < n_polarisations; ++i)
        add(speeds_chart(results, series, i, group), 1);
    }
    return charts;
  }
} // namespace plumbline::report
