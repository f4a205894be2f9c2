// What `plumbline stability` shows and writes.
#include "study/stability.h"
#include "io/results_json.h"
#include "report/view.h"
#include "study/strain_growth.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    study::Record place(const std::string &method, double h)
    {
      study::Record record;
      record.key.analysis = "stability";
      record.key.method = method;
      record.key.series = "m = 3";
      record.key.level = h > .15 ? 0 : h > .07 ? 1 : 2;
      record.key.h = h;
      record.key.horizon = 3 * h;
      return record;
    }

    study::Record row(const std::string &method, double h, bool is_free,
                      const study::CriticalSteps &steps = {})
    {
      study::Stability s;
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
      study::Consistency consistency;
      consistency.barrier = .12;
      s.modes.n_components = 2;
      s.modes.values.resize(is_free ? 3 : 1);
      for (double y = h / 2; y < 1; y += h)
        for (double x = h / 2; x < 1; x += h)
        {
          s.modes.nodes.emplace_back(x, y, 0);
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
      return study::stability_record(place(method, h), s, consistency, steps);
    }

    study::StudyResults results()
    {
      study::StudyResults r;
      r.analysis = "stability";
      r.scene_name = "a <scene>";
      r.purpose = "What & why";
      for (const double h : {.2, .1, .05})
        r.records.push_back(row("sound", h, false));
      for (const double h : {.2, .1, .05})
        r.records.push_back(row("free", h, true));
      r.records.push_back(place("none", .2));
      r.records.back().failure = std::string(40, 'x') + " " + std::string(90, 'y');
      r.powers = study::stability_powers(r.records);
      for (const char *method : {"sound", "free", "none"})
      {
        const bool is_sound = std::string(method) == "sound";
        r.verdicts.push_back({method, "", is_sound ? "stable" : "unstable",
                              is_sound ? study::Rating::good : study::Rating::bad,
                              is_sound ? "m >= 2" : "", "3 modes < 4 & more"});
      }
      return r;
    }

    Table part(const study::StudyResults &r, const std::string &id)
    {
      for (const Part &one : stability_view(r).parts)
        if (one.id == id)
          return one.table;
      ADD_FAILURE() << "no part is called " << id;
      return {};
    }

    const Cell &cell(const Table &table, std::size_t row, const std::string &head)
    {
      for (std::size_t j = 0; j < table.columns.size(); ++j)
        if (table.columns[j].head == head)
          return table.rows.at(row).at(j);
      throw std::out_of_range("no column is called " + head);
    }
  } // namespace

  TEST(StabilityReport, fits_a_terminal)
  {
    const study::StudyResults r = results();
    const std::string text = study_text(stability_view(r), r);
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
    const Table table = part(results(), "eigenvalues");
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[0].front().text, "sound");
    EXPECT_EQ(table.columns.back().head, "largest |imaginary part|");
    EXPECT_EQ(table.rows[0].back().text, "0.5");
  }

  TEST(StabilityReport, has_one_line_of_powers_for_each_method_and_series)
  {
    const Table table = part(results(), "powers");
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(cell(table, 0, "largest eigenvalue").text, "-2.000");
    // a free body has no coercivity
    EXPECT_EQ(cell(table, 1, "smallest eigenvalue").text, empty_cell().text);
  }

  TEST(StabilityReport, leaves_out_of_the_file_what_is_not_known)
  {
    const auto json = nlohmann::json::parse(io::to_json(results()));
    EXPECT_EQ(json["records"].size(), 7u);
    EXPECT_EQ(json["records"][0]["scalars"]["least real part"]["value"], 7.75);
    EXPECT_FALSE(json["records"][6]["scalars"].contains("least real part"));
    EXPECT_NEAR(json["powers"][0]["powers"]["largest eigenvalue"].get<double>(), -2, 1e-12);
    EXPECT_FALSE(json["powers"][2]["powers"].contains("largest eigenvalue"));
    EXPECT_EQ(json["verdicts"][0]["condition"], "m >= 2");
  }

  TEST(StabilityReport, draws_charts_and_modes_and_shows_them_behind_the_verdicts)
  {
    const fixture::Folder folder;
    const study::StudyResults r = results();
    const View view = stability_view(r);
    write_study(view, r, folder.path());
    std::vector<std::string> names;
    for (const Gallery &gallery : view.galleries)
    {
      for (const DataChart &chart : gallery.charts)
        names.push_back(chart.name);
      for (const Picture &picture : gallery.pictures)
        names.push_back(picture.name);
    }
    for (const std::string &name : names)
      EXPECT_NE(fixture::read(folder.path() / "stability" / (name + ".svg")).find("</svg>"),
                std::string::npos)
          << name;
    EXPECT_EQ(names, (std::vector<std::string>{"coercivity_m-3", "inverse_m-3", "largest_m-3",
                                               "lowest-modes_m-3", "zero-modes_free_m-3"}));
    for (const Gallery &gallery : view.galleries)
      for (const DataChart &chart : gallery.charts)
        EXPECT_TRUE(fixture::has_units(chart.plot)) << chart.name;
    const std::string html = fixture::read(folder.path() / "stability.html");
    EXPECT_EQ(fixture::count(html, "role=\"img\""), names.size());
    EXPECT_EQ(fixture::count(html, "<section"), fixture::count(html, "</section>"));
    EXPECT_NE(html.find("a &lt;scene&gt;"), std::string::npos);
    std::size_t last = 0; // verdicts come first, then pictures
    for (const char *heading :
         {"<h2>Verdicts", "<h2>Measures over the sweep", "<h2>Modes", "<h2>Measures</h2>"})
    {
      EXPECT_GT(html.find(heading), last) << heading;
      last = html.find(heading);
    }
    // a free body has no point in the chart of coercivity, and an empty field in its data
    EXPECT_NE(fixture::read(folder.path() / "stability/coercivity_m-3.csv")
                  .find("free,m = 3,0.20000000000000001,0.60000000000000009,\n"),
              std::string::npos);
  }

  TEST(StabilityReport, gives_critical_steps_with_the_density_and_says_what_grows)
  {
    study::StudyResults r = results();
    r.records[0] = row("sound", .2, false, {4, 64, 16, true});
    r.records[1] = row("sound", .1, false, {4, 100, 0, false});
    const Table table = part(r, "time-steps");
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(cell(table, 0, "dt").csv[0], "0.5"); // 2 / √(64/4)
    EXPECT_EQ(cell(table, 0, "dt, lumped").csv[0], "1");
    EXPECT_EQ(cell(table, 0, "grows").text, empty_cell().text);
    EXPECT_EQ(cell(table, 1, "dt").text, "0.4");
    EXPECT_EQ(cell(table, 1, "dt, lumped").text, empty_cell().text);
    EXPECT_EQ(cell(table, 1, "grows").text, "yes");
    EXPECT_FALSE(r.records[2].has("critical step")); // not known
    EXPECT_NE(study_text(stability_view(r), r).find("dt, lumped"), std::string::npos);
  }

  TEST(StabilityReport, charts_growth_on_strains_beside_the_symbol_and_the_local_criterion)
  {
    study::StrainGrowth growth{"delta = 0.2", "shear", .05, .2, {1, 2.5}, 1.1, {}, {}};
    for (int i = 1; i <= 3; ++i)
      growth.samples.push_back({1. * i, 2. * i, {3, 4}, i > 1 ? 5. * i : 0, i > 2 ? 7. : 0});
    study::StudyResults r = results();
    for (const study::MethodGrowth &one :
         {study::MethodGrowth{"FA", study::MethodFamily::meshfree, {0, 10, 15}, {0, 10.5, 12}, ""},
          study::MethodGrowth{"none", study::MethodFamily::meshfree, {}, {}, "no <weights>"}})
    {
      study::Record record = place(one.method, .05);
      record.key.series = "delta = 0.2";
      record.key.horizon = .2;
      r.records.push_back(study::strain_record(record, growth, one));
    }
    const View view = stability_view(r);
    const Gallery &gallery = view.galleries.at(1);
    ASSERT_EQ(gallery.id, "strain-charts");
    ASSERT_EQ(gallery.charts.size(), 1u);
    EXPECT_EQ(gallery.charts[0].name, "growth_shear-strain_delta-0.2");
    const Plot &plot = gallery.charts[0].plot;
    EXPECT_TRUE(fixture::has_units(plot));
    ASSERT_EQ(plot.frontier.size(), 3u); // from where it begins
    EXPECT_EQ(plot.frontier[0].x, 1.1);
    EXPECT_EQ(plot.frontier[2].y, 15);
    ASSERT_EQ(plot.lines.size(), 2u);
    EXPECT_EQ(plot.lines[0].points[2].y, 12);
    EXPECT_EQ(plot.lines[1].label, "criterion (64)");
    EXPECT_EQ(plot.lines[1].points[0].x, 2.5);
    EXPECT_EQ(plot.lines[1].points[1].y, 7);
    EXPECT_EQ(gallery.charts[0].data.rows.size(), 3u);

    const Table table = part(r, "strains");
    EXPECT_EQ(cell(table, 0, "first seen at X").text, "2");
    EXPECT_EQ(cell(table, 0, "from symbol").text, rounded_error(.2));
    EXPECT_EQ(cell(table, 0, "from tangent").text, rounded_error(.2));
    EXPECT_EQ(cell(table, 0, "X, (64)").text, "2.5");
    EXPECT_EQ(cell(table, 1, "no motion, because").text, "no <weights>");
    const auto json = nlohmann::json::parse(io::to_json(r));
    EXPECT_EQ(json["records"][7]["scalars"]["criterion (64)"]["value"], 2.5);
    EXPECT_EQ(json["records"][7]["curves"]["growth"][7]["values"][2], 12);
  }
} // namespace plumbline::report
