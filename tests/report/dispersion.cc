// The pages, tables and charts of `plumbline dispersion`.
#include "report/dispersion_charts.h"
#include "report/dispersion_page.h"
#include "report/dispersion_tables.h"
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

    study::WaveCurve curve(physics::Polarisation polarisation, double angle, double error,
                           bool is_sampled)
    {
      study::WaveCurve result;
      result.polarisation = polarisation;
      result.angle = angle;
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
      using physics::Polarisation;
      study::DispersionRow result;
      result.method = method;
      result.side = study::Side::meshfree;
      result.series = "m = 3";
      result.h = h;
      result.horizon = 3 * h;
      for (const double angle : {0., 22.5})
      {
        result.curves.push_back(curve(Polarisation::longitudinal, angle, error, h < .06));
        result.curves.push_back(curve(Polarisation::transverse, angle, -error / 2, h < .06));
      }
      result.anisotropy = {.0125, -.03};
      result.range = {0, 4 / (h * h)};
      return result;
    }

    study::Trend trend(const std::string &method, study::Outcome outcome)
    {
      study::Trend t;
      t.method = method;
      t.side = study::Side::meshfree;
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

    study::DispersionResults results()
    {
      study::DispersionResults r{"a <scene>", "What & why", {{0, 22.5}, 1}, {}, {}};
      for (const std::string method : {"good", "bad"})
        for (const double h : {.2, .1, .05})
          r.rows.push_back(row(method, h, method == "good" ? h * h : .0275));
      study::DispersionRow none;
      none.method = "none";
      none.side = study::Side::meshfree;
      none.series = "m = 3";
      none.h = .2;
      none.horizon = .6;
      none.failure = "no weights";
      r.rows.push_back(none);
      r.trends = {trend("good", study::Outcome::converges), trend("bad", study::Outcome::stalls),
                  trend("none", study::Outcome::failed)};
      r.trends.back().values.clear();
      r.trends.back().x.clear();
      r.trends.back().rates.clear();
      return r;
    }
  } // namespace

  TEST(DispersionReport, tables_hold_what_was_measured)
  {
    const Table lengths = long_waves_table(results());
    ASSERT_EQ(lengths.columns.size(), 9u);
    EXPECT_EQ(lengths.columns[3].head, "L, 0°");
    EXPECT_EQ(lengths.columns[6].head, "T, 22.5°");
    EXPECT_EQ(lengths.columns[8].head, "anisotropy T");
    ASSERT_EQ(lengths.rows.size(), 2u); // of the finest level
    EXPECT_EQ(lengths.rows[0][2].text, "0.05");
    EXPECT_EQ(lengths.rows[1][3].csv[0], "0.0275");
    EXPECT_EQ(lengths.rows[1][4].csv[0], "-0.01375");
    EXPECT_EQ(lengths.rows[1][8].csv[0], "-0.029999999999999999");

    const Table levels = wave_levels_table(results());
    ASSERT_EQ(levels.rows.size(), 6u);
    EXPECT_EQ(levels.rows[5][3].text, rounded_error(.0275));
    EXPECT_EQ(levels.rows[5][4].text, rounded_error(std::abs(2 * 1.0275 / 1.98 - 1)));
    EXPECT_EQ(levels.rows[5][5].text, "1600");
    EXPECT_EQ(levels.rows[5][6].text, "0.05");
    EXPECT_EQ(levels.rows[5][7].text, "2"); // 2 · .05 / .05

    const Table missing = missing_waves_table(results());
    ASSERT_EQ(missing.rows.size(), 1u);
    EXPECT_EQ(missing.rows[0].back().text, "no weights");
  }

  TEST(DispersionReport, says_what_waves_tend_to_beside_what_is_proven)
  {
    const std::string text = dispersion_text(results());
    EXPECT_NE(text.find("good    m = 3   AC"), std::string::npos) << text;
    EXPECT_NE(text.find("second moments are off by 5 %"), std::string::npos);
    const Table table = wave_verdicts_table(results());
    EXPECT_EQ(table.rows[0][3].text, "AC");
    EXPECT_EQ(table.rows[1][3].text, "not AC");
    EXPECT_EQ(table.rows[1][5].text, "0.126");
  }

  TEST(DispersionReport, is_json_with_null_for_what_is_not_known)
  {
    const auto json = nlohmann::json::parse(dispersion_json(results()));
    EXPECT_EQ(json["angles"][1], 22.5);
    const auto &level = json["levels"][5];
    EXPECT_EQ(level["method"], "bad");
    EXPECT_DOUBLE_EQ(level["critical_step"], .05);
    EXPECT_EQ(level["waves"][3]["polarisation"], "T");
    EXPECT_EQ(level["waves"][3]["angle"], 22.5);
    EXPECT_DOUBLE_EQ(level["waves"][0]["long_wave_error"], .0275);
    EXPECT_TRUE(level["waves"][0]["samples"][0]["group_speed"].is_null());
    EXPECT_DOUBLE_EQ(level["waves"][0]["samples"][1]["group_speed"], 1.6);
    EXPECT_TRUE(json["levels"][6]["critical_step"].is_null());
    EXPECT_EQ(json["verdicts"][1]["verdict"], "not AC");
    EXPECT_EQ(json["verdicts"][1]["proven"], "not AC");
  }

  TEST(DispersionReport, charts_show_speeds_over_the_local_limits)
  {
    const auto charts = dispersion_charts(results());
    ASSERT_EQ(charts.size(), 1u + 4u + 2u); // errors; phase speeds; group speeds in one direction
    EXPECT_EQ(charts[0].name, "errors_m-3");
    EXPECT_EQ(charts[1].name, "phase_m-3_l-0");
    EXPECT_EQ(charts[6].name, "group_m-3_t-0");
    const Plot &plot = charts[1].plot;
    ASSERT_EQ(plot.lines.size(), 2u);
    ASSERT_EQ(plot.lines[0].points.size(), 3u);
    EXPECT_NEAR(plot.lines[0].points[0].x, 2 * M_PI / 3, 1e-12); // wavelength over h
    EXPECT_NEAR(plot.lines[0].points[0].y, .7, 1e-12);
    EXPECT_NEAR(plot.frontier[0].y, .95, 1e-12);
    EXPECT_LT(plot.y_range->low, .7);
    EXPECT_GE(plot.y_range->high, 1);
    // a wave that grows has no point
    EXPECT_EQ(charts[5].plot.lines[0].points.size(), 2u);
    EXPECT_EQ(charts[5].data.rows.size(), 6u);
  }

  TEST(DispersionReport, is_a_page_with_its_charts_inside)
  {
    const auto dir = std::filesystem::path(testing::TempDir()) / "plumbline_dispersion_page";
    std::filesystem::remove_all(dir);
    write_dispersion(results(), dir);
    const std::string page = fixture::read(dir / "dispersion.html");
    EXPECT_NE(page.find("a &lt;scene&gt;"), std::string::npos);
    EXPECT_NE(page.find("a &lt; b &amp; c"), std::string::npos);
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_EQ(page.find("not drawn"), std::string::npos);
    EXPECT_NE(fixture::read(dir / "dispersion.md").find("## Long waves"), std::string::npos);
    EXPECT_NE(fixture::read(dir / "dispersion/phase_m-3_l-0.csv").find("wavelength over h"),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(dir / "dispersion/errors_m-3.svg"));
    std::filesystem::remove_all(dir);
  }
} // namespace plumbline::report
