// What tables, charts and pages show of a study over a variable of the scene.

#include "io/results_json.h"
#include "report/tables.h"
#include "report/view.h"
#include "scene/scene_file.h"
#include "study/stability.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    /// One method at two values that straddle 0.
    study::StudyResults over_q()
    {
      study::StudyResults results;
      results.regime = scene::Regime::variable;
      results.variable = "q";
      results.decisive_error = "nodal L2 | exact";
      study::Trend trend;
      trend.method = "FA";
      trend.problem = "case1";
      trend.series = "h = 0.1, m = 3";
      trend.error = results.decisive_error;
      trend.axis = study::Axis::variable;
      for (const double q : {-.5, .5})
      {
        study::Record run;
        run.key.method = "FA";
        run.key.problem = trend.problem;
        run.key.series = trend.series;
        run.key.level = q < 0 ? 0 : 1;
        run.key.h = .1;
        run.key.horizon = .3;
        run.key.value = q;
        run.cost.solve_seconds = .5;
        run.set(results.decisive_error, .02 + .01 * q);
        trend.x.push_back(q);
        trend.values.push_back(.02 + .01 * q);
        results.records.push_back(run);
      }
      results.trends = {trend};
      results.advice = {{"case1", trend.series, {}, {}, {}}};
      return results;
    }

    std::vector<std::string> heads(const Table &table)
    {
      std::vector<std::string> all;
      for (const Column &column : table.columns)
        all.push_back(column.head);
      return all;
    }

    using Heads = std::vector<std::string>;
  } // namespace

  TEST(ReportOverAVariable, HasItsValuesInTablesAndNoRates)
  {
    study::StudyResults results = over_q();
    const Table errors = error_table(results, cases(results).front());
    EXPECT_EQ(heads(errors), (Heads{"level", "h", "δ", "m", "q", "FA"}));
    ASSERT_EQ(errors.rows.size(), 2u);
    EXPECT_EQ(errors.rows[0][4].text, "-0.5");
    EXPECT_EQ(errors.rows[1][5].text, "2.500e-2");
    results.records[1].failure = "none";
    EXPECT_EQ(failure_table(results).rows.at(0)[6].text, "0.5");
    EXPECT_EQ(heads(failure_table(results))[6], "q");
    results.variable.clear();
    EXPECT_EQ(heads(failure_table(results))[6], "why");
  }

  TEST(ReportOverAVariable, DrawsErrorsOverIt)
  {
    const fixture::Folder folder;
    const study::StudyResults results = over_q();
    write_study(statics_view(results), results, folder.path());
    const std::string chart = "convergence_case1_h-0.1-m-3";
    EXPECT_TRUE(holds(fixture::read(folder.path() / "charts" / (chart + ".csv")),
                      "FA,case1,\"h = 0.1, m = 3\",0,-0.5,0.014999999999999999\n"));
    const std::string svg = fixture::read(folder.path() / "charts" / (chart + ".svg"));
    EXPECT_TRUE(holds(svg, "error over q"));
    EXPECT_TRUE(holds(svg, ">-0.2<")); // an axis that holds it is linear
    const std::string page = fixture::read(folder.path() / "report.html");
    EXPECT_TRUE(holds(page, "Largest error over all values of q and problems, the best method "
                            "first: FA (2.500e-2)."));
    EXPECT_TRUE(holds(page, "h and δ are fixed and q varies"));
    EXPECT_TRUE(holds(page, "the largest error over the values of q"));
    EXPECT_FALSE(holds(page, "one finer level would help"));
  }

  TEST(ReportOverAVariable, StandsOnALogarithmicAxisWhereItGrowsEightfold)
  {
    using study::Axis;
    EXPECT_TRUE(is_logarithmic(Axis::variable, {.1, .8}));
    EXPECT_FALSE(is_logarithmic(Axis::variable, {.1, .79}));
    EXPECT_FALSE(is_logarithmic(Axis::variable, {-.1, 8}));
    EXPECT_TRUE(is_logarithmic(Axis::mesh_size, {.1, .05}));
  }

  TEST(ReportOverAVariable, IsReadBack)
  {
    const study::StudyResults read = io::from_json(io::to_json(over_q()), "a file");
    EXPECT_EQ(read.variable, "q");
    EXPECT_EQ(read.records[0].key.value, -.5);
    EXPECT_EQ(read.trends[0].axis, study::Axis::variable);
    EXPECT_EQ(read.trends[0].x[0], -.5); // no length
  }

  TEST(ReportOverAVariable, HasItInMeasuresAndTransientAnalyses)
  {
    study::StudyResults stability;
    stability.variable = "q";
    for (const double q : {-.5, .5})
    {
      study::Record place;
      place.key.method = "FA";
      place.key.series = "h = 0.1, m = 3";
      place.key.h = .1;
      place.key.horizon = .3;
      place.key.value = q;
      study::Stability measured;
      measured.n_unknowns = 9;
      measured.smallest = 2 + q;
      measured.largest = 4;
      stability.records.push_back(study::stability_record(place, measured, {}, {}));
    }
    const auto measures = [&] { return stability_view(stability).parts.at(0).table; };
    EXPECT_EQ(heads(measures())[3], "q");
    EXPECT_EQ(measures().rows[1][3].text, "0.5");
    stability.powers = study::stability_powers(stability.records);
    EXPECT_TRUE(power_table(stability).rows.empty()); // of lengths alone
    const auto verdict = study::judge_stability(stability.records, "q");
    EXPECT_TRUE(holds(verdict.explanation, "h = 0.1, q = -0.5")) << verdict.explanation;
    stability.variable.clear();
    EXPECT_NE(heads(measures())[3], "q");

    study::StudyResults transient;
    transient.variable = "q";
    transient.records.resize(2);
    transient.records[1].key.value = .5;
    const auto runs = [&]
    {
      for (const Part &part : dynamics_view(transient).parts)
        if (part.id == "runs")
          return heads(part.table);
      return Heads();
    };
    const Heads with = runs();
    EXPECT_NE(std::find(with.begin(), with.end(), "q"), with.end());
    transient.variable.clear();
    transient.records[1].key.value = 0;
    const Heads without = runs();
    EXPECT_EQ(without.size() + 1, with.size());
  }
} // namespace plumbline::report
