#include "report/dynamics_page.h"

#include "report/dynamics_charts.h"
#include "report/dynamics_tables.h"
#include "report/page_parts.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using study::DynamicResults;

    /// The tables that have rows: what a motion is asked for, on the terminal, too.
    std::vector<Part> answers(const DynamicResults &results)
    {
      return page::with_rows({{"rates", "Errors and rates over levels", motion_rates_words,
                               motion_rates_table(results)},
                              {"orders", "Orders in time", orders_words, orders_table(results)},
                              {"estimates", "What Galerkin motions say of their own errors",
                               motion_estimates_words, motion_estimates_table(results)},
                              {"best", "The best pairs of h and time step", best_pairs_words,
                               best_pairs_table(results)},
                              {"failures", "Motions that did not come to their end", "",
                               failed_motions_table(results)}});
    }

    std::vector<Part> details(const DynamicResults &results)
    {
      return page::with_rows(
          {{"warnings", "Warnings", "", motion_warnings_table(results)},
           {"runs", "All motions", motions_words, motions_table(results)},
           {"reference", "The reference", torus_words, torus_table(results)},
           {"model", "What moves", "", motion_facts_table(results)},
           {"omissions", "What was left out of the model", "", motion_omissions_table(results)},
           {"expectations", "Expectations", "", motion_expectations_table(results)}});
    }

    std::vector<Part> parts(const DynamicResults &results)
    {
      std::vector<Part> all = answers(results);
      for (Part &part : details(results))
        all.push_back(std::move(part));
      return all;
    }

    std::string expectations(const DynamicResults &results)
    {
      const auto n = std::count_if(results.expectations.begin(), results.expectations.end(),
                                   [](const auto &one) { return one.holds; });
      return std::to_string(n) + " of " + std::to_string(results.expectations.size()) +
             " expectations hold";
    }

    Data header(const DynamicResults &results)
    {
      std::vector<std::string> facts = {std::to_string(results.runs.size()) + " motions",
                                        "T = " + rounded(results.final_time),
                                        "regime " + results.regime};
      if (!results.expectations.empty())
        facts.push_back(expectations(results));
      if (!results.is_complete)
        facts.emplace_back(page::interrupted);
      return page::begin("dynamics", results.scene_name, results.purpose, facts);
    }

    std::string page_of(const DynamicResults &results, const std::vector<DataChart> &charts,
                        const std::filesystem::path &dir)
    {
      Data data = header(results);
      data["answers"] = page::parts(answers(results));
      data["curves"] =
          charts.empty() ? Data() : Data{{"charts", page::charts(charts, dir, "dynamics")}};
      data["details"] = page::parts(details(results));
      data["provenance"] = Data::array();
      for (const auto &[what, value] : results.provenance)
        data["provenance"].push_back(what + ": " + value);
      data["scene_text"] = results.scene_text;
      return fill("dynamics", data);
    }

    std::string markdown(const DynamicResults &results)
    {
      std::string text = "# Motion: " + results.scene_name + "\n\n" + results.purpose + "\n";
      for (const Part &part : parts(results))
        text += "\n## " + part.head + "\n\n" + to_markdown(part.table) + "\n" + part.words + "\n";
      return text;
    }
  } // namespace

  std::string dynamics_text(const DynamicResults &results)
  {
    std::string text = results.scene_name + ": " + results.purpose + "\n";
    for (Part &part : answers(results))
    {
      Table &table = part.table; // reasons are long
      for (std::size_t c = table.columns.size(); c-- > 0;)
        if (table.columns[c].head == reasons_head)
        {
          table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(c));
          for (auto &row : table.rows)
            row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
        }
      text += "\n" + part.head + "\n" + to_text(table);
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
      write_file(dir / "dynamics" / (part.id + "_table.csv"), to_csv(part.table));
    const std::vector<DataChart> charts = motion_charts(results);
    write_with_pictures(
        dir / "dynamics.html", [&] { write_charts(charts, dir / "dynamics"); },
        [&] { return page_of(results, charts, dir); });
  }
} // namespace plumbline::report
