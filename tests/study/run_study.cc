// An analysis is a few lines: a loop, budget, resume, tables, charts, page, JSON, expectations and
// samples come with it.
#include "base/error.h"
#include "io/results_json.h"
#include "report/view.h"
#include "study/preflight.h"
#include "study/sample_sweep.h"
#include "tests/report/fixture.h"
#include "tests/study/operators.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using report::fixture::Folder;

  /// The smallest sum of a row of A: 0 where a node touches no constrained node.
  Analysis row_sums()
  {
    Analysis analysis{"row-sums", "Row sums"};
    analysis.choose_methods = [](const scene::Scene &scene, const Methods &available, unsigned int,
                                 unsigned int) { return choose_methods(scene, available); };
    analysis.analyse = [](const Place &place, const Method &method)
    {
      Record record = place.record("row-sums", method);
      const auto matrix = method.discretise(place.problem())->matrix();
      double smallest = std::numeric_limits<double>::infinity(), largest = 0;
      for (std::size_t i = 0; i < matrix.rows.n_rows(); ++i)
      {
        double sum = 0;
        for (std::size_t k = matrix.rows.start[i]; k < matrix.rows.start[i + 1]; ++k)
          sum += matrix.rows.value[k];
        smallest = std::min(smallest, sum);
        largest = std::max(largest, sum);
      }
      record.set("smallest row sum", smallest, "b / u");
      record.set("largest row sum", largest, "b / u");
      return Records{record};
    };
    analysis.sampled = {"largest row sum"};
    return analysis;
  }

  Methods available()
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  scene::Scene make_scene(const std::string &more = "")
  {
    return scene::parse_scene("toy.prm", "subsection Problem\n set solution = x\nend\n"
                                         "subsection Methods\n set names = FA, PA-AC\nend\n"
                                         "subsection Study\n set h = 0.25, 0.125, 0.0625\n"
                                         " set m = 2, 3\nend\n" +
                                             more);
  }

  StudyResults run(const scene::Scene &scene, const RunControl &control = {})
  {
    const Analysis analysis = row_sums();
    return run_study(analysis, scene, analysis.choose_methods(scene, available(), 0, 1), control);
  }

  /// Without what clocks say.
  std::string text_of(StudyResults results)
  {
    for (Record &record : results.records)
      record.cost = {};
    return io::to_json(results);
  }
} // namespace

TEST(RunStudy, visits_all_series_levels_and_methods_coarse_to_fine)
{
  const StudyResults results = run(make_scene());
  ASSERT_EQ(results.records.size(), 12u); // two methods, two series, three levels
  EXPECT_TRUE(results.is_complete);
  for (std::size_t i = 0; i < 12; ++i)
  {
    const Key &key = results.records[i].key;
    EXPECT_EQ(key.method, i < 6 ? "FA" : "PA-AC");
    EXPECT_EQ(key.level, i % 3);
    EXPECT_EQ(key.h, .25 / (1u << i % 3));
    EXPECT_NEAR(key.m(), i % 6 < 3 ? 2 : 3, 1e-12);
    // of nodes by the boundary: bonds to the interaction domain; of others none are missing
    EXPECT_GT(results.records[i]["largest row sum"], 1);
  }
  EXPECT_NEAR(results.records[2]["smallest row sum"], 0, 1e-9);
}

TEST(RunStudy, stops_between_methods_and_goes_on_from_records)
{
  unsigned int n_asked = 0, n_made = 0;
  RunControl control;
  control.should_stop = [&] { return ++n_asked > 5; };
  const StudyResults first = run(make_scene(), control);
  EXPECT_FALSE(first.is_complete);
  EXPECT_EQ(first.records.size(), 5u);
  control.should_stop = {};
  control.earlier.records = first.records;
  control.on_made = [&](const StudyResults &made) { n_made += made.records.size(); };
  const StudyResults second = run(make_scene(), control);
  EXPECT_EQ(n_made, 7u);
  EXPECT_EQ(text_of(second), text_of(run(make_scene())));
}

TEST(RunStudy, leaves_out_what_is_expected_to_exceed_the_budget_and_says_so)
{
  Analysis slow = row_sums();
  slow.analyse = [make = slow.analyse](const Place &place, const Method &method)
  {
    Records records = make(place, method);
    records[0].cost.solve_seconds =
        std::pow(8., place.level().h < .2 ? place.level().h < .1 ? 2 : 1 : 0);
    return records;
  };
  const scene::Scene scene = make_scene();
  RunControl control;
  control.budget = 20; // 1 and 8 s, then 64 are expected
  const StudyResults results =
      run_study(slow, scene, slow.choose_methods(scene, available(), 0, 1), control);
  EXPECT_EQ(results.records.size(), 8u);
  ASSERT_EQ(results.left_out.size(), 4u);
  EXPECT_EQ(results.left_out[0], "FA, m = 2, h = 0.0625: some 64 CPU s");
}

TEST(RunStudy, keeps_a_failure_as_a_finding)
{
  Analysis failing = row_sums();
  failing.analyse = [make = failing.analyse](const Place &place, const Method &method)
  {
    if (method.name() == "FA")
      throw NumericalError("no rows");
    return make(place, method);
  };
  const scene::Scene scene = make_scene();
  const StudyResults results =
      run_study(failing, scene, failing.choose_methods(scene, available(), 0, 1));
  EXPECT_EQ(results.records.size(), 12u);
  EXPECT_EQ(results.records[0].failure, "no rows");
  EXPECT_TRUE(results.records[6].failure.empty());
}

TEST(RunStudy, checks_expected_values_of_any_quantity)
{
  const auto expected = [](const std::string &values)
  {
    return run(make_scene("subsection Expected\n set values = " + values + "\nend\n"))
        .expectations.at(0);
  };
  const StudyResults results = run(make_scene());
  std::ostringstream right;
  right.precision(17);
  for (std::size_t i = 3; i < 6; ++i)
    right << ' ' << results.records[i]["largest row sum"];
  EXPECT_TRUE(expected("FA, largest row sum, m = 3:" + right.str()).holds);
  EXPECT_FALSE(expected("FA, largest row sum, m = 2:" + right.str()).holds);
  EXPECT_FALSE(expected("FA, no such sum:" + right.str()).holds);
  // bounds: a number, or another quantity of the same record
  EXPECT_TRUE(expected("FA, smallest row sum: <= largest row sum").holds);
  EXPECT_FALSE(expected("FA, largest row sum: <= smallest row sum").holds);
  EXPECT_FALSE(expected("FA, largest row sum: <= no such sum").holds);
  EXPECT_TRUE(expected("FA, largest row sum, m = 3: <= 1e9").holds);
  EXPECT_FALSE(expected("FA, largest row sum: <= -1").holds);
  EXPECT_EQ(expected("FA, largest row sum: <= 1e9").expected, "<= 1e9");
}

TEST(RunStudy, gives_samples_the_scalars_that_they_count)
{
  const auto cases = sample_study(row_sums(), make_scene(), available());
  ASSERT_EQ(cases.size(), 12u);
  EXPECT_EQ(cases[7].key.method, "PA-AC");
  EXPECT_EQ(cases[7].key.level, 1u);
  EXPECT_EQ(cases[7].scalars.size(), 1u);
  EXPECT_EQ(cases[7]["largest row sum"], run(make_scene()).records[7]["largest row sum"]);
}

TEST(RunStudy, has_tables_charts_a_page_and_a_file_without_code_of_its_own)
{
  const Folder folder;
  const StudyResults results = run(make_scene());
  const report::View view = report::default_view(results);
  report::write_study(view, results, folder.path());
  EXPECT_EQ(view.parts.at(0).table.rows.size(), 12u);
  const std::string page = report::fixture::read(folder.path() / "row-sums.html");
  EXPECT_NE(page.find("largest row sum"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "row-sums/largest-row-sum_m-3.csv"));
  EXPECT_EQ(
      io::to_json(io::from_json(report::fixture::read(folder.path() / "row-sums.json"), "it")),
      io::to_json(results));
  EXPECT_NE(report::study_text(view, results).find("smallest row sum"), std::string::npos);
}
