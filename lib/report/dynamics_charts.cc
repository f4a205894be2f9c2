#include "report/dynamics_charts.h"

#include "report/dynamics_tables.h"

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  using study::DynamicResults;
  using study::MotionRun;
  using study::MotionTrend;

  namespace
  {
    /// Lines by label, each with a style of its own.
    class Lines
    {
    public:
      Line &of(const std::string &label, bool is_reference)
      {
        for (Line &line : lines_)
          if (line.label == label)
            return line;
        unsigned int &n = is_reference ? n_reference_ : n_meshfree_;
        lines_.push_back({label, style_of(n++, is_reference), 1.8, {}, 1});
        return lines_.back();
      }
      std::vector<Line> take() { return std::move(lines_); }

    private:
      std::vector<Line> lines_;
      unsigned int n_reference_ = 0, n_meshfree_ = 0;
    };

    bool has_several(const std::vector<MotionRun> &runs, std::string MotionRun::*member)
    {
      return std::any_of(runs.begin(), runs.end(),
                         [&](const MotionRun &run) { return run.*member != runs[0].*member; });
    }

    /// Method, and what else tells motions apart.
    std::string label(const DynamicResults &results, const std::string &method,
                      const std::string &problem, const std::string &series,
                      const std::string &scheme)
    {
      std::string text = method;
      if (has_several(results.runs, &MotionRun::scheme))
        text += ", " + scheme;
      if (has_several(results.runs, &MotionRun::series))
        text += ", " + series;
      if (has_several(results.runs, &MotionRun::problem))
        text += ", " + problem;
      return text;
    }

    std::string label(const DynamicResults &results, const MotionRun &run)
    {
      return label(results, run.method, run.problem, run.series, run.scheme);
    }

    std::string error_words(const DynamicResults &results)
    {
      return "error at the end, " + results.decisive_error;
    }

    DataChart trends_chart(const DynamicResults &results, const std::vector<MotionTrend> &trends,
                           const std::string &error, DataChart chart)
    {
      chart.data.columns = {"method", "case", "series", "scheme", "x", "error"};
      chart.plot.shows_round_off = true;
      double size = 0;
      for (const MotionTrend &t : trends)
        size = std::max(size, t.error == error ? t.size : 0);
      chart.plot.noise = round_off * (size > 0 ? size : 1);
      Lines lines;
      for (const MotionTrend &t : trends)
      {
        if (t.error != error)
          continue;
        Line &line = lines.of(label(results, t.method, t.problem, t.series, t.scheme),
                              t.family != study::MethodFamily::meshfree);
        for (std::size_t i = 0; i < t.x.size(); ++i)
        {
          chart.data.rows.push_back({text_cell(t.method), text_cell(t.problem), text_cell(t.series),
                                     text_cell(t.scheme), number_cell(t.x[i]),
                                     error_cell(t.values[i])});
          if (t.values[i] > 0)
            line.points.push_back({t.x[i], t.values[i]});
        }
      }
      std::vector<double> x;
      for (const MotionTrend &t : trends)
        if (t.error == error && t.axis == study::Axis::variable)
          x.insert(x.end(), t.x.begin(), t.x.end());
      chart.plot.is_x_log = is_logarithmic(study::Axis::variable, x);
      chart.plot.has_slopes = chart.plot.is_x_log;
      chart.plot.lines = lines.take();
      return chart;
    }

    DataChart cost_chart(const DynamicResults &results)
    {
      DataChart chart = named("cost", "What accuracy costs",
                              "All runs, over h and time step: each line is one method, scheme "
                              "and step over h; grey: the best pairs of h and step.");
      chart.plot.x_label = "CPU seconds, preparation and steps";
      chart.plot.y_label = error_words(results);
      chart.plot.frontier_label = "best pairs";
      chart.data.columns = {"method", "case", "series", "scheme", "h", "dt", "seconds", "error"};
      Lines lines;
      for (const MotionRun &run : results.runs)
        if (const double error = decisive_error(results, run);
            error > 0 && run.cost.seconds() > 0 && run.failure.empty())
        {
          const std::string name =
              label(results, run) +
              (has_several(results.runs, &MotionRun::steps) ? ", " + run.steps : "");
          lines.of(name, run.family != study::MethodFamily::meshfree)
              .points.push_back({run.cost.seconds(), error});
          chart.data.rows.push_back({text_cell(run.method), text_cell(run.problem),
                                     text_cell(run.series), text_cell(run.scheme),
                                     number_cell(run.h), number_cell(run.step),
                                     number_cell(run.cost.seconds()), error_cell(error)});
        }
      for (const MotionRun *run : best_runs(results))
        chart.plot.frontier.push_back({run->cost.seconds(), decisive_error(results, *run)});
      chart.plot.lines = lines.take();
      return chart;
    }

    /// The runs that moved, at the finest level of each series, with the shortest step of each
    /// scheme.
    std::vector<const MotionRun *> finest(const DynamicResults &results, bool all_steps)
    {
      std::vector<const MotionRun *> runs;
      for (const MotionRun &run : results.runs)
      {
        if (run.energies.empty())
          continue;
        const auto same =
            std::find_if(runs.begin(), runs.end(),
                         [&](const MotionRun *other)
                         {
                           return other->method == run.method && other->series == run.series &&
                                  other->problem == run.problem && other->scheme == run.scheme &&
                                  (!all_steps || other->steps == run.steps);
                         });
        if (same == runs.end())
          runs.push_back(&run);
        else
          *same = &run; // coarse to fine, long to short
      }
      return runs;
    }

    /// What grows beyond has blown up, as is seen by then.
    constexpr double largest_shown = 1e20;

    /// A curve over time with a symbol here and there.
    void spread_symbols(std::vector<Line> &lines)
    {
      for (Line &line : lines)
        line.symbol_interval =
            std::max<unsigned int>(1, static_cast<unsigned int>(line.points.size()) / 8);
    }

    DataChart energies_chart(const MotionRun &run)
    {
      constexpr double wild = 1e3; // growth beyond which a linear axis shows one spike
      const double most = largest_shown * std::max(run.energies.front().stored(), 1.);
      DataChart chart = named(
          "energies", "Energies: " + run.method + ", " + run.scheme + ", h = " + rounded(run.h),
          "Of one run, " + run.steps + "; the others are in dynamics.json.");
      chart.plot.is_x_log = false;
      chart.plot.x_label = "time";
      chart.plot.y_label = "energy";
      chart.data.columns = {"t", "kinetic", "bond", "stored", "work", "dissipated"};
      double low = 0, high = 0;
      for (const analysis::Energies &now : run.energies)
      {
        for (const double e : {now.kinetic, now.bond, now.stored(), now.work, now.dissipated})
          if (std::abs(e) < most)
          {
            low = std::min(low, e);
            high = std::max(high, e);
          }
        chart.data.rows.push_back({number_cell(now.t), number_cell(now.kinetic),
                                   number_cell(now.bond), number_cell(now.stored()),
                                   number_cell(now.work), number_cell(now.dissipated)});
      }
      const double begin = std::max(run.energies.front().stored(), 1e-300);
      chart.plot.is_y_log = high > wild * begin && run.energies.front().stored() > 0;
      const double margin = high > low ? .06 * (high - low) : 1;
      chart.plot.y_range = Range{low - (low < 0 ? margin : 0), high + margin};
      Lines lines;
      const auto add = [&](const std::string &name, const auto &value)
      {
        Line &line = lines.of(name, false);
        for (const analysis::Energies &now : run.energies)
          if (const double e = value(now);
              std::abs(e) < most && (!chart.plot.is_y_log || e > 1e-12 * begin))
            line.points.push_back({now.t, e});
      };
      using E = analysis::Energies;
      add("stored", [](const E &e) { return e.stored(); });
      add("kinetic", [](const E &e) { return e.kinetic; });
      add("bonds", [](const E &e) { return e.bond; });
      const auto any = [&](double E::*member)
      {
        return std::any_of(run.energies.begin(), run.energies.end(),
                           [&](const E &e) { return std::abs(e.*member) > 1e-14 * high; });
      };
      if (any(&E::work))
        add("work of loads", [](const E &e) { return e.work; });
      if (any(&E::dissipated))
        add("dissipated", [](const E &e) { return e.dissipated; });
      chart.plot.lines = lines.take();
      spread_symbols(chart.plot.lines);
      return chart;
    }

    /// Over time on a logarithmic axis, of all runs at the finest level.
    template <typename Value>
    DataChart history_chart(const DynamicResults &results, DataChart chart, bool all_steps,
                            const Value &value)
    {
      constexpr double floor = 1e-16; // of the largest: below it a logarithm says nothing
      chart.plot.is_x_log = false;
      chart.plot.x_label = "time";
      chart.data.columns = {"method", "series", "scheme", "step", "t", "value"};
      Lines lines;
      for (const MotionRun *run : finest(results, all_steps))
        for (std::size_t i = 0; i < run->energies.size(); ++i)
        {
          const double t = run->energies[i].t, y = value(*run, i);
          if (!(std::abs(y) < largest_shown)) // it has blown up, which is seen by then
            continue;
          chart.data.rows.push_back({text_cell(run->method), text_cell(run->series),
                                     text_cell(run->scheme), text_cell(run->steps), number_cell(t),
                                     error_cell(y)});
          const bool has_steps = all_steps && has_several(results.runs, &MotionRun::steps);
          if (y > floor)
            lines
                .of(label(results, *run) + (has_steps ? ", " + run->steps : ""),
                    run->family != study::MethodFamily::meshfree)
                .points.push_back({t, y});
        }
      chart.plot.lines = lines.take();
      spread_symbols(chart.plot.lines);
      return chart;
    }

    double imbalance(const MotionRun &run, std::size_t i)
    {
      const analysis::Energies &first = run.energies.front(), &now = run.energies[i];
      double size = 0;
      for (const analysis::Energies &e : run.energies)
        if (std::isfinite(e.stored()))
          size = std::max({size, e.stored(), std::abs(e.work), e.dissipated});
      return std::abs(now.stored() + now.dissipated - now.work - first.stored()) / size;
    }

    bool has_points(const DataChart &chart, std::size_t least)
    {
      std::size_t most = 0;
      for (const Line &line : chart.plot.lines)
        most = std::max(most, line.points.size());
      return most >= least;
    }
  } // namespace

  std::vector<DataChart> motion_charts(const DynamicResults &results)
  {
    std::vector<DataChart> charts;
    const auto add = [&](const DataChart &chart, std::size_t least)
    {
      if (has_points(chart, least))
        charts.push_back(chart);
    };
    if (results.runs.empty())
      return charts;
    DataChart errors = named("errors", "Errors of displacements at the end",
                             "With the shortest step of each scheme."),
              orders = named("orders", "Errors in time at the finest level",
                             "Against the same lattice's motion exact in time."),
              balance = named("balance", "Balance of energy",
                              "What stored and dissipated less supplied energy differ from the "
                              "start by, over the largest of them, at the finest level with the "
                              "shortest step."),
              stored = named("stored", "Stored energy over that at the start",
                             "At the finest level, with all steps."),
              history = named("history", "Errors over time",
                              "Of displacements at the finest level with the shortest step.");
    const study::Axis axis =
        results.trends.empty() ? study::Axis::mesh_size : results.trends.front().axis;
    errors.plot.x_label = study::label(axis, results.variable);
    errors.plot.y_label = error_words(results);
    orders.plot.x_label = "time step";
    orders.plot.y_label = "error in time, nodal L2";
    balance.plot.y_label = "imbalance over the largest energy";
    stored.plot.y_label = "stored energy over that at the start";
    history.plot.y_label = results.decisive_error;
    add(trends_chart(results, results.trends, results.decisive_error, errors), 2);
    add(cost_chart(results), 2);
    add(trends_chart(results, results.orders, "nodal L2 | time", orders), 2);
    const auto shown = finest(results, false);
    const auto stable = std::find_if(shown.begin(), shown.end(),
                                     [](const MotionRun *run)
                                     { return !analysis::scheme(run->scheme).is_explicit_euler; });
    if (!shown.empty())
      add(energies_chart(stable == shown.end() ? *shown.front() : **stable), 2);
    if (results.shows_blow_up)
      add(history_chart(results, stored, true,
                        [](const MotionRun &run, std::size_t i)
                        { return run.energies[i].stored() / run.energies.front().stored(); }),
          2);
    add(history_chart(results, balance, false, imbalance), 2);
    add(history_chart(results, history, false,
                      [](const MotionRun &run, std::size_t i)
                      { return i < run.history.size() ? run.history[i] : 0; }),
        2);
    return charts;
  }
} // namespace plumbline::report
