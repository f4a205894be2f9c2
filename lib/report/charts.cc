#include "report/charts.h"

#include "report/damage_maps.h"
#include "report/formats.h"
#include "report/maps.h"
#include "report/page_script.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    /// One level of one method; NaN where a logarithmic axis has no place for the value.
    struct Point
    {
      const MethodName *method;
      const Case *one;
      const study::Record *run;
      double x, y;
      bool is_drawn() const { return std::isfinite(x) && std::isfinite(y); }
    };

    /// Iterations fill a logarithmic axis from this ratio on.
    constexpr double wide = 20;

    double positive(double value)
    {
      return value > 0 && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    }

    /// Variables may stand on a linear axis.
    double place_on(study::Axis axis, const study::Record &run)
    {
      const double x = coordinate(axis, run.key);
      return axis == study::Axis::variable ? x : positive(x);
    }

    Vertex coordinates(const study::StudyResults &results, const study::Record &run, ChartKind kind,
                       study::Axis axis)
    {
      const double error = positive(decisive_error(results, run));
      switch (kind)
      {
      case ChartKind::work_precision:
        return {positive(run.cost.seconds()), error};
      case ChartKind::memory:
        return {positive(1e-6 * static_cast<double>(run.cost.peak_bytes)), error};
      case ChartKind::pairs:
        return {positive(static_cast<double>(run.cost.n_bonds)), error};
      case ChartKind::iterations:
        return {place_on(axis, run), run.failure.empty()
                                         ? positive(run.cost.n_iterations)
                                         : std::numeric_limits<double>::quiet_NaN()};
      case ChartKind::convergence:
      case ChartKind::error_map:
      case ChartKind::solution:
        break;
      }
      return {place_on(axis, run), error};
    }

    std::string kind_slug(ChartKind kind)
    {
      switch (kind)
      {
      case ChartKind::work_precision:
        return "work-precision";
      case ChartKind::memory:
        return "memory";
      case ChartKind::pairs:
        return "pairs";
      case ChartKind::iterations:
        return "iterations";
      case ChartKind::error_map:
        return "error-maps";
      case ChartKind::solution:
        return "solution";
      case ChartKind::convergence:
        break;
      }
      return "convergence";
    }

    std::string kind_title(ChartKind kind, const std::string &variable)
    {
      switch (kind)
      {
      case ChartKind::work_precision:
        return "error against work";
      case ChartKind::memory:
        return "error against memory";
      case ChartKind::pairs:
        return "error against unknowns × bonds";
      case ChartKind::iterations:
        return "iterations of the solver";
      case ChartKind::error_map:
      case ChartKind::solution:
      case ChartKind::convergence:
        break;
      }
      return variable.empty() ? "convergence" : "error over " + variable;
    }

    /// The decisive error against something to be spared: there is a Pareto front.
    bool is_cost(ChartKind kind)
    {
      return kind == ChartKind::work_precision || kind == ChartKind::memory ||
             kind == ChartKind::pairs;
    }

    bool is_map(ChartKind kind)
    {
      return kind == ChartKind::error_map || kind == ChartKind::solution;
    }

    std::string x_label(const study::StudyResults &results, ChartKind kind, study::Axis axis)
    {
      switch (kind)
      {
      case ChartKind::work_precision:
        return "work: setup and solve [CPU s]";
      case ChartKind::memory:
        return "peak memory [MB]";
      case ChartKind::pairs:
        return "unknowns × bonds of each: pairs in one application [1]";
      case ChartKind::iterations:
      case ChartKind::convergence:
      case ChartKind::error_map:
      case ChartKind::solution:
        break;
      }
      return label(axis, results.variable);
    }

    /// The cases of a chart: one, or all of its problem.
    std::vector<const Case *> cases_of(const std::vector<Case> &all, const Chart &chart)
    {
      std::vector<const Case *> found;
      for (const Case &one : all)
        if (one.problem == chart.problem && (is_overall(chart) || one.series == chart.series))
          found.push_back(&one);
      return found;
    }

    std::vector<Point> points_of(const study::StudyResults &results,
                                 const std::vector<MethodName> &methods,
                                 const std::vector<const Case *> &chosen, ChartKind kind)
    {
      std::vector<Point> points;
      for (const MethodName &method : methods)
        for (const Case *one : chosen)
        {
          const study::Axis axis = axis_of(results, *one);
          for (const study::Record *run : runs_of(results, method.name, *one))
          {
            const Vertex v = coordinates(results, *run, kind, axis);
            points.push_back({&method, one, run, v.x, v.y});
          }
        }
      return points;
    }

    /// A verdict may be a mere number ("rate 0.1") where the regime asks no question.
    bool says_not(const study::Trend &trend)
    {
      return verdict_words(trend).compare(0, 4, "rate") != 0;
    }

    /// Other fields at least tend to a wrong limit.
    bool is_wrong(const study::Trend &trend)
    {
      return trend.outcome == study::Outcome::stalls || trend.outcome == study::Outcome::field_only;
    }

    /// The legend says which methods stall, and in how many series if not in all of the picture.
    std::string legend(const study::StudyResults &results, const MethodName &method,
                       const std::vector<const Case *> &chosen)
    {
      std::string verdict;
      std::size_t n_stalls = 0;
      for (const Case *one : chosen)
        if (const study::Trend *trend = decisive_trend(results, method.name, *one))
          if (is_wrong(*trend) && says_not(*trend))
          {
            verdict = verdict_words(*trend);
            ++n_stalls;
          }
      if (n_stalls == 0)
        return method.name;
      const std::string part = n_stalls < chosen.size() ? ": " + std::to_string(n_stalls) + " of " +
                                                              std::to_string(chosen.size())
                                                        : "";
      return method.name + " (" + verdict + part + ")";
    }

    /// Errors of the chosen cases below this are round-off, of whichever method.
    double noise_of(const study::StudyResults &results, const std::vector<MethodName> &methods,
                    const std::vector<const Case *> &chosen)
    {
      double size = 0, least = std::numeric_limits<double>::infinity();
      for (const Case *one : chosen)
        for (const MethodName &method : methods)
          if (const study::Trend *trend = decisive_trend(results, method.name, *one))
          {
            size = std::max(size, trend->size);
            if (trend->round_off > 0)
              least = std::min(least, trend->round_off);
          }
      return std::isfinite(least) ? least : round_off * (size > 0 ? size : 1);
    }

    /// The cheapest points for their error, cheap to dear; below round-off none is better. Of one
    /// method, or of all.
    std::vector<Vertex> frontier(const std::vector<Point> &points, double noise,
                                 const std::string &method = "")
    {
      std::vector<Vertex> sorted, best;
      for (const Point &point : points)
        if (point.is_drawn() && (method.empty() || point.method->name == method))
          sorted.push_back({point.x, point.y});
      std::sort(sorted.begin(), sorted.end(),
                [](const Vertex &a, const Vertex &b)
                { return a.x < b.x || (a.x == b.x && a.y < b.y); });
      for (const Vertex &v : sorted)
        if (best.empty() || (v.y < best.back().y && best.back().y > noise))
          best.push_back(v);
      return best;
    }

    Plot plot_of(const study::StudyResults &results, const std::vector<MethodName> &methods,
                 const std::vector<const Case *> &chosen, const Chart &chart,
                 const std::vector<Point> &points)
    {
      const study::Axis axis = axis_of(results, *chosen.front());
      const bool is_iterations = chart.kind == ChartKind::iterations;
      Plot plot;
      plot.file = chart.name + ".svg";
      plot.title = chart.title;
      plot.x_label = x_label(results, chart.kind, axis);
      plot.y_label = is_iterations ? "iterations [1]"
                                   : "error: " + error_words(results.decisive_error) + " [" +
                                         unit_of_errors(results) + "]";
      // with a fixed mesh errors fall as the horizon grows: no order to compare with
      plot.has_slopes = chart.kind == ChartKind::convergence && axis == study::Axis::mesh_size;
      std::vector<double> places;
      for (const Point &point : points)
        if (point.is_drawn())
          places.push_back(point.x);
      plot.is_x_log = is_cost(chart.kind) || is_logarithmic(axis, places);
      plot.shows_round_off = !is_iterations;
      plot.noise = noise_of(results, methods, chosen);

      double least = std::numeric_limits<double>::max(), most = 0;
      for (const Point &point : points)
        if (point.is_drawn())
        {
          least = std::min(least, point.y);
          most = std::max(most, point.y);
          if (plot.is_x_log && (is_iterations || chart.kind == ChartKind::convergence))
            plot.x_ticks.push_back(point.x);
        }
      plot.is_y_log = !is_iterations || most > wide * least;
      if (is_cost(chart.kind) && results.variable.empty()) // else points are of several problems
      {
        std::vector<Point> right;
        for (const Point &point : points)
          if (const study::Trend *trend = decisive_trend(results, point.method->name, *point.one);
              trend == nullptr || !is_wrong(*trend))
            right.push_back(point);
        plot.frontier = frontier(right, plot.noise);
      }

      for (const MethodName &method : methods)
      {
        // A method without a point keeps its line of the legend.
        Line line;
        line.style = style_of(methods, method.name);
        line.label = legend(results, method, chosen);
        if (chosen.size() > 1)
          line.points = frontier(points, plot.noise, method.name);
        else
          for (const Point &point : points)
            if (point.method->name == method.name && point.is_drawn())
              line.points.push_back({point.x, point.y});
        plot.lines.push_back(line);
      }
      return plot;
    }

    Table data_of(const study::StudyResults &results, const Chart &chart,
                  const std::vector<Point> &points, study::Axis axis)
    {
      const bool is_iterations = chart.kind == ChartKind::iterations;
      Table table;
      table.columns = {"method",
                       "problem",
                       "series",
                       "level",
                       x_label(results, chart.kind, axis),
                       is_iterations ? "iterations" : "error"};
      for (const Point &point : points)
        table.rows.push_back({text_cell(point.method->name), text_cell(point.one->problem),
                              text_cell(point.one->series), count_cell(point.run->key.level),
                              number_cell(point.x), number_cell(point.y)});
      return table;
    }
  } // namespace

  bool is_overall(const Chart &chart)
  {
    return chart.kind == ChartKind::work_precision && chart.name == kind_slug(chart.kind);
  }

  Style style_of(const std::vector<MethodName> &methods, const std::string &name)
  {
    unsigned int n_of_family[2] = {0, 0};
    for (const MethodName &method : methods)
    {
      unsigned int &n = n_of_family[method.is_reference() ? 1 : 0];
      if (method.name == name)
        return style_of(n, method.is_reference());
      ++n;
    }
    return style_of(0, false);
  }

  std::vector<Chart> list_charts(const study::StudyResults &results)
  {
    const std::vector<Case> all = cases(results);
    const std::vector<MethodName> names = methods(results);
    std::vector<Chart> candidates;
    if (!all.empty())
    {
      const std::string problem = telling_problem(results);
      std::string series, separator;
      std::size_t n = 0;
      for (const Case &one : all)
        if (one.problem == problem)
        {
          series += std::exchange(separator, ", ") + one.series;
          ++n;
        }
      candidates.push_back({ChartKind::work_precision, kind_slug(ChartKind::work_precision),
                            problem + ": " + kind_title(ChartKind::work_precision, "") +
                                (n > 1 ? " (of each method the best of " +
                                             (n > 4 ? std::to_string(n) + " series" : series) + ")"
                                       : ""),
                            problem, ""});
    }
    for (const ChartKind kind : {ChartKind::work_precision, ChartKind::convergence,
                                 ChartKind::memory, ChartKind::pairs, ChartKind::iterations})
      for (const Case &one : all)
        candidates.push_back({kind, kind_slug(kind) + "_" + one.slug,
                              one.title() + ": " + kind_title(kind, results.variable), one.problem,
                              one.series});

    std::vector<Chart> charts;
    for (const Chart &chart : candidates)
    {
      const std::vector<Point> points = points_of(results, names, cases_of(all, chart), chart.kind);
      if (std::any_of(points.begin(), points.end(), [](const Point &p) { return p.is_drawn(); }))
        charts.push_back(chart);
    }
    if (!results.maps.empty())
      charts.push_back({ChartKind::error_map, kind_slug(ChartKind::error_map),
                        map_title(results.maps), results.maps.front().problem,
                        results.maps.front().series});
    if (const study::ErrorMap *map = solution_map(results.maps, names))
      charts.push_back({ChartKind::solution, kind_slug(ChartKind::solution), solution_title(*map),
                        map->problem, map->series});
    return charts;
  }

  std::vector<Chart> write_charts(const study::StudyResults &results,
                                  const std::filesystem::path &dir)
  {
    const std::filesystem::path folder = dir / "charts";
    const std::vector<Case> all = cases(results);
    const std::vector<MethodName> names = methods(results);
    const std::vector<Chart> charts = list_charts(results);
    std::vector<Plot> plots;
    std::vector<std::string> pictures;
    std::string script;
    for (const Chart &chart : charts)
    {
      const std::string picture = chart.name + ".svg";
      pictures.push_back(picture);
      std::filesystem::remove(folder / picture); // no old picture beside new data
      if (is_map(chart.kind))
      {
        const study::ErrorMap *solution = solution_map(results.maps, names);
        const bool is_solution = chart.kind == ChartKind::solution;
        write_file(folder / (chart.name + ".csv"),
                   to_csv(is_solution ? solution_table(*solution) : map_table(results.maps)));
        script += is_solution ? solution_script(*solution, picture, names)
                              : map_script(results.maps, picture, names);
        continue;
      }
      const std::vector<const Case *> chosen = cases_of(all, chart);
      const std::vector<Point> points = points_of(results, names, chosen, chart.kind);
      plots.push_back(plot_of(results, names, chosen, chart, points));
      write_file(folder / (chart.name + ".csv"),
                 to_csv(data_of(results, chart, points, axis_of(results, *chosen.front()))));
    }
    if (charts.empty())
      return charts;
    write_chart_data(plots, folder);
    write_file(folder / "charts.gp", gnuplot_script(plots) + script);
    run_gnuplot(folder, "charts.gp", pictures);
    for (const Chart &chart : charts)
      if (is_map(chart.kind))
        sharpen(folder / (chart.name + ".svg"));
    return charts;
  }
} // namespace plumbline::report
