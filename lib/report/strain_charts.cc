#include "report/strain_charts.h"

#include "report/charts.h"
#include "report/text_table.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using study::MethodGrowth;
    using study::StrainGrowth;
    using study::StrainSample;

    std::string amplitude_head()
    {
      return "X = β ε g²";
    }

    Line criterion(const StrainGrowth &growth)
    {
      Line line{"criterion (64)", {"#444444", 3, true}, 1.4, {}};
      line.points.push_back({growth.thresholds.local, 0});
      for (const StrainSample &sample : growth.samples)
        if (sample.amplitude > growth.thresholds.local)
          line.points.push_back({sample.amplitude, sample.local});
      return line;
    }

    DataChart chart_of(const StrainGrowth &growth)
    {
      std::vector<MethodName> methods;
      for (const MethodGrowth &one : growth.methods)
        methods.push_back({one.method, one.side});
      DataChart chart;
      chart.name =
          "growth_" + slug(growth.name) + (growth.series.empty() ? "" : "_") + slug(growth.series);
      chart.caption = growth.series + ", h = " + rounded(growth.h) + ": " + growth.name +
                      " strain, growth of waves";
      chart.plot.file = chart.name + ".svg";
      chart.plot.title = chart.caption;
      chart.plot.x_label = amplitude_head();
      chart.plot.y_label = "growth rate [1/time]";
      chart.plot.is_x_log = chart.plot.is_y_log = false;
      chart.plot.frontier_label = "symbol";
      const double end = growth.samples.back().amplitude;
      for (double x = 0; x <= end; x += end < 2 ? .25 : end < 4 ? .5 : 1)
        chart.plot.x_ticks.push_back(x);
      if (growth.first_wave > 0)
        chart.plot.frontier.push_back({growth.first_wave, 0});
      chart.data.columns = {"method", "X",     "strain", "k1",      "k2",
                            "symbol", "local", "linear", "observed"};
      for (const StrainSample &sample : growth.samples)
        if (sample.symbol > 0)
          chart.plot.frontier.push_back({sample.amplitude, sample.symbol});
      for (const MethodGrowth &one : growth.methods)
      {
        Line line{one.method, style_of(methods, one.method), 1.2, {}};
        for (std::size_t i = 0; i < one.observed.size(); ++i)
        {
          const StrainSample &sample = growth.samples[i];
          line.points.push_back({sample.amplitude, one.observed[i]});
          chart.data.rows.push_back({text_cell(one.method), number_cell(sample.amplitude),
                                     number_cell(sample.strain), number_cell(sample.wave[0]),
                                     number_cell(sample.wave[1]), number_cell(sample.symbol),
                                     number_cell(sample.local), number_cell(one.linear[i]),
                                     number_cell(one.observed[i])});
        }
        if (!line.points.empty())
          chart.plot.lines.push_back(line);
      }
      chart.plot.lines.push_back(criterion(growth));
      return chart;
    }

    /// The X of the first sample that was seen to grow; 0: none.
    double first_seen(const StrainGrowth &growth, const MethodGrowth &one)
    {
      for (std::size_t i = 0; i < one.observed.size(); ++i)
        if (one.observed[i] > 0)
          return growth.samples[i].amplitude;
      return 0;
    }
  } // namespace

  const char *const strain_thresholds_words =
      "X = beta eps g^2 of the strain g, from which on waves grow: of any length on the whole "
      "plane "
      "(ellipticity of the local limit is lost); of this torus, four mesh sizes long or longer; by "
      "the symbol of the bonds; and "
      "from which on the local criterion (64) of Jha & Lipton 2018, doi:10.1137/17M1112236, says "
      "so: it is sufficient, but late where its X is larger.";

  const char *const strain_growth_words =
      "observed: the motion of the wave that grows fastest by the symbol, started at 1e-10 of the "
      "horizon; first seen is the first X of the samples at which it grew. Differences are over "
      "the symbol's largest rate: from the symbol, and from the rule's own tangent.";

  std::vector<DataChart> strain_charts(const std::vector<StrainGrowth> &growths)
  {
    std::vector<DataChart> charts;
    for (const StrainGrowth &growth : growths)
      charts.push_back(chart_of(growth));
    return charts;
  }

  Table strain_thresholds_table(const std::vector<StrainGrowth> &growths)
  {
    Table table;
    table.columns = {"series", "horizon", "strain", "X, any wave", "X, of this torus", "X, (64)"};
    for (const StrainGrowth &growth : growths)
      table.rows.push_back({text_cell(growth.series), number_cell(growth.horizon),
                            text_cell(growth.name), number_cell(growth.thresholds.ellipticity),
                            known(growth.first_wave > 0, number_cell(growth.first_wave)),
                            number_cell(growth.thresholds.local)});
    return table;
  }

  Table strain_growth_table(const std::vector<StrainGrowth> &growths)
  {
    Table table;
    table.columns = {"series",          "h",           "strain",       "method",
                     "first seen at X", "from symbol", "from tangent", "no motion, because"};
    for (const StrainGrowth &growth : growths)
      for (const MethodGrowth &one : growth.methods)
      {
        const bool is_known = one.failure.empty();
        const double seen = first_seen(growth, one);
        table.rows.push_back({text_cell(growth.series), number_cell(growth.h),
                              text_cell(growth.name), text_cell(one.method),
                              known(seen > 0, number_cell(seen)),
                              known(is_known, error_cell(growth.difference(one))),
                              known(is_known, error_cell(growth.own_difference(one))),
                              known(!is_known, text_cell(one.failure))});
      }
    return without_empty_columns(table);
  }
} // namespace plumbline::report
