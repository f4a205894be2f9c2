#include "report/dynamics_view.h"
#include "report/selection.h"

#include "study/transient.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace plumbline::report
{
  using study::Trend;

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

    template <class Name>
    bool has_several(const StudyResults &results, const Name &name)
    {
      return std::any_of(results.records.begin(), results.records.end(),
                         [&](const Record &record)
                         { return name(record) != name(results.records.front()); });
    }

    std::string step(const Record &record)
    {
      return record.text("step");
    }

    std::string scheme(const Record &record)
    {
      return record.text("scheme");
    }

    /// Method, and what else tells runs apart.
    /// @param key  of a record, or a trend
    template <class Key>
    std::string label(const StudyResults &results, const Key &key, const std::string &scheme_name)
    {
      std::string text = key.method;
      if (has_several(results, scheme))
        text += ", " + scheme_name;
      if (has_several(results, [](const Record &record) { return record.key.series; }))
        text += ", " + key.series;
      if (has_several(results, [](const Record &record) { return record.key.problem; }))
        text += ", " + key.problem;
      return text;
    }

    std::string label(const StudyResults &results, const Record &record)
    {
      return label(results, record.key, scheme(record));
    }

    std::string decisive(const StudyResults &results)
    {
      return results.decisive_error;
    }

    const char *const in_unit_of_u = " [unit of the solution]";

    std::string error_label(const StudyResults &results)
    {
      return "error at the final time, " + decisive(results) + in_unit_of_u;
    }

    DataChart trends_chart(const StudyResults &results, const std::string &error, DataChart chart)
    {
      chart.data.columns = {"method", "case", "series", "scheme", "x", "error"};
      chart.plot.shows_round_off = true;
      double size = 0;
      for (const Trend &t : results.trends)
        size = std::max(size, t.error == error ? t.size : 0);
      chart.plot.noise = round_off * (size > 0 ? size : 1);
      Lines lines;
      for (const Trend &t : results.trends)
      {
        if (t.error != error)
          continue;
        Line &line =
            lines.of(label(results, t, t.variant), t.family != study::MethodFamily::meshfree);
        for (std::size_t i = 0; i < t.x.size(); ++i)
        {
          chart.data.rows.push_back({text_cell(t.method), text_cell(t.problem), text_cell(t.series),
                                     text_cell(t.variant), number_cell(t.x[i]),
                                     error_cell(t.values[i])});
          if (t.values[i] > 0)
            line.points.push_back({t.x[i], t.values[i]});
        }
      }
      std::vector<double> x;
      for (const Trend &t : results.trends)
        if (t.error == error && t.axis == study::Axis::variable)
          x.insert(x.end(), t.x.begin(), t.x.end());
      chart.plot.is_x_log = is_logarithmic(study::Axis::variable, x);
      chart.plot.has_slopes = chart.plot.is_x_log;
      chart.plot.lines = lines.take();
      return chart;
    }

    DataChart cost_chart(const StudyResults &results)
    {
      DataChart chart = named("cost", "What accuracy costs",
                              "All runs, over h and time step: each line is one method, scheme "
                              "and step over h; grey: the best pairs of h and step.");
      chart.plot.x_label = "work: preparation and steps [CPU s]";
      chart.plot.y_label = error_label(results);
      chart.plot.frontier_label = "best pairs";
      chart.data.columns = {"method", "case", "series", "scheme", "h", "dt", "seconds", "error"};
      Lines lines;
      for (const Record &run : results.records)
        if (const double error = decisive_error(results, run); error > 0 && run.cost.seconds() > 0)
        {
          const std::string name =
              label(results, run) + (has_several(results, step) ? ", " + step(run) : "");
          lines.of(name, run.key.family != study::MethodFamily::meshfree)
              .points.push_back({run.cost.seconds(), error});
          chart.data.rows.push_back({text_cell(run.key.method), text_cell(run.key.problem),
                                     text_cell(run.key.series), text_cell(scheme(run)),
                                     number_cell(run.key.h), number_cell(run["time step"]),
                                     number_cell(run.cost.seconds()), error_cell(error)});
        }
      for (const Record *run : best_records(results))
        chart.plot.frontier.push_back({run->cost.seconds(), decisive_error(results, *run)});
      chart.plot.lines = lines.take();
      return chart;
    }

    /// The runs that moved, at the finest level of each series, with the shortest step of each
    /// scheme.
    std::vector<const Record *> finest(const StudyResults &results, bool all_steps)
    {
      std::vector<const Record *> runs;
      for (const Record &run : results.records)
      {
        if (run.curves.count("energy") == 0)
          continue;
        const auto same = std::find_if(runs.begin(), runs.end(),
                                       [&](const Record *other)
                                       {
                                         return other->key.method == run.key.method &&
                                                other->key.series == run.key.series &&
                                                other->key.problem == run.key.problem &&
                                                scheme(*other) == scheme(run) &&
                                                (!all_steps || step(*other) == step(run));
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

    /// Of a body of thickness 1 in two dimensions, of cross-section 1 in one.
    std::string energy_label(const study::StudyResults &results)
    {
      static const std::map<std::string, std::string> units = {{"1", "force/length"},
                                                               {"3", "force length"}};
      const auto dimension = results.facts.find("dimension");
      const auto unit =
          dimension == results.facts.end() ? units.end() : units.find(dimension->second);
      return "energy [" + (unit == units.end() ? "force" : unit->second) + "]";
    }

    DataChart energies_chart(const Record &run, const std::string &y_label)
    {
      using E = analysis::Energies;
      const std::vector<E> energies = study::energies_of(run);
      constexpr double wild = 1e3; // growth beyond which a linear axis shows one spike
      const double most = largest_shown * std::max(energies.front().stored(), 1.);
      DataChart chart =
          named("energies",
                "Energies: " + run.key.method + ", " + scheme(run) + ", h = " + rounded(run.key.h),
                "Of one run, " + step(run) + "; the others are in dynamics.json.");
      chart.plot.is_x_log = false;
      chart.plot.x_label = "t [time]";
      chart.plot.y_label = y_label;
      chart.data.columns = {"t", "kinetic", "bond", "stored", "work", "dissipated"};
      double low = 0, high = 0;
      for (const E &now : energies)
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
      const double begin = std::max(energies.front().stored(), 1e-300);
      chart.plot.is_y_log = high > wild * begin && energies.front().stored() > 0;
      const double margin = high > low ? .06 * (high - low) : 1;
      chart.plot.y_range = Range{low - (low < 0 ? margin : 0), high + margin};
      Lines lines;
      const auto add = [&](const std::string &name, const auto &value)
      {
        Line &line = lines.of(name, false);
        for (const E &now : energies)
          if (const double e = value(now);
              std::abs(e) < most && (!chart.plot.is_y_log || e > 1e-12 * begin))
            line.points.push_back({now.t, e});
      };
      add("stored", [](const E &e) { return e.stored(); });
      add("kinetic", [](const E &e) { return e.kinetic; });
      add("bonds", [](const E &e) { return e.bond; });
      const auto any = [&](double E::*member)
      {
        return std::any_of(energies.begin(), energies.end(),
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
    /// @param values  of a run: points of the chart
    template <typename Values>
    DataChart history_chart(const StudyResults &results, DataChart chart, bool all_steps,
                            const Values &values)
    {
      constexpr double floor = 1e-16; // of the largest: below it a logarithm says nothing
      chart.plot.is_x_log = false;
      chart.plot.x_label = "t [time]";
      chart.data.columns = {"method", "series", "scheme", "step", "t", "value"};
      Lines lines;
      for (const Record *run : finest(results, all_steps))
        for (const Vertex &point : values(*run))
        {
          if (!(std::abs(point.y) < largest_shown)) // it has blown up, which is seen by then
            continue;
          chart.data.rows.push_back({text_cell(run->key.method), text_cell(run->key.series),
                                     text_cell(scheme(*run)), text_cell(step(*run)),
                                     number_cell(point.x), error_cell(point.y)});
          if (point.y > floor)
            lines
                .of(label(results, *run) +
                        (all_steps && has_several(results, step) ? ", " + step(*run) : ""),
                    run->key.family != study::MethodFamily::meshfree)
                .points.push_back(point);
        }
      chart.plot.lines = lines.take();
      spread_symbols(chart.plot.lines);
      return chart;
    }

    std::vector<Vertex> imbalances(const Record &run)
    {
      const std::vector<analysis::Energies> energies = study::energies_of(run);
      double size = 0;
      for (const analysis::Energies &e : energies)
        if (std::isfinite(e.stored()))
          size = std::max({size, e.stored(), std::abs(e.work), e.dissipated});
      std::vector<Vertex> points;
      for (const analysis::Energies &now : energies)
        points.push_back(
            {now.t, std::abs(now.stored() + now.dissipated - now.work - energies.front().stored()) /
                        size});
      return points;
    }

    std::vector<Vertex> growth(const Record &run)
    {
      const std::vector<analysis::Energies> energies = study::energies_of(run);
      std::vector<Vertex> points;
      for (const analysis::Energies &now : energies)
        points.push_back({now.t, std::abs(now.stored() / energies.front().stored() - 1)});
      return points;
    }

    std::vector<Vertex> errors_over_time(const Record &run)
    {
      std::vector<Vertex> points;
      if (const auto found = run.curves.find("error"); found != run.curves.end())
        for (std::size_t i = 0; i < found->second[0].values.size(); ++i)
          points.push_back({found->second[0].values[i], found->second[1].values[i]});
      return points;
    }

    bool has_points(const DataChart &chart, std::size_t least)
    {
      std::size_t most = 0;
      for (const Line &line : chart.plot.lines)
        most = std::max(most, line.points.size());
      return most >= least;
    }
  } // namespace

  std::vector<DataChart> dynamics_charts(const StudyResults &results)
  {
    std::vector<DataChart> charts;
    const auto add = [&](const DataChart &chart, std::size_t least)
    {
      if (has_points(chart, least))
        charts.push_back(chart);
    };
    if (results.records.empty())
      return charts;
    DataChart errors = named("errors", "Errors of displacements at the end",
                             "With the shortest step of each scheme."),
              orders = named("orders", "Errors in time at the finest level",
                             "Against the solution of the same equations that is exact in time."),
              balance = named("balance", "Balance of energy",
                              "What stored and dissipated less supplied energy differ from the "
                              "start by, over the largest of them, at the finest level with the "
                              "shortest step."),
              stored = named("stored", "Change of the stored energy",
                             "|E(t)/E(0) - 1| at the finest level, with all steps; values "
                             "below 1e-16 are not drawn."),
              history = named("history", "Errors versus time",
                              "Of displacements at the finest level with the shortest step.");
    const study::Axis axis =
        results.trends.empty() ? study::Axis::mesh_size : results.trends.front().axis;
    errors.plot.x_label = study::label(axis, results.variable);
    errors.plot.y_label = error_label(results);
    orders.plot.x_label = study::label(study::Axis::time_step, "");
    orders.plot.y_label = std::string("error in time, nodal L2") + in_unit_of_u;
    balance.plot.y_label = "imbalance over the largest energy";
    stored.plot.y_label = "change of the stored energy, relative to its initial value";
    history.plot.y_label = "error, " + decisive(results) + in_unit_of_u;
    add(trends_chart(results, decisive(results), errors), 2);
    add(cost_chart(results), 2);
    add(trends_chart(results, study::time_error, orders), 2);
    const auto shown = finest(results, false);
    const auto stable = std::find_if(shown.begin(), shown.end(),
                                     [](const Record *run)
                                     { return !analysis::scheme(scheme(*run)).is_explicit_euler; });
    if (!shown.empty())
      add(energies_chart(stable == shown.end() ? *shown.front() : **stable, energy_label(results)),
          2);
    if (results.facts.count("blow-up") > 0)
      add(history_chart(results, stored, true, growth), 2);
    add(history_chart(results, balance, false, imbalances), 2);
    add(history_chart(results, history, false, errors_over_time), 2);
    return charts;
  }
} // namespace plumbline::report
