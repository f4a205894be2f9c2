#include "report/strip_page.h"

#include "report/charts.h"
#include "report/data_charts.h"
#include "report/page_parts.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    using study::StripResults;
    using study::StripRow;
    using Json = nlohmann::ordered_json;

    constexpr const char *meaning_of_field =
        "G is what the crack gets for its advance by a column, over K²/E', which it would get in "
        "the local solid whose field holds the strip's edges (Irwin 1957): it tends to 1 as the "
        "horizon vanishes, and at one horizon to the same number by all methods. The opening is "
        "u_y above less that below, of the last cells behind the tip, of rules at the last nodes. "
        "Continuous functions close there.";

    constexpr const char *meaning_of_grips =
        "W1 is the energy of the intact strip per length, and what a crack gets for its advance, "
        "G, whatever the horizon (Rice 1968): G = W1 holds by translation, by any quadrature, and "
        "tells of bookkeeping and of a strip that is too short. What sees the tip is its energy, "
        "what it adds to an intact strip from there on, and the opening there: u_y above less that "
        "below, of the last cells behind it, of rules at the last nodes. Continuous functions "
        "close there. Growth is that of a crack by rules, bond by bond, over the toughness of the "
        "law: the most that it gets before it goes on (peak: what lattices trap) and the mean of "
        "all events, what it sets free for its advance, and what its bonds held at their limits.";

    bool is_between_grips(const StripResults &results)
    {
      return results.strip.edges == scene::StripEdges::grips;
    }

    const char *meaning(const StripResults &results)
    {
      return is_between_grips(results) ? meaning_of_grips : meaning_of_field;
    }

    std::string label_of(const std::string &method, const std::string &series)
    {
      return method + (series.empty() ? "" : ", " + series);
    }

    /// By the labels of their lines.
    std::vector<MethodName> lines_of(const StripResults &results)
    {
      std::vector<MethodName> lines;
      for (const StripRow &row : results.rows)
        if (const std::string label = label_of(row.method, row.series);
            std::none_of(lines.begin(), lines.end(),
                         [&](const MethodName &one) { return one.name == label; }))
          lines.push_back({label, row.family});
      return lines;
    }

    Cell growth_cell(const StripRow &row, const std::string &quantity)
    {
      return known(row.growth.has_value(), number_cell(row.growth ? row.quantity(quantity) : 0));
    }

    Table rows_table(const StripResults &results)
    {
      Table table;
      table.columns = {"method",         "series",      "h [length]", "m",
                       "W1 [mu length]", "tip energy",  "opening",    "G/W1 - 1",
                       "G E'/K^2",       "growth peak", "mean",       "released",
                       "bonds",          "unknowns",    "CPU s",      "failure"};
      const bool has_grips = is_between_grips(results);
      for (const StripRow &row : results.rows)
      {
        const bool is = row.failure.empty();
        table.rows.push_back(
            {text_cell(row.method), text_cell(row.series), number_cell(row.h), number_cell(row.m()),
             known(is && has_grips, number_cell(row.state.intact)),
             known(is && has_grips, number_cell(is ? row.quantity("tip energy") : 0)),
             known(is, number_cell(is ? row.quantity("opening") : 0)),
             known(is && has_grips, number_cell(is ? row.imbalance() : 0)),
             known(is && !has_grips, number_cell(is ? row.quantity("G") : 0)),
             growth_cell(row, "growth peak"), growth_cell(row, "growth mean"),
             growth_cell(row, "growth released"), growth_cell(row, "growth bonds"),
             known(is, count_cell(row.state.n_unknowns)), number_cell(row.seconds),
             text_cell(row.failure)});
      }
      return without_empty_columns(table);
    }

    Table limits_table(const StripResults &results)
    {
      Table table;
      table.columns = {"quantity", "method", "series", "limit", "rate", "change"};
      for (const std::string &quantity : study::strip_quantities(results.strip))
        for (const study::StripLimit &one : results.limits)
          if (one.quantity == quantity)
            table.rows.push_back({text_cell(one.quantity), text_cell(one.method),
                                  text_cell(one.series), number_cell(one.limit),
                                  number_cell(one.rate),
                                  known(std::isfinite(one.change), number_cell(one.change))});
      return without_empty_columns(table);
    }

    std::string verdict(const StripResults &results, const std::vector<std::string> &faults)
    {
      std::string text;
      for (const study::StripAgreement &one : study::strip_agreements(results.limits))
        text += one.quantity + " (" + one.series + ") of " + std::to_string(one.n_methods) +
                " methods: limits between " + rounded(one.least) + " and " + rounded(one.largest) +
                ", " + rounded((one.largest - one.least) / std::abs(one.largest)) + " apart. ";
      if (text.empty())
        text = "Limits take three levels of h at one horizon, or at one ratio of both; that "
               "methods agree takes four, and two methods whose limits move by less than a "
               "twentieth with the finest. ";
      for (const std::string &fault : faults)
        text += "EXPECTED: " + fault + ". ";
      text.pop_back();
      return text;
    }

    DataChart quantity_chart(const StripResults &results, const std::string &quantity)
    {
      const bool is_over_horizon = // h stays
          std::all_of(results.rows.begin(), results.rows.end(),
                      [&](const StripRow &row) { return row.h == results.rows.front().h; });
      DataChart chart = is_over_horizon
                            ? named(slug(quantity), quantity + " over the horizon")
                            : named(slug(quantity), quantity + " over h, and limits at 0",
                                    "At h = 0: where the three finest levels lead.");
      chart.plot.x_label = is_over_horizon ? "horizon δ [length]" : "mesh size h [length]";
      chart.plot.y_label = quantity;
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
      for (const StripRow &row : results.rows)
        if (row.failure.empty() && std::isfinite(row.quantity(quantity)))
          add(row.method, row.series, is_over_horizon ? row.horizon : row.h,
              row.quantity(quantity));
      for (const study::StripLimit &one : results.limits)
        if (one.quantity == quantity)
          add(one.method, one.series, 0, one.limit);
      const double margin = largest > least ? .05 * (largest - least) : .1 * std::abs(least) + .1;
      chart.plot.y_range = Range{least - margin, largest + margin};
      return chart;
    }

    DataChart opening_chart(const StripResults &results)
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
      for (auto row = results.rows.begin(); row != results.rows.end(); ++row)
      {
        const bool is_finest = std::none_of(std::next(row), results.rows.end(),
                                            [&](const StripRow &other) {
                                              return other.method == row->method &&
                                                     other.series == row->series &&
                                                     other.failure.empty();
                                            });
        if (!is_finest || !row->failure.empty())
          continue;
        Line line{label_of(row->method, row->series),
                  style_of(names, label_of(row->method, row->series)),
                  1.8,
                  {}};
        const auto &opening = row->state.opening;
        const double shift = row->family == method::MethodFamily::meshfree ? .5 : 0; // nodes are centres
        for (std::size_t i = 0; i < opening.size(); ++i)
        {
          const double x =
              (static_cast<double>(i + 1) - shift - static_cast<double>(opening.size())) * row->h;
          if (x < -results.strip.height)
            continue;
          line.points.push_back({x, opening[i]});
          chart.data.rows.push_back({text_cell(row->method), text_cell(row->series), number_cell(x),
                                     number_cell(opening[i])});
        }
        chart.plot.lines.push_back(line);
      }
      return chart;
    }

    std::vector<DataChart> charts_of(const StripResults &results)
    {
      if (std::none_of(results.rows.begin(), results.rows.end(),
                       [](const StripRow &row) { return row.failure.empty(); }))
        return {};
      if (!is_between_grips(results))
        return {quantity_chart(results, "G"), opening_chart(results),
                quantity_chart(results, "opening")};
      std::vector<DataChart> charts = {quantity_chart(results, "tip energy"),
                                       opening_chart(results), quantity_chart(results, "opening"),
                                       quantity_chart(results, "W1")};
      if (std::any_of(results.rows.begin(), results.rows.end(),
                      [](const StripRow &row) { return row.growth.has_value(); }))
        for (const char *const quantity : {"growth peak", "growth released"})
          charts.push_back(quantity_chart(results, quantity));
      return charts;
    }

    std::string model_words(const StripResults &results)
    {
      return std::string("Model: a strip ") +
             (is_between_grips(results) ? "between rigid grips that move apart by 2, "
                                        : "held all around at the field of a crack at K = 1, ") +
             rounded(results.strip.height) + " high, with a crack of length " +
             rounded(results.strip.crack) +
             (is_between_grips(results)
                  ? "; behind its left end it goes on with the grips, ahead of its right end as "
                    "the intact strip"
                  : "; the field's tip is half a column ahead") +
             ". Bonds of λ = μ, without dilatation; those that cross the crack are "
             "left out. Energies in μ = " +
             rounded(results.mu) +
             (is_between_grips(results)
                  ? " [force/length²] times length², W1 and G in μ times length."
                  : " [force/length²] times length², K in that times the root of length.");
    }

    Json known_number(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }
  } // namespace

  std::string strip_text(const StripResults &results)
  {
    return results.scene_name + "\n\n" + to_text(rows_table(results)) + "\n" +
           (results.limits.empty() ? "" : to_text(limits_table(results)) + "\n") +
           wrapped(model_words(results), 120) + "\n\n" + wrapped(verdict(results, {}), 120) + "\n";
  }

  std::string strip_json(const StripResults &results)
  {
    Json json{{"scene", results.scene_name},
              {"is_complete", results.is_complete},
              {"height", results.strip.height},
              {"length", results.strip.length},
              {"crack", results.strip.crack},
              {"edges", base::word(results.strip.edges)},
              {"mu", results.mu},
              {"levels", Json::array()},
              {"limits", Json::array()}};
    for (const StripRow &row : results.rows)
    {
      Json one{{"method", row.method},   {"family", base::word(row.family)},
               {"series", row.series},   {"h", row.h},
               {"horizon", row.horizon}, {"seconds", row.seconds},
               {"failure", row.failure}};
      if (row.failure.empty())
        one.update(
            {{is_between_grips(results) ? "W1" : "K2_over_E", row.state.intact},
             {"energy", row.state.energy},
             {"tip_energy", is_between_grips(results) ? Json(row.quantity("tip energy")) : Json()},
             {"release", row.release},
             {"growth", row.growth ? Json{{"peak", row.growth->peak},
                                          {"mean", row.growth->mean},
                                          {"released", row.growth->released},
                                          {"bonds", row.growth->bonds}}
                                   : Json()},
             {"n_unknowns", row.state.n_unknowns},
             {"opening", row.state.opening}});
      json["levels"].push_back(one);
    }
    for (const study::StripLimit &one : results.limits)
      json["limits"].push_back({{"method", one.method},
                                {"series", one.series},
                                {"quantity", one.quantity},
                                {"limit", one.limit},
                                {"rate", one.rate},
                                {"change", known_number(one.change)}});
    return json.dump(2) + "\n";
  }

  void write_strip(const StripResults &results, const std::vector<std::string> &faults,
                   const std::filesystem::path &dir)
  {
    write_file(dir / "strip.json", strip_json(results));
    write_file(dir / "strip.md",
               "# Strip: " + results.scene_name + "\n\n" + verdict(results, faults) + "\n\n" +
                   to_markdown(rows_table(results)) + "\n" +
                   (results.limits.empty() ? "" : to_markdown(limits_table(results)) + "\n") +
                   meaning(results) + "\n\n" + model_words(results) + "\n");
    const auto charts = charts_of(results);
    const auto page = [&]
    {
      Data data = page::begin("strip", results.scene_name, results.purpose,
                              {std::to_string(results.rows.size()) + " strips",
                               !results.is_complete ? page::interrupted
                               : faults.empty()     ? "✓ as expected"
                                                    : "✗ not as expected"});
      data["verdict"] = verdict(results, faults);
      data["charts"] = page::charts(charts, dir, "strip");
      data["strips"] = page::table(rows_table(results));
      data["limits"] = page::table(limits_table(results));
      data["meaning"] = meaning(results);
      data["model"] = model_words(results);
      return fill("strip", data);
    };
    write_with_pictures(
        dir / "strip.html", [&] { write_charts(charts, dir / "strip"); }, page);
  }
} // namespace plumbline::report
