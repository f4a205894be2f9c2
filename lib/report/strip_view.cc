#include "report/text_table.h"
#include "report/view.h"
#include "study/stationary_crack.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    constexpr const char *meaning_of_field =
        "G is the energy release rate for an advance by one column, over K²/E', that of the local "
        "solid whose field is prescribed along the edges (Irwin 1957): it tends to 1 as the "
        "horizon "
        "vanishes, and at one horizon to the same number for all methods. The opening is u_y above "
        "less that below, of the last cells behind the tip, of rules at the last nodes. Continuous "
        "functions close there.";

    constexpr const char *meaning_of_grips =
        "W1 is the energy of the intact strip per length, and the energy release rate G equals it "
        "whatever the horizon (Rice 1968): G = W1 holds by translation, by any quadrature, and "
        "reveals errors of bookkeeping and strips that are too short. What depends on the tip is "
        "its "
        "energy, what it adds to an intact strip from there on, and the opening there: u_y above "
        "less that below, of the last cells behind it, of rules at the last nodes. Continuous "
        "functions close there. Growth is that of a crack by rules, bond by bond, over the "
        "toughness "
        "of the law: the largest energy release rate before it goes on (peak: lattice trapping) "
        "and "
        "the mean of all events, the energy that it releases, and what its bonds held at their "
        "limits.";

    bool is_between_grips(const StudyResults &results)
    {
      const auto edges = results.facts.find("edges");
      return edges == results.facts.end() || edges->second == base::word(scene::StripEdges::grips);
    }

    std::string label_of(const std::string &method, const std::string &series)
    {
      return method + (series.empty() ? "" : ", " + series);
    }

    /// By the labels of their lines.
    std::vector<MethodName> lines_of(const StudyResults &results)
    {
      std::vector<MethodName> lines;
      for (const Record &record : results.records)
        if (const std::string label = label_of(record.key.method, record.key.series);
            std::none_of(lines.begin(), lines.end(),
                         [&](const MethodName &one) { return one.name == label; }))
          lines.push_back({label, record.key.family});
      return lines;
    }

    Part strips(const StudyResults &results)
    {
      std::vector<RecordColumn> columns = {
          {"series", [](const Record &record) { return text_cell(record.key.series); }}};
      for (const auto &[head, scalar] :
           std::vector<std::pair<std::string, std::string>>{{"W1 [mu length]", "W1"},
                                                            {"tip energy", "tip energy"},
                                                            {"opening", "opening"},
                                                            {"G/W1 - 1", "G/W1 - 1"},
                                                            {"G E'/K^2", "G"},
                                                            {"growth peak", "growth peak"},
                                                            {"mean", "growth mean"},
                                                            {"released", "growth released"},
                                                            {"bonds", "growth bonds"}})
        columns.push_back(number_column(head, scalar));
      columns.push_back(count_column("unknowns", "unknowns"));
      columns.push_back(
          {"CPU s", [](const Record &record) { return number_cell(record.cost.seconds()); }});
      return {"strips", "Numbers", is_between_grips(results) ? meaning_of_grips : meaning_of_field,
              table_of(results, with_place(results, columns),
                       [](const Record &record) { return record.failure.empty(); })};
    }

    Part limits(const StudyResults &results)
    {
      Table table;
      table.columns = {"quantity", "method", "series", "limit", "rate", "change"};
      std::vector<std::string> quantities;
      for (const study::Limit &one : results.limits)
        if (std::find(quantities.begin(), quantities.end(), one.quantity) == quantities.end())
          quantities.push_back(one.quantity);
      for (const std::string &quantity : quantities)
        for (const study::Limit &one : results.limits)
          if (one.quantity == quantity)
            table.rows.push_back({text_cell(one.quantity), text_cell(one.method),
                                  text_cell(one.series), number_cell(one.value),
                                  number_cell(one.rate),
                                  known(std::isfinite(one.change), number_cell(one.change))});
      return {"limits", "Limits as h tends to 0",
              "limit and rate: of limit + C h^rate through the three finest levels. change: of the "
              "limit, were the finest level left out.",
              without_empty_columns(table)};
    }

    std::string answer(const StudyResults &results)
    {
      std::string text;
      for (const study::Agreement &one : study::find_agreements(results.limits))
        text += (text.empty() ? "" : " ") + one.quantity + " (" + one.series + ") of " +
                std::to_string(one.n_methods) + " methods: limits between " + rounded(one.least) +
                " and " + rounded(one.largest) + ", " +
                rounded((one.largest - one.least) / std::abs(one.largest)) + " apart.";
      return !text.empty()
                 ? text
                 : "Limits need three levels of h at one horizon, or at one ratio of both; whether "
                   "methods agree needs four, and two methods whose limits change by less than a "
                   "twentieth with the finest.";
    }

    /// Of energy release rates relative to the material's it is 1.
    std::string unit_of(const StudyResults &results, const std::string &quantity)
    {
      for (const Record &record : results.records)
        if (const auto found = record.scalars.find(quantity);
            found != record.scalars.end() && !found->second.unit.empty())
          return found->second.unit;
      return "1";
    }

    DataChart quantity_chart(const StudyResults &results, const std::string &quantity)
    {
      const bool is_over_horizon = // h stays
          std::all_of(results.records.begin(), results.records.end(),
                      [&](const Record &record)
                      { return record.key.h == results.records.front().key.h; });
      DataChart chart = is_over_horizon
                            ? named(slug(quantity), quantity + " versus the horizon")
                            : named(slug(quantity), quantity + " versus h, and limits at 0",
                                    "At h = 0: limits by the three finest levels.");
      chart.plot.x_label = is_over_horizon ? "horizon δ [length]" : "mesh size h [length]";
      chart.plot.y_label = quantity + " [" + unit_of(results, quantity) + "]";
      chart.plot.is_x_log = chart.plot.is_y_log = false;
      chart.data.columns = {"method", "series", is_over_horizon ? "horizon" : "h", quantity};
      const auto names = lines_of(results);
      double least = std::numeric_limits<double>::infinity(), largest = -least;
      const auto add =
          [&](const std::string &method, const std::string &series, double h, double value)
      {
        const std::string label = label_of(method, series);
        auto &lines = chart.plot.lines;
        auto line = std::find_if(lines.begin(), lines.end(),
                                 [&](const Line &one) { return one.label == label; });
        if (line == lines.end())
          line = lines.insert(line, {label, style_of(names, label), 1.8, {}});
        line->points.push_back({h, value});
        least = std::min(least, value);
        largest = std::max(largest, value);
        chart.data.rows.push_back(
            {text_cell(method), text_cell(series), number_cell(h), number_cell(value)});
      };
      for (const Record &record : results.records)
        if (record.has(quantity))
          add(record.key.method, record.key.series,
              is_over_horizon ? record.key.horizon : record.key.h, record[quantity]);
      for (const study::Limit &one : results.limits)
        if (one.quantity == quantity)
          add(one.method, one.series, 0, one.value);
      const double margin = largest > least ? .05 * (largest - least) : .1 * std::abs(least) + .1;
      chart.plot.y_range = Range{least - margin, largest + margin};
      return chart;
    }

    DataChart opening_chart(const StudyResults &results)
    {
      DataChart chart =
          named("profile", "Opening of the crack behind its tip",
                std::string("At the finest level that was solved of each method and series; ") +
                    (is_between_grips(results) ? "grips move apart by 2." : "K = 1."));
      chart.plot.x_label = "from the tip [length]";
      chart.plot.y_label = "opening [length]";
      chart.plot.is_x_log = chart.plot.is_y_log = false;
      chart.data.columns = {"method", "series", "from the tip", "opening"};
      const auto names = lines_of(results);
      const double farthest = std::stod(results.facts.at("height"));
      for (const Record *record : study::finest_records(results))
      {
        const std::string label = label_of(record->key.method, record->key.series);
        Line line{label, style_of(names, label), 1.8, {}};
        const analysis::Curve &opening = record->curves.at("opening");
        for (std::size_t i = 0; i < opening[0].values.size(); ++i)
        {
          const double x = opening[0].values[i];
          if (x < -farthest)
            continue;
          line.points.push_back({x, opening[1].values[i]});
          chart.data.rows.push_back({text_cell(record->key.method), text_cell(record->key.series),
                                     number_cell(x), number_cell(opening[1].values[i])});
        }
        chart.plot.lines.push_back(line);
      }
      return chart;
    }

    std::vector<DataChart> charts(const StudyResults &results)
    {
      if (study::finest_records(results).empty())
        return {};
      std::vector<DataChart> all;
      const auto add = [&](const std::string &quantity)
      {
        if (std::any_of(results.records.begin(), results.records.end(),
                        [&](const Record &record) { return record.has(quantity); }))
          all.push_back(quantity_chart(results, quantity));
      };
      add("tip energy");
      add("G");
      all.push_back(opening_chart(results));
      for (const char *const quantity : {"opening", "W1", "growth peak", "growth released"})
        add(quantity);
      return all;
    }

    std::string model(const StudyResults &results)
    {
      const auto fact = [&](const std::string &name)
      {
        const auto found = results.facts.find(name);
        return found == results.facts.end() ? "" : found->second;
      };
      const bool has_grips = is_between_grips(results);
      return std::string("Model: a strip ") +
             (has_grips ? "between rigid grips that move apart by 2, "
                        : "constrained all around to the field of a crack at K = 1, ") +
             fact("height") + " high, with a crack of length " + fact("crack") +
             (has_grips ? "; beyond its left end it continues with the grips, beyond its right end "
                          "as the intact strip"
                        : "; the field's tip is half a column ahead") +
             ". Bonds of λ = μ, without dilatation; those that cross the crack are left out. "
             "Energies in μ = " +
             fact("mu") +
             (has_grips ? " [force/length²] times length², W1 and G in μ times length."
                        : " [force/length²] times length², K in that times the root of length.");
    }
  } // namespace

  View strip_view(const StudyResults &results)
  {
    View view{"Stationary crack"};
    view.answer = answer(results);
    view.facts = {std::to_string(results.records.size()) + " strips"};
    view.parts = {strips(results), limits(results),
                  failures(results, "Levels without a result", "no result, because"),
                  model_part(model(results))};
    view.galleries = {{"picture", "Energy and opening at the crack tip", "", charts(results)}};
    return view;
  }
} // namespace plumbline::report
