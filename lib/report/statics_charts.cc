#include "report/maps.h"
#include "report/statics_view.h"
#include "report/surfaces.h"
#include "scene/choices.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    /// What a chart draws against what, of one case or of several.
    struct Kind
    {
      std::string name, title;       ///< the name begins those of files
      std::string x_label;           ///< empty: what varies
      double (*x)(const Record &);   ///< something to be spared; none: what varies
      bool is_of_iterations = false; ///< else of the decisive error
      bool is_cost() const { return x != nullptr; }
    };

    const Kind work = {"work-precision", "error against work", "work: setup and solve [CPU s]",
                       [](const Record &run) { return run.cost.seconds(); }},
               memory = {"memory", "error against memory", "peak memory [MB]",
                         [](const Record &run)
                         { return 1e-6 * static_cast<double>(run.cost.peak_bytes); }},
               pairs = {"pairs", "error against unknowns × bonds",
                        "unknowns × bonds of each: pairs in one application [1]",
                        [](const Record &run) { return static_cast<double>(run.cost.n_bonds); }},
               iterations = {"iterations", "iterations of the solver", "", nullptr, true};

    /// One level of one method; NaN where a logarithmic axis has no place for the value.
    struct Point
    {
      const MethodName *method;
      const Case *one;
      const Record *run;
      double x, y;
      bool is_drawn() const { return std::isfinite(x) && std::isfinite(y); }
    };

    /// Iterations fill a logarithmic axis from this ratio on.
    constexpr double wide = 20;

    double positive(double value)
    {
      return value > 0 && std::isfinite(value) ? value : not_a_number;
    }

    std::vector<Point> points_of(const StudyResults &results,
                                 const std::vector<MethodName> &methods,
                                 const std::vector<Case> &chosen, const Kind &kind)
    {
      std::vector<Point> points;
      for (const MethodName &method : methods)
        for (const Case &one : chosen)
        {
          const study::Axis axis = axis_of(results, one);
          for (const Record *run : runs_of(results, method.name, one))
          {
            const double x = kind.is_cost() ? kind.x(*run) : coordinate(axis, run->key),
                         y = !kind.is_of_iterations ? decisive_error(results, *run)
                             : run->failure.empty() ? run->cost.n_iterations
                                                    : 0;
            const bool is_anywhere = !kind.is_cost() && axis == study::Axis::variable;
            points.push_back({&method, &one, run, is_anywhere ? x : positive(x), positive(y)});
          }
        }
      return points;
    }

    /// A verdict may be a mere number ("rate 0.1") where the regime asks no question.
    bool says_not(const study::Trend &trend)
    {
      return verdict_words(trend).compare(0, 4, "rate") != 0;
    }

    /// Whether the limit is wrong, for this field or for others.
    bool is_wrong(const study::Trend &trend)
    {
      return trend.outcome == study::Outcome::stalls || trend.outcome == study::Outcome::field_only;
    }

    /// The legend says which methods stall, and in how many series if not in all of the picture.
    std::string legend(const StudyResults &results, const MethodName &method,
                       const std::vector<Case> &chosen)
    {
      std::string verdict;
      std::size_t n_stalls = 0;
      for (const Case &one : chosen)
        if (const study::Trend *trend = decisive_trend(results, method.name, one))
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
    double noise_of(const StudyResults &results, const std::vector<MethodName> &methods,
                    const std::vector<Case> &chosen)
    {
      double size = 0, least = std::numeric_limits<double>::infinity();
      for (const Case &one : chosen)
        for (const MethodName &method : methods)
          if (const study::Trend *trend = decisive_trend(results, method.name, one))
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

    void draw(const StudyResults &results, const std::vector<MethodName> &methods,
              const std::vector<Case> &chosen, const Kind &kind, const std::vector<Point> &points,
              Plot &plot)
    {
      const study::Axis axis = axis_of(results, chosen.front());
      const bool is_iterations = kind.is_of_iterations;
      plot.x_label = kind.is_cost() ? kind.x_label : label(axis, results.variable);
      plot.y_label = is_iterations ? "iterations [1]"
                                   : "error: " + error_words(results.decisive_error) + " [" +
                                         unit_of_errors(results) + "]";
      // with a fixed mesh errors fall as the horizon grows: no order to compare with
      plot.has_slopes = !kind.is_cost() && !is_iterations && axis == study::Axis::mesh_size;
      std::vector<double> places;
      for (const Point &point : points)
        if (point.is_drawn())
          places.push_back(point.x);
      plot.is_x_log = kind.is_cost() || is_logarithmic(axis, places);
      plot.shows_round_off = !is_iterations;
      plot.noise = noise_of(results, methods, chosen);

      double least = std::numeric_limits<double>::max(), most = 0;
      for (const Point &point : points)
        if (point.is_drawn())
        {
          least = std::min(least, point.y);
          most = std::max(most, point.y);
          if (plot.is_x_log && !kind.is_cost())
            plot.x_ticks.push_back(point.x);
        }
      plot.is_y_log = !is_iterations || most > wide * least;
      if (kind.is_cost() && results.variable.empty()) // else points are of several problems
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
    }

    /// @param name   empty: there is nothing to draw
    /// @param cases  of one problem
    DataChart chart_of(const StudyResults &results, const Kind &kind, const std::string &name,
                       const std::string &title, const std::vector<Case> &cases)
    {
      const std::vector<MethodName> names = methods(results);
      const std::vector<Point> points = points_of(results, names, cases, kind);
      if (std::none_of(points.begin(), points.end(), [](const Point &p) { return p.is_drawn(); }))
        return {};
      DataChart chart = named(name, title);
      draw(results, names, cases, kind, points, chart.plot);
      chart.data.columns = {"method",           "problem",
                            "series",           "level",
                            chart.plot.x_label, kind.is_of_iterations ? "iterations" : "error"};
      for (const Point &point : points)
        chart.data.rows.push_back({text_cell(point.method->name), text_cell(point.one->problem),
                                   text_cell(point.one->series), count_cell(point.run->key.level),
                                   number_cell(point.x), number_cell(point.y)});
      return chart;
    }

    /// Of each case one, those of the telling problem first.
    std::vector<DataChart> charts_of(const StudyResults &results, const Kind &kind)
    {
      const std::string problem = telling_problem(results);
      std::vector<Case> all = cases(results);
      std::stable_partition(all.begin(), all.end(),
                            [&](const Case &one) { return one.problem == problem; });
      std::vector<DataChart> charts;
      for (const Case &one : all)
        if (DataChart chart = chart_of(results, kind, kind.name + "_" + one.slug,
                                       one.title() + ": " + kind.title, {one});
            !chart.name.empty())
          charts.push_back(std::move(chart));
      return charts;
    }

    /// Work and precision of the telling problem, of each method the points that no other series
    /// beats, and of each case unless that is the same.
    std::vector<DataChart> work_charts(const StudyResults &results)
    {
      constexpr std::size_t most_names = 4;
      const std::string problem = telling_problem(results);
      std::vector<Case> of_problem;
      std::string series;
      for (const Case &one : cases(results))
        if (one.problem == problem)
        {
          series += (of_problem.empty() ? "" : ", ") + one.series;
          of_problem.push_back(one);
        }
      const std::size_t n = of_problem.size();
      if (n > most_names)
        series = std::to_string(n) + " series";
      std::vector<DataChart> charts = charts_of(results, work);
      DataChart overall =
          chart_of(results, work, work.name,
                   problem + ": " + work.title +
                       (n > 1 ? " (of each method the best of " + series + ")" : ""),
                   of_problem);
      if (overall.name.empty())
        return charts;
      if (n == 1)
        charts.erase(charts.begin());
      charts.insert(charts.begin(), std::move(overall));
      return charts;
    }

    /// What is in no method's work: meshes, and cells of nodes, of the dearest level.
    std::string geometry_words(const StudyResults &results)
    {
      double of_mesh = 0, of_nodes = 0;
      for (const Record &run : results.records)
      {
        double &most = run.key.family == study::MethodFamily::meshfree ? of_nodes : of_mesh;
        most = std::max(most, study::geometry_seconds(run));
      }
      std::string text;
      if (of_mesh > 0)
        text = "the mesh of Galerkin methods, up to " + rounded_seconds(of_mesh) + " a level";
      if (of_nodes > 0)
        text += (text.empty() ? "" : "; ") +
                ("mesh and cells of meshfree nodes, up to " + rounded_seconds(of_nodes)) +
                " a level";
      return text.empty() ? "" : " Not in it, since methods share it: " + text + " of CPU time.";
    }

    /// "" for xy: the only maps of a problem in the plane or on a line.
    std::string ending(const study::ErrorMap &map)
    {
      return map.axes == study::ErrorMap().axes ? "" : "-" + map.axes;
    }

    /// @param groups  see maps_by_axes()
    std::vector<Picture> solution_pictures(const StudyResults &results,
                                           const std::vector<std::vector<study::ErrorMap>> &groups)
    {
      const std::vector<MethodName> names = methods(results);
      std::vector<Picture> pictures;
      for (const auto &maps : groups)
        if (const study::ErrorMap *map = solution_map(maps, names))
        {
          const std::string name = "solution" + ending(*map);
          pictures.push_back({name, solution_title(*map),
                              solution_script(*map, name + ".svg", names), "",
                              solution_table(*map)});
        }
      if (const auto &grids = results.solution_grids; !grids.empty())
      {
        const auto is_reference = [&](const study::SolutionGrid &one)
        {
          return std::any_of(names.begin(), names.end(),
                             [&](const MethodName &method)
                             { return method.name == one.method && method.is_reference(); });
        };
        const auto found = std::find_if(grids.begin(), grids.end(), is_reference);
        const study::SolutionGrid &shown = found == grids.end() ? grids.front() : *found;
        if (const std::string script = surfaces_script(shown, "surfaces.svg"); !script.empty())
          pictures.push_back({"surfaces", surfaces_title(shown), script, "", grid_table(shown)});
      }
      return pictures;
    }

    /// The solution, and where each method errs.
    std::vector<Gallery> map_galleries(const StudyResults &results)
    {
      if (results.maps.empty())
        return {};
      const bool is_line = is_curve(results.maps.front());
      const auto groups = maps_by_axes(results.maps);
      const bool is_in_space = groups.size() > 1;
      std::vector<Gallery> galleries;
      if (std::vector<Picture> pictures = solution_pictures(results, groups); !pictures.empty())
        galleries.push_back(
            {"solution",
             "The solution",
             std::string("Mean of u (of |u| for vectors) in each block of cells at "
                         "the finest level") +
                 (is_line ? "." : ". White: outside the domain.") +
                 (is_in_space ? " Shown in three layers of cells through the middle of the body "
                                "and as isosurfaces of u."
                              : ""),
             {},
             std::move(pictures)});
      Gallery errors{"maps",
                     "Where the error sits",
                     is_line
                         ? "The largest error of the cell averages in each block of cells at the "
                           "finest level. At the nodes a method may be more or less accurate."
                         : "The largest error in each block of cells at the finest level. One "
                           "colour scale for all methods; dark is accurate, white lies outside "
                           "the domain.",
                     {}};
      for (const auto &maps : groups)
      {
        const std::string name = "error-maps" + ending(maps.front());
        errors.pictures.push_back({name, map_title(maps),
                                   map_script(maps, name + ".svg", methods(results)), "",
                                   map_table(maps)});
      }
      galleries.push_back(std::move(errors));
      return galleries;
    }
  } // namespace

  std::vector<Gallery> statics_galleries(const StudyResults &results)
  {
    constexpr std::size_t at_a_glance = 6;
    const std::string errors =
        results.variable.empty() ? "Convergence" : "Errors over " + results.variable;
    const Kind convergence = {
        "convergence", results.variable.empty() ? "convergence" : "error over " + results.variable,
        "", nullptr};
    std::vector<Gallery> galleries = {
        {"work", "Work and precision",
         "Work is setup (weights or entries, and geometry as far as they need it) and solve. "
         "Lower left is better: a smaller error for less work. Each point is a level of the sweep; "
         "where several series share a chart, a line ends where more work gains nothing; the grey "
         "band joins the points that no other point beats in both work and error, excluding "
         "methods that stall. Solid lines with filled symbols are meshfree rules, dashed lines "
         "with open symbols are Galerkin methods. If some errors are below the estimated round-off "
         "of every method and others are larger, the former are drawn in a grey strip: one row per "
         "method, not to scale." +
             geometry_words(results),
         work_charts(results)},
        {"convergence", errors,
         results.variable.empty()
             ? "A method that converges follows a slope triangle; one that stalls turns level; one "
               "that is exact to rounding runs in the grey strip."
             : "",
         charts_of(results, convergence)}};
    galleries[0].rest = "Work and precision by problem and series";
    galleries[1].rest = errors + " by problem and series";
    for (Gallery &one : map_galleries(results))
      galleries.push_back(std::move(one));
    const std::size_t n_minor = galleries.size();
    for (const auto &[kind, rest, words] :
         {std::tuple(&memory, "Memory", "Error against the largest memory in use."),
          {&pairs, "Unknowns × bonds",
           "Error against the pairs of unknowns that one application of the operator sums over: a "
           "cost that no machine or program changes."},
          {&iterations, "Iterations", "Iterations of the linear solver as the mesh is refined."}})
      galleries.push_back({kind->name,
                           "",
                           "",
                           charts_of(results, *kind),
                           {},
                           words,
                           0,
                           std::string(rest) + " by problem and series"});
    std::size_t n = 0;
    for (const Gallery &one : galleries)
      n += one.charts.size() + one.pictures.size();
    for (std::size_t i = 0; i < n_minor; ++i) // the first one tells most
      galleries[i].n_large = n > at_a_glance ? 1 : galleries[i].charts.size();
    return galleries;
  }
} // namespace plumbline::report
