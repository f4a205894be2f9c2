#include "report/dynamics_page.h"

#include "report/dynamics_charts.h"
#include "report/dynamics_tables.h"
#include "report/page_parts.h"
#include "report/text_table.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using study::DynamicResults;

    struct Part
    {
      const char *id, *head, *words;
      Table table;
      bool is_in_text; ///< for the terminal, too
    };

    /// The tables that have rows.
    std::vector<Part> parts(const DynamicResults &results)
    {
      std::vector<Part> all = {
          {"rates", "Errors and rates over levels", motion_rates_words, motion_rates_table(results),
           true},
          {"orders", "Orders in time", orders_words, orders_table(results), true},
          {"estimates", "What Galerkin motions say of their own errors", motion_estimates_words,
           motion_estimates_table(results), true},
          {"best", "The best pairs of h and time step", best_pairs_words, best_pairs_table(results),
           true},
          {"failures", "Motions that did not come to their end", "", failed_motions_table(results),
           true},
          {"runs", "All motions", motions_words, motions_table(results), false},
          {"reference", "The reference", torus_words, torus_table(results), false},
          {"model", "What moves", "", motion_facts_table(results), false},
          {"omissions", "What was left out of the model", "", motion_omissions_table(results),
           false},
          {"expectations", "Expectations", "", motion_expectations_table(results), false}};
      all.erase(std::remove_if(all.begin(), all.end(),
                               [](const Part &part) { return part.table.rows.empty(); }),
                all.end());
      return all;
    }

    std::string expectations(const DynamicResults &results)
    {
      const auto n = std::count_if(results.expectations.begin(), results.expectations.end(),
                                   [](const auto &one) { return one.holds; });
      return std::to_string(n) + " of " + std::to_string(results.expectations.size()) +
             " expectations hold";
    }

    std::string header(const DynamicResults &results)
    {
      std::vector<std::string> facts = {std::to_string(results.runs.size()) + " motions",
                                        "T = " + rounded(results.final_time),
                                        "regime " + results.regime};
      if (!results.expectations.empty())
        facts.push_back(expectations(results));
      if (!results.is_complete)
        facts.emplace_back(page::interrupted);
      return page::plain_header(results.scene_name, "dynamics", results.purpose, facts);
    }

    std::string page_of(const DynamicResults &results, const std::vector<DataChart> &charts,
                        const std::filesystem::path &dir)
    {
      const auto table = [](const Part &part)
      {
        return page::section(part.id, part.head,
                             "<div class=\"wide\">" + to_html(part.table) + "</div>\n" +
                                 (part.words[0] == '\0'
                                      ? ""
                                      : "<p class=\"soft\">" + escape_html(part.words) + "</p>\n"));
      };
      std::string text, pictures, rest;
      for (const Part &part : parts(results))
        (part.is_in_text ? text : rest) += table(part);
      for (std::size_t i = 0; i < charts.size(); ++i)
        pictures += page::figure(dir / "dynamics" / charts[i].plot.file,
                                 "m" + std::to_string(i) + "-", charts[i].plot.title,
                                 escape_html(charts[i].caption) + " Data: <code>dynamics/" +
                                     escape_html(charts[i].name) + ".csv</code>",
                                 false);
      if (!pictures.empty())
        text += page::section("charts", "Charts", "<div class=\"grid\">\n" + pictures + "</div>\n");
      std::string origin;
      for (const auto &[what, value] : results.provenance)
        origin += page::paragraph(what + ": " + value);
      rest += page::section(
          "provenance", "Where the numbers come from",
          origin + page::folded("The scene as read",
                                "<pre>" + escape_html(results.scene_text) + "</pre>\n"));
      return page::document(results.scene_name, "dynamics", header(results), text + rest);
    }

    std::string markdown(const DynamicResults &results)
    {
      std::string text = "# Motion: " + results.scene_name + "\n\n" + results.purpose + "\n";
      for (const Part &part : parts(results))
        text += std::string("\n## ") + part.head + "\n\n" + to_markdown(part.table) + "\n" +
                part.words + "\n";
      return text;
    }
  } // namespace

  std::string dynamics_text(const DynamicResults &results)
  {
    std::string text = results.scene_name + ": " + results.purpose + "\n";
    for (const Part &part : parts(results))
      if (part.is_in_text)
      {
        Table table = part.table; // reasons are long
        for (std::size_t c = table.columns.size(); c-- > 0;)
          if (table.columns[c].head == reasons_head)
          {
            table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(c));
            for (auto &row : table.rows)
              row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
          }
        text += std::string("\n") + part.head + "\n" + to_text(table);
      }
    for (const study::Expectation &one : results.expectations)
      if (!one.holds)
        text += "\nnot as expected: " + one.subject + ": expected " + one.expected + ", found " +
                one.found + "\n";
    if (!results.expectations.empty())
      text += "\n" + expectations(results) + "\n";
    return text;
  }

  void write_dynamics(const DynamicResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "dynamics.json", dynamics_json(results));
    write_file(dir / "dynamics.md", markdown(results));
    for (const Part &part : parts(results))
      write_file(dir / "dynamics" / (std::string(part.id) + "_table.csv"), to_csv(part.table));
    const std::vector<DataChart> charts = motion_charts(results);
    write_with_pictures(
        dir / "dynamics.html", [&] { write_charts(charts, dir / "dynamics"); },
        [&] { return page_of(results, charts, dir); });
  }
} // namespace plumbline::report
