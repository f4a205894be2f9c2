// What `plumbline dispersion` shows and writes.
#include "study/dispersion.h"
#include "io/results_json.h"
#include "report/view.h"
#include "study/trend.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    study::WaveCurve curve(const std::string &name, double error, bool is_sampled)
    {
      study::WaveCurve result;
      result.name = name;
      result.local_speed = 2;
      result.long_wave_error = error;
      result.longest = {6, 2 * (1 + error), 1.9, 1.98, 1.95};
      if (is_sampled)
        for (const double k : {60., 20., 1.})
          result.samples.push_back({k, 2 - .01 * k, k > 50 ? nan : 2 - .02 * k, 1.9, 1.8});
      return result;
    }

    study::DispersionRow row(const std::string &method, double h, double error)
    {
      study::DispersionRow result;
      result.method = method;
      result.family = study::MethodFamily::meshfree;
      result.series = "m = 3";
      result.h = h;
      result.horizon = 3 * h;
      for (const std::string direction : {"at 0°", "at 22.5°"})
      {
        result.curves.push_back(curve("L waves " + direction, error, h < .06));
        result.curves.push_back(curve("T waves " + direction, -error / 2, h < .06));
      }
      result.anisotropy = {{"L", .0125}, {"T", -.03}};
      result.range = {0, 4 / (h * h)};
      return result;
    }

    study::Trend trend(const std::string &method, study::Outcome outcome)
    {
      study::Trend t;
      t.method = method;
      t.family = study::MethodFamily::meshfree;
      t.series = "m = 3";
      t.error = "phase speed | nonlocal";
      t.axis = study::Axis::mesh_size;
      t.x = {.2, .1, .05};
      t.values = {.04, .03, .0275};
      t.rates = {.415, .126};
      t.outcome = outcome;
      t.verdict = outcome == study::Outcome::converges ? "AC" : "not AC";
      t.reason = "a < b & c";
      t.proof.answer = outcome == study::Outcome::converges
                           ? study::LimitProof::Answer::compatible
                           : study::LimitProof::Answer::incompatible;
      t.proof.reason = "second moments are off by 5 %";
      return t;
    }

    study::Record record(const std::string &method, double h)
    {
      study::Record place;
      place.key.method = method;
      place.key.series = "m = 3";
      place.key.level = h > .15 ? 0 : h > .07 ? 1 : 2;
      place.key.h = h;
      place.key.horizon = 3 * h;
      return place;
    }

    study::StudyResults results()
    {
      study::StudyResults r;
      r.analysis = "dispersion";
      r.scene_name = "a <scene>";
      r.purpose = "What & why";
      r.facts = {{"longest wave", "1"}, {"first direction", "at 0°"}, {"directions", "0°, 22.5°"}};
      for (const std::string method : {"good", "bad"})
        for (const double h : {.2, .1, .05})
          r.records.push_back(study::wave_record(record(method, h),
                                                 row(method, h, method == "good" ? h * h : .0275)));
      study::DispersionRow none;
      none.failure = "no weights";
      r.records.push_back(study::wave_record(record("none", .2), none));
      r.trends = {trend("good", study::Outcome::converges), trend("bad", study::Outcome::stalls),
                  trend("none", study::Outcome::failed)};
      r.trends.back().values.clear();
      r.trends.back().x.clear();
      r.trends.back().rates.clear();
      return r;
    }

    Table part(const std::string &id)
    {
      for (const Part &one : dispersion_view(results()).parts)
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

  TEST(DispersionReport, tables_hold_what_was_measured)
  {
    const Table lengths = part("long");
    ASSERT_EQ(lengths.columns.size(), 9u);
    EXPECT_EQ(lengths.columns[8].head, "anisotropy T");
    ASSERT_EQ(lengths.rows.size(), 2u); // of the finest level
    EXPECT_EQ(lengths.rows[0][2].text, "0.05");
    EXPECT_EQ(cell(lengths, 1, "L waves at 0°").csv[0], "0.0275");
    EXPECT_EQ(cell(lengths, 1, "T waves at 0°").csv[0], "-0.01375");
    EXPECT_EQ(cell(lengths, 1, "T waves at 22.5°").csv[0], "-0.01375");
    EXPECT_EQ(cell(lengths, 1, "anisotropy L").csv[0], "0.012500000000000001");
    EXPECT_EQ(cell(lengths, 1, "anisotropy T").csv[0], "-0.029999999999999999");

    const Table levels = part("levels");
    ASSERT_EQ(levels.rows.size(), 6u);
    EXPECT_EQ(levels.rows[5][3].text, rounded_error(.0275));
    EXPECT_EQ(levels.rows[5][4].text, rounded_error(std::abs(2 * 1.0275 / 1.98 - 1)));
    EXPECT_EQ(levels.rows[5][5].text, "1600");
    EXPECT_EQ(levels.rows[5][6].text, "0.05");
    EXPECT_EQ(levels.rows[5][7].text, "2"); // 2 · .05 / .05

    const Table missing = part("missing");
    ASSERT_EQ(missing.rows.size(), 1u);
    EXPECT_EQ(missing.rows[0].back().text, "no weights");
  }

  TEST(DispersionReport, says_what_waves_tend_to_beside_what_is_proven)
  {
    const View view = dispersion_view(results());
    const std::string text = study_summary(view, results(), "dispersion.html");
    EXPECT_NE(text.find("good    m = 3   AC"), std::string::npos) << text;
    EXPECT_NE(text.find("second moments are off by 5 %"), std::string::npos);
    EXPECT_EQ(view.verdicts.rows[0][3].text, "AC");
    EXPECT_EQ(view.verdicts.rows[1][3].text, "not AC");
    EXPECT_EQ(view.verdicts.rows[1][5].text, "0.126");
    std::vector<std::string> looks;
    for (const auto &row : view.verdicts.rows)
      looks.push_back(row[2].look);
    EXPECT_EQ(looks, (std::vector<std::string>{"converges", "stalls", "stalls"}));
    study::StudyResults exact = results();
    exact.trends[1].round_off = exact.trends[1].values.back();
    EXPECT_EQ(dispersion_view(exact).verdicts.rows[1][5].text, empty_cell().text);
  }

  TEST(DispersionReport, is_json_without_what_is_not_known)
  {
    const auto json = nlohmann::json::parse(io::to_json(results()));
    const auto &level = json["records"][5];
    EXPECT_EQ(level["key"]["method"], "bad");
    EXPECT_DOUBLE_EQ(level["scalars"]["critical step"]["value"], .05);
    EXPECT_EQ(level["scalars"]["critical step"]["unit"], "time");
    EXPECT_DOUBLE_EQ(level["scalars"]["L waves at 0°: error of long waves"]["value"], .0275);
    const auto &waves = level["curves"]["T waves at 22.5°"];
    EXPECT_EQ(waves[2]["name"], "group speed");
    EXPECT_TRUE(waves[2]["values"][0].is_null());
    EXPECT_DOUBLE_EQ(waves[2]["values"][1], 1.6);
    EXPECT_FALSE(json["records"][6]["scalars"].contains("critical step"));
    EXPECT_EQ(json["trends"][1]["verdict"], "not AC");
    EXPECT_EQ(json["trends"][1]["proof"]["answer"], "incompatible");
  }

  TEST(DispersionReport, charts_show_speeds_over_the_local_limits)
  {
    const auto charts = dispersion_view(results()).galleries.at(0).charts;
    // errors; phase speeds; in one direction deviations of these, and group speeds
    ASSERT_EQ(charts.size(), 1u + 4u + 2u + 2u);
    EXPECT_EQ(charts[0].name, "errors_m-3");
    for (const DataChart &chart : charts)
      EXPECT_TRUE(fixture::has_units(chart.plot)) << chart.name;
    const auto named = [&](const std::string &name) -> const DataChart &
    {
      for (const DataChart &chart : charts)
        if (chart.name == name)
          return chart;
      throw std::out_of_range(name);
    };
    const Plot &plot = named("phase_m-3_l-waves-at-0").plot;
    ASSERT_EQ(plot.lines.size(), 2u);
    ASSERT_EQ(plot.lines[0].points.size(), 3u);
    EXPECT_NEAR(plot.lines[0].points[0].x, 2 * M_PI / 3, 1e-12); // wavelength over h
    EXPECT_NEAR(plot.lines[0].points[0].y, .7, 1e-12);
    EXPECT_NEAR(plot.frontier[0].y, .95, 1e-12);
    EXPECT_LT(plot.y_range->low, .7);
    EXPECT_GE(plot.y_range->high, 1);
    const Plot &deviation = named("deviation_m-3_l-waves-at-0").plot;
    EXPECT_NEAR(deviation.lines[0].points[0].x, 2 * M_PI / 3, 1e-12);
    EXPECT_NEAR(deviation.lines[0].points[0].y, std::abs(.7 / .95 - 1), 1e-12);
    EXPECT_TRUE(deviation.is_y_log);
    // a wave that grows has no point
    const DataChart &group = named("group_m-3_l-waves-at-0");
    EXPECT_EQ(group.plot.lines[0].points.size(), 2u);
    EXPECT_EQ(group.data.rows.size(), 6u);
    EXPECT_NO_THROW((void)named("group_m-3_t-waves-at-0"));
  }

  TEST(DispersionReport, is_a_page_with_its_charts_inside)
  {
    const fixture::Folder folder;
    const auto dir = folder.path();
    write_study(dispersion_view(results()), results(), dir);
    const std::string page = fixture::read(dir / "dispersion.html");
    EXPECT_NE(page.find("a &lt;scene&gt;"), std::string::npos);
    EXPECT_NE(page.find("a &lt; b &amp; c"), std::string::npos);
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_EQ(page.find("not drawn"), std::string::npos);
    EXPECT_NE(fixture::read(dir / "dispersion.md").find("## Long waves"), std::string::npos);
    EXPECT_NE(
        fixture::read(dir / "dispersion/phase_m-3_l-waves-at-0.csv").find("wavelength over h"),
        std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(dir / "dispersion/errors_m-3.svg"));
  }
} // namespace plumbline::report
