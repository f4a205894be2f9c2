// What `plumbline crack` says and draws.
#include "report/view.h"
#include "scene/crack_section.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    study::StudyResults moved(scene::CrackOutcome outcome)
    {
      Record record;
      record.key.method = "FA";
      record.key.h = .5;
      record.key.horizon = 1.5;
      record.texts["outcome"] = base::word(outcome);
      record.set("load", 2);
      record.set("advance", 3, "length");
      record.set("speed", .5, "length/time");
      record.set("speed / c_R", .625);
      record.set("fastest / c_R", .75);
      record.set("speed window", .2, "time");
      record.set("c_R", .8, "length/time");
      record.set("notch tip", 1, "length");
      record.set("asymmetry", 0);
      record.curves["samples"] = {{"t", "time", {0, 1, 2}},      {"tip", "length", {1, 2, 4}},
                                  {"kinetic", "", {0, 1, 2}},    {"bonds", "", {9, 7, 5}},
                                  {"soft bonds", "", {0, 1, 2}}, {"dissipated", "", {0, 1, 2}},
                                  {"branches", "", {1, 1, 1}}};
      record.curves["tip speed"] = {{"t", "time", {.5, 1.5}}, {"tip speed / c_R", "", {.5, .75}}};
      record.curves["moments"] = {{"t", "time", {0}}};
      record.fields["damage"] = {1, {{.25, .25}, {.75, .25}, {.25, .75}, {.75, .75}}, {0, 0, 0, 0}};
      study::StudyResults results;
      results.analysis = "crack";
      results.records = {record};
      return results;
    }
  } // namespace

  TEST(CrackReport, GivesSpeedAndAdvanceWithUnits)
  {
    EXPECT_EQ(crack_view(moved(scene::CrackOutcome::runs)).answer,
              "At 2 times its threshold the crack runs; its mean speed is 0.5 [length/time], 0.625 "
              "of the "
              "Rayleigh wave speed, at most 0.75 over a tenth of the time for which it moves; the "
              "solution is symmetric to the last bit. This "
              "rests on one "
              "mesh size, h = 0.5: run with another Study/h to see how it depends on h.");
    EXPECT_EQ(
        crack_view(moved(scene::CrackOutcome::arrests)).answer,
        "At 2 times its threshold the crack arrests after its tip advanced by 3 [length], 2 "
        "horizons; the solution is symmetric to the last bit. This rests on one mesh size, h = "
        "0.5: run with another Study/h to see how it depends on h.");
  }

  TEST(CrackReport, SaysOfWhichMeshSizeItsAnswerIsWhereThereAreSeveral)
  {
    study::StudyResults results = moved(scene::CrackOutcome::runs);
    results.records.push_back(results.records.front());
    results.records.back().key.h /= 2;
    const std::string answer = crack_view(results).answer;
    EXPECT_NE(answer.find("This is the result at h = 0.5."), std::string::npos) << answer;
    EXPECT_EQ(answer.find("one mesh size"), std::string::npos) << answer;
  }

  TEST(CrackReport, DrawsTheSpeedWhoseMaximumItsTextGives)
  {
    const auto results = moved(scene::CrackOutcome::runs);
    const DataChart chart = crack_view(results).galleries.at(0).charts.at(1);
    double largest = 0;
    for (const Vertex &one : chart.plot.lines.front().points)
      largest = std::max(largest, one.y);
    EXPECT_EQ(largest, results.records.front()["fastest / c_R"]);
  }

  TEST(CrackReport, HasUnitsOnTheAxesOfItsCharts)
  {
    const View view = crack_view(moved(scene::CrackOutcome::runs));
    const auto &charts = view.galleries.at(0).charts;
    ASSERT_EQ(charts.size(), 3u);
    for (const DataChart &chart : charts)
      EXPECT_TRUE(fixture::has_units(chart.plot)) << chart.name;
    EXPECT_EQ(charts[2].plot.y_label, "energy [force]"); // of a body of thickness 1 [length]
  }
} // namespace plumbline::report
