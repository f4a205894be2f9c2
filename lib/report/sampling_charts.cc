#include "report/counted.h"
#include "report/damage_maps.h"
#include "report/sampling_page.h"
#include "report/spectrum_chart.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumbline::report
{
  namespace
  {
    using study::CaseStatistics;
    using study::SamplingResults;
    using study::SetStatistics;

    using Value = std::function<std::optional<double>(const SetStatistics &)>;

    std::optional<double> mean_error(const SetStatistics &set)
    {
      return set.mean_error;
    }

    std::optional<double> deviation_error(const SetStatistics &set)
    {
      return set.deviation_error;
    }

    const char *const error_label = "error, L2 over the domain [unit of the field]";

    /// Variables and quantities by any name.
    std::string in_units_of_scene(const std::string &name)
    {
      return name + " [in units of the scene]";
    }

    /// Lines by label.
    Line &line_of(std::vector<Line> &lines, const std::string &label, bool is_dashed)
    {
      const auto found =
          std::find_if(lines.begin(), lines.end(), [&](const Line &l) { return l.label == label; });
      if (found != lines.end())
        return *found;
      lines.push_back(
          {label, style_of(static_cast<unsigned int>(lines.size()), is_dashed), 1.8, {}, 1});
      return lines.back();
    }

    bool has_several_methods(const SamplingResults &results)
    {
      return std::any_of(results.cases.begin(), results.cases.end(),
                         [&](const CaseStatistics &c)
                         { return c.of.method != results.cases.front().of.method; });
    }

    std::string name_of(const SamplingResults &results, const CaseStatistics &one)
    {
      return has_several_methods(results) ? one.of.method + ", " : "";
    }

    /// Where there are several.
    std::string name_of(const SamplingResults &results, uq::SampleRule rule)
    {
      return results.sampling.has_several_rules() ? ", " + base::word(rule) : "";
    }

    DataChart empty_chart(const std::string &name, const std::string &title,
                          const std::string &x_label, const std::string &y_label,
                          const std::string &caption)
    {
      DataChart chart = named(name, title, caption);
      chart.plot.x_label = x_label;
      chart.plot.y_label = y_label;
      chart.data.columns = {"method", "h", "modes", "samples", "seconds", "value"};
      return chart;
    }

    /// @param x  of a case and set; @param label  of their line
    template <class X, class Label>
    void fill(const SamplingResults &results, DataChart &chart, const Value &value, const X &x,
              const Label &label)
    {
      for (const CaseStatistics &one : results.cases)
        for (const SetStatistics &set : one.sets)
          if (const auto y = value(set); y && *y > 0 && x(one, set) > 0)
          {
            line_of(chart.plot.lines, label(one, set), false).points.push_back({x(one, set), *y});
            chart.data.rows.push_back({text_cell(one.of.method), number_cell(one.of.h),
                                       count_cell(set.n_modes), count_cell(set.n_samples),
                                       number_cell(set.seconds), error_cell(*y)});
            if (results.sampling.has_several_rules())
              chart.data.rows.back().push_back(text_cell(base::word(set.rule)));
          }
      if (results.sampling.has_several_rules())
        chart.data.columns.emplace_back("rule");
      for (Line &line : chart.plot.lines)
        std::sort(line.points.begin(), line.points.end(),
                  [](const Vertex &a, const Vertex &b) { return a.x < b.x; });
    }

    /// One value of x has nothing to show.
    bool has_width(const Plot &plot)
    {
      std::set<double> all;
      for (const Line &line : plot.lines)
        for (const Vertex &point : line.points)
          all.insert(point.x);
      return all.size() > 1;
    }

    void add_errors(const SamplingResults &results, const std::string &what, const Value &value,
                    std::vector<DataChart> &charts)
    {
      const auto samples = [](const CaseStatistics &, const SetStatistics &set)
      { return static_cast<double>(set.n_samples); };
      // 0 is not drawn: errors without the mesh's say nothing over h or seconds
      const auto h = [](const CaseStatistics &one, const SetStatistics &)
      { return one.is_target_level ? 0 : one.of.h; };
      const auto seconds = [](const CaseStatistics &one, const SetStatistics &set)
      { return one.is_target_level ? 0 : set.seconds; };
      const auto modes = [](const CaseStatistics &, const SetStatistics &set)
      { return static_cast<double>(set.n_modes); };
      const auto of_rule_and_modes = [&](const SetStatistics &set)
      {
        return name_of(results, set.rule) +
               (results.sampling.modes.empty() ? "" : ", " + counted(set.n_modes, "mode"));
      };
      const auto of_h = [&](const CaseStatistics &one)
      {
        return name_of(results, one) + "h = " + rounded(one.of.h) +
               (one.is_target_level ? " (finest)" : "");
      };
      const auto by_h = [&](const CaseStatistics &one, const SetStatistics &set)
      { return of_h(one) + of_rule_and_modes(set); };
      const auto by_set = [&](const CaseStatistics &one, const SetStatistics &set)
      { return name_of(results, one) + counted(set.n_samples, "sample") + of_rule_and_modes(set); };
      const auto by_count = [&](const CaseStatistics &one, const SetStatistics &set)
      { return of_h(one) + name_of(results, set.rule) + ", count " + std::to_string(set.count); };
      DataChart over_samples = empty_chart(
          what + "-samples", "Error of the " + what + " versus samples", "samples [1]", error_label,
          "Each line falls at the rate of the sampling rule down to the discretisation error, "
          "which "
          "more samples cannot reduce.");
      fill(results, over_samples, value, samples, by_h);
      DataChart over_h = empty_chart(what + "-h", "Error of the " + what + " versus h",
                                     "mesh size h [length]", error_label,
                                     "Each line falls at the order of the discretisation down to "
                                     "the sampling error, which finer meshes cannot reduce.");
      over_h.plot.has_slopes = true;
      fill(results, over_h, value, h, by_set);
      DataChart over_time = empty_chart(
          what + "-cost", "Error of the " + what + " versus CPU time", "CPU time [s]", error_label,
          "All pairs of h and samples. At each CPU time the lowest line has the best h; where "
          "two lines cross, both are equally good.");
      fill(results, over_time, value, seconds, by_h);
      DataChart over_modes = empty_chart(what + "-modes", "Error of the " + what + " versus modes",
                                         "modes of the field [1]", error_label,
                                         "Each line falls with the variance of the omitted modes, "
                                         "down to the discretisation and sampling errors.");
      if (!results.sampling.modes.empty())
        fill(results, over_modes, value, modes, by_count);
      for (DataChart *const chart : {&over_samples, &over_h, &over_modes, &over_time})
        if (has_width(chart->plot))
          charts.push_back(std::move(*chart));
    }

    /// How quantities depend on the one variable that there is: a line for each method and level.
    void add_dependences(const SamplingResults &results, std::vector<DataChart> &charts)
    {
      if (results.variables.size() != 1 || !results.sampling.is_axis())
        return;
      std::set<std::string> names;
      for (const CaseStatistics &one : results.cases)
        for (const auto &[name, values] : one.values)
          names.insert(name);
      for (const std::string &name : names)
      {
        const std::string &variable = results.variables.front();
        DataChart chart =
            named(slug("over-" + variable + "-" + name), name + " over " + variable,
                  name + " at each value of " + variable + ", for each method and level.");
        chart.plot.x_label = in_units_of_scene(variable);
        chart.plot.y_label = in_units_of_scene(name);
        chart.plot.is_x_log = false;
        chart.data.columns = {"method", "case", "series", "h", variable, "value"};
        bool is_positive = true;
        for (const CaseStatistics &one : results.cases)
        {
          const auto found = one.values.find(name);
          if (found == one.values.end())
            continue;
          Line &line =
              line_of(chart.plot.lines,
                      one.of.method + (one.of.problem.empty() ? "" : ", " + one.of.problem) + ", " +
                          one.of.series + ", h = " + rounded(one.of.h),
                      false);
          for (std::size_t i = 0; i < one.samples.size(); ++i)
          {
            const auto &y = found->second[i];
            if (!y)
              continue;
            const double x = results.points[one.samples[i]].front();
            is_positive = is_positive && *y > 0;
            line.points.push_back({x, *y});
            chart.data.rows.push_back({text_cell(one.of.method), text_cell(one.of.problem),
                                       text_cell(one.of.series), number_cell(one.of.h),
                                       number_cell(x), error_cell(*y)});
          }
          std::sort(line.points.begin(), line.points.end(),
                    [](const Vertex &a, const Vertex &b) { return a.x < b.x; });
        }
        chart.plot.is_y_log = is_positive;
        charts.push_back(std::move(chart));
      }
    }

    /// Of samples of equal weights, where there are enough to see something.
    void add_histograms(const SamplingResults &results, std::vector<DataChart> &charts)
    {
      constexpr std::size_t least = 16;
      const auto &rules = results.sampling.rules; // samples are those of the first
      const bool is_of_equal_weights =
          !rules.empty() && (rules.front() == uq::SampleRule::monte_carlo ||
                             rules.front() == uq::SampleRule::quasi_monte_carlo);
      for (const CaseStatistics &one : results.cases)
        for (const auto &[name, of_samples] : one.values)
        {
          std::vector<double> values;
          for (const auto &value : of_samples)
            if (value)
              values.push_back(*value);
          if (values.size() < least || !is_of_equal_weights)
            continue;
          const auto n = static_cast<unsigned int>(
              std::ceil(2 * std::cbrt(static_cast<double>(values.size()))));
          const auto counts = uq::histogram(values, n);
          const auto [least_value, largest] = std::minmax_element(values.begin(), values.end());
          if (!(*largest > *least_value))
            continue;
          DataChart chart =
              empty_chart(slug("histogram-" + one.of.method + "-" + rounded(one.of.h) + "-" + name),
                          name + (has_several_methods(results) ? ", " + one.of.method : ""),
                          in_units_of_scene(name), "samples [1]",
                          "Distribution of " + name + " over the samples.");
          chart.plot.is_x_log = chart.plot.is_y_log = false;
          chart.data.columns = {"from", "to", "samples"};
          Line bars{"", style_of(0, false), 1.8, {}, 1000000};
          const double width = (*largest - *least_value) / n;
          for (unsigned int i = 0; i < n; ++i)
          {
            const double from = *least_value + i * width;
            for (const double x : {from, from + width})
              bars.points.push_back({x, static_cast<double>(counts[i])});
            chart.data.rows.push_back(
                {number_cell(from), number_cell(from + width), count_cell(counts[i])});
          }
          chart.plot.lines = {bars};
          charts.push_back(std::move(chart));
        }
    }
  } // namespace

  std::vector<Picture> sampling_pictures(const SamplingResults &results)
  {
    const auto is_growth = [](const CaseStatistics &one)
    { return one.field && one.values.count("broken bonds") > 0; };
    if (std::none_of(results.cases.begin(), results.cases.end(), is_growth))
      return {};
    const CaseStatistics &one = results.cases.front();
    const auto &nodes = one.field->places.points;
    const MapCells cells = cells_of(nodes, one.of.h);
    const std::string title = "Damage: broken bonds";
    const bool is_cut = results.cases.back().leading()->negative_part > 0;
    return {{"damage", title,
             damage_script({map_of("mean", nodes, one.field->mean, cells),
                            map_of("deviation", nodes, one.field->deviation, cells)},
                           "damage.svg", title, cells),
             std::string("Mean and standard deviation, over the samples of the largest set, of the "
                         "fraction of each node's bonds that is broken or cut.") +
                 (is_cut ? " Where the variance is negative, the deviation is drawn as 0." : "")}};
  }

  std::vector<DataChart> sampling_charts(const SamplingResults &results)
  {
    std::vector<DataChart> charts;
    add_dependences(results, charts);
    if (!results.sampling.is_axis())
    {
      add_errors(results, "mean", mean_error, charts);
      add_errors(results, "deviation", deviation_error, charts);
    }
    add_histograms(results, charts);
    if (results.spectrum && results.spectrum->variance_kept() > 0)
      charts.push_back(spectrum_chart(results.spectrum->share, results.spectrum->kept,
                                      words_of(*results.spectrum)));
    return charts;
  }
} // namespace plumbline::report
