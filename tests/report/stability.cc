// The pages, tables and pictures of `plumbline stability`.
#include "report/stability_page.h"
#include "report/stability_pictures.h"
#include "report/stability_tables.h"
#include "report/strain_charts.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    study::StabilityRow row(const std::string &method, double h, bool is_free)
    {
      study::StabilityRow result{method, study::Side::meshfree, "m = 3", h, 3 * h, {}, {}, {}};
      study::Stability &s = result.stability;
      s.n_unknowns = 2 * static_cast<std::size_t>(std::pow(std::round(1 / h), 2));
      s.smallest = is_free ? 0 : 8 - h;
      s.largest = 3 / (h * h);
      s.n_zero = is_free ? 3 : 0;
      s.has_signs = true;
      s.signs.n_parts = 1;
      s.signs.asymmetry = is_free ? 0 : .25;
      s.signs.n_positive = is_free ? 4 : 0;
      s.eigenvalues = {7.75, 7.75, s.largest, .5, 12};
      s.inverse_norm = is_free ? 0 : .11;
      result.consistency.barrier = .12;
      s.modes.n_components = 2;
      s.modes.values.resize(is_free ? 3 : 1);
      for (double y = h / 2; y < 1; y += h)
        for (double x = h / 2; x < 1; x += h)
        {
          s.modes.nodes.emplace_back(x, y);
          if (is_free)
            for (int k = 0; k < 3; ++k)
            {
              s.modes.values[k].push_back(k == 0 ? 1 : k == 1 ? 0 : .5 - y);
              s.modes.values[k].push_back(k == 0 ? 0 : k == 1 ? -2 : x - .5);
            }
          else
            s.modes.values[0].insert(s.modes.values[0].end(),
                                     {std::sin(M_PI * x) * std::sin(M_PI * y), 0});
        }
      return result;
    }

    study::StabilityResults results()
    {
      study::StabilityResults r{"a <scene>", "What & why", {}, {}, {}};
      for (const double h : {.2, .1, .05})
        r.rows.push_back(row("sound", h, false));
      for (const double h : {.2, .1, .05})
        r.rows.push_back(row("free", h, true));
      r.rows.push_back({"none",
                        study::Side::meshfree,
                        "m = 3",
                        .2,
                        .6,
                        {},
                        {},
                        std::string(40, 'x') + " " + std::string(90, 'y')});
      r.trends = study::stability_trends(r.rows);
      for (const char *method : {"sound", "free", "none"})
        r.verdicts.push_back({method,
                              std::string(method) == "sound" ? study::StabilityAnswer::stable
                                                             : study::StabilityAnswer::unstable,
                              std::string(method) == "sound" ? "m >= 2" : "",
                              "3 modes < 4 & more"});
      return r;
    }
  } // namespace

  TEST(StabilityReport, fits_a_terminal)
  {
    const std::string text = stability_text(results());
    std::size_t start = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         start = end + 1, end = text.find('\n', start))
      EXPECT_LE(end - start, 160 + 4u) << text.substr(start, end - start); // dashes have 3 bytes
    // columns that nothing is known of are left out
    EXPECT_EQ(text.find("rank  "), std::string::npos);
    EXPECT_NE(text.find("barrier"), std::string::npos);
    // a method without an operator is told apart from the others
    EXPECT_NE(text.find("no operator, because"), std::string::npos);
  }

  TEST(StabilityReport, has_eigenvalues_of_operators_that_are_not_symmetric_alone)
  {
    const Table table = eigenvalues_table(results());
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[0].front().text, "sound");
    EXPECT_EQ(table.columns.back().head, "largest |imaginary part|");
    EXPECT_EQ(table.rows[0].back().text, "0.5");
  }

  TEST(StabilityReport, has_one_line_of_powers_for_each_method_and_series)
  {
    const Table table = powers_table(results());
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0][4].text, "-2.000");
    EXPECT_EQ(table.rows[1][3].text, empty_cell().text); // a free body has no coercivity
  }

  TEST(StabilityReport, stores_what_is_not_known_as_null)
  {
    const auto json = nlohmann::json::parse(stability_json(results()));
    EXPECT_EQ(json["levels"].size(), 7u);
    EXPECT_EQ(json["levels"][0]["eigenvalues_of_a"]["least_real_part"], 7.75);
    EXPECT_TRUE(json["levels"][6]["eigenvalues_of_a"].is_null());
    EXPECT_NEAR(json["powers"][0]["largest_eigenvalue"].get<double>(), -2, 1e-12);
    EXPECT_TRUE(json["powers"][2]["largest_eigenvalue"].is_null());
    EXPECT_EQ(json["verdicts"][0]["condition"], "m >= 2");
  }

  TEST(StabilityReport, draws_charts_and_modes_and_shows_them_behind_the_verdicts)
  {
    const fixture::Folder folder;
    const study::StabilityResults r = results();
    write_stability(r, folder.path());
    std::vector<std::string> names;
    for (const StabilityPicture &picture : list_pictures(r))
    {
      names.push_back(picture.name);
      EXPECT_NE(fixture::read(folder.path() / "stability" / (picture.name + ".svg")).find("</svg>"),
                std::string::npos)
          << picture.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"coercivity_m-3", "inverse_m-3", "largest_m-3",
                                               "lowest-modes_m-3", "zero-modes_free_m-3"}));
    const std::string html = fixture::read(folder.path() / "stability.html");
    EXPECT_EQ(fixture::count(html, "role=\"img\""), names.size());
    EXPECT_EQ(fixture::count(html, "<section"), fixture::count(html, "</section>"));
    EXPECT_NE(html.find("a &lt;scene&gt;"), std::string::npos);
    std::size_t last = 0; // verdicts come first
    for (const char *part :
         {"<h2>Verdicts", "<h2>Measures", "<h2>Measures over the sweep", "<h2>Modes"})
    {
      EXPECT_GT(html.find(part), last) << part;
      last = html.find(part);
    }
    // a free body has no point in the chart of coercivity, and an empty field in its data
    EXPECT_NE(fixture::read(folder.path() / "stability/coercivity_m-3.csv")
                  .find("free,m = 3,0.20000000000000001,0.60000000000000009,\n"),
              std::string::npos);
  }

  TEST(StabilityReport, gives_critical_steps_with_the_density_and_says_what_grows)
  {
    study::StabilityResults r = results();
    r.rows[0].steps = {4, 64, 16, true};
    r.rows[1].steps = {4, 100, 0, false};
    const Table table = time_steps_table(r);
    ASSERT_EQ(table.rows.size(), 2u);
    const auto json = nlohmann::json::parse(stability_json(r));
    EXPECT_EQ(json["levels"][0]["critical_step"], .5); // 2 / √(64/4)
    EXPECT_EQ(json["levels"][0]["critical_step_lumped"], 1);
    EXPECT_EQ(json["levels"][1]["critical_step"], .4);
    EXPECT_TRUE(json["levels"][1]["critical_step_lumped"].is_null());
    EXPECT_FALSE(json["levels"][1]["only_oscillates"]);
    EXPECT_TRUE(json["levels"][2]["critical_step"].is_null()); // not known
    EXPECT_NE(stability_text(r).find("dt, lumped"), std::string::npos);
  }

  TEST(StabilityReport, charts_growth_on_strains_beside_the_symbol_and_the_local_criterion)
  {
    study::StrainGrowth growth{"delta = 0.2", "shear", .05, .2, {1, 2.5}, 1.1, {}, {}};
    for (int i = 1; i <= 3; ++i)
      growth.samples.push_back({1. * i, 2. * i, {3, 4}, i > 1 ? 5. * i : 0, i > 2 ? 7. : 0});
    growth.methods = {{"FA", study::Side::meshfree, {0, 10, 15}, {0, 10.5, 12}, ""},
                      {"none", study::Side::meshfree, {}, {}, "no <weights>"}};
    const auto charts = strain_charts({growth});
    ASSERT_EQ(charts.size(), 1u);
    EXPECT_EQ(charts[0].name, "growth_shear_delta-0.2");
    const Plot &plot = charts[0].plot;
    ASSERT_EQ(plot.frontier.size(), 3u); // from where it begins
    EXPECT_EQ(plot.frontier[0].x, 1.1);
    EXPECT_EQ(plot.frontier[2].y, 15);
    ASSERT_EQ(plot.lines.size(), 2u);
    EXPECT_EQ(plot.lines[0].points[2].y, 12);
    EXPECT_EQ(plot.lines[1].label, "criterion (64)");
    EXPECT_EQ(plot.lines[1].points[0].x, 2.5);
    EXPECT_EQ(plot.lines[1].points[1].y, 7);
    EXPECT_EQ(charts[0].data.rows.size(), 3u);

    const Table table = strain_growth_table({growth});
    EXPECT_EQ(table.rows[0][4].text, "2"); // first seen
    EXPECT_EQ(table.rows[0][5].text, rounded_error(.2));
    EXPECT_EQ(table.rows[0][6].text, rounded_error(.2));
    EXPECT_EQ(table.rows[1][7].text, "no <weights>");
    EXPECT_EQ(strain_thresholds_table({growth}).rows[0][5].text, "2.5");
    study::StabilityResults r = results();
    r.strains = {growth};
    const auto json = nlohmann::json::parse(stability_json(r));
    EXPECT_EQ(json["strains"][0]["criterion_64"], 2.5);
    EXPECT_EQ(json["strains"][0]["methods"][0]["observed"][2], 12);
  }
} // namespace plumbline::report
