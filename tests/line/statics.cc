// Static problems on intervals, from the scene to verdicts.
#include "study/statics.h"
#include "base/error.h"
#include "report/maps.h"
#include "scene/on_line.h"
#include "study/preflight.h"
#include "study/statics_on_line.h"
#include "tests/study/operators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using Settings = std::vector<scene::Override>;

  scene::Scene make_scene(const Settings &more)
  {
    std::map<std::string, std::string> all = {{"Domain/dimension", "1"},
                                              {"Domain/boxes", "0 : 1"},
                                              {"Kernel/type", "constant"},
                                              {"Kernel/limit", "-Laplace"},
                                              {"Problem/solution", "x^2*(1 - x)"},
                                              {"Methods/names", "FA"},
                                              {"Study/m", "3"},
                                              {"Study/h", "1/10, 1/20, 1/40, 1/80"},
                                              {"Study/norms", "nodal Linf, averages L2"},
                                              {"Study/decisive error", "nodal Linf | exact"}};
    for (const auto &[key, value] : more)
      all[key] = value;
    Settings settings;
    for (const auto &[key, value] : all)
      if (!value.empty())
        settings.push_back({key, value});
    return scene::parse_scene("line.prm", "", settings);
  }

  Methods available()
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  StudyResults run(const Settings &settings)
  {
    const Methods all = available();
    const scene::Scene scene = make_scene(settings);
    return run_study(statics_analysis(all, {}), scene, choose_methods(scene, all));
  }

  std::string message_of(const Settings &settings)
  {
    try
    {
      (void)choose_methods(make_scene(settings), available());
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_in(const std::string &part, const std::string &text)
  {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
} // namespace

TEST(StaticsOnLine, verdicts_are_those_of_second_moments)
{
  const auto results = run({{"Methods/names", "all, DGQ0, DGQ1, Q2"}});
  std::map<std::string, std::string> verdicts;
  for (const Trend &trend : results.trends)
    if (trend.error == "nodal Linf | exact")
      verdicts[trend.method] = trend.verdict;
  EXPECT_EQ(verdicts.count("OPT"), 0u);
  for (const std::string method : {"FA", "LAMMPS", "QWJ", "PA-AC", "IPA-AC", "DGQ0"})
    EXPECT_EQ(verdicts[method], "not AC") << method;
  for (const std::string method : {"IPA-AC-R2", "IPA-AC-R4", "Q1", "Q2", "DGQ1"})
    EXPECT_EQ(verdicts[method], "AC") << method;
  for (const Record &record : results.records)
  {
    EXPECT_EQ(record.failure, "");
    EXPECT_NEAR(record["area"], 1, 1e-14);
  }
}

TEST(StaticsOnLine, inconsistent_rules_have_the_error_that_their_moment_predicts)
{
  // L_h u = C(m) (-u'') in the limit, so that for u = x (1 - x)/2 with data from u the solution
  // tends to x (1 - x) / (2 C): an error of (1 - 1/C)/8 in the middle
  const auto results = run({{"Problem/solution", "x*(1-x)/2"},
                            {"Methods/names", "FA, PA-AC"},
                            {"Study/h", "1/100, 1/200, 1/400"}});
  for (const Record &record : results.records)
    if (record.key.level == 2)
    {
      const double C = record.key.method == "FA" ? 14. / 9 : 19. / 18; // m = 3
      EXPECT_NEAR(record["nodal Linf | exact"] / ((1 - 1 / C) / 8), 1, .02) << record.key.method;
    }
}

TEST(StaticsOnLine, quadratics_are_exact_where_they_must_be)
{
  for (const std::string kernel : {"constant", "1/r", "conical"})
    for (const auto &record : run({{"Problem/solution", "3*x^2 - x + 2"},
                                   {"Kernel/type", kernel},
                                   {"Methods/names", "IPA-AC-R2, Q1, Q2, Q3, DGQ2"},
                                   {"Study/h", "1/10, 1/20"}})
                                  .records)
      EXPECT_LT(record["nodal Linf | exact"], 1e-10) << record.key.method << ", " << kernel;
}

// ln(x + .2) is defined within the horizon of .15 around the interval, not within .2.
TEST(StaticsOnLine, constraints_are_asked_for_within_the_horizon_alone)
{
  for (const Record &record : run({{"Problem/solution", "ln(x + 0.2)"},
                                   {"Study/h", "1/20"},
                                   {"Study/m", "3"},
                                   {"Methods/names", "FA, IPA-AC-R2, Q1, DGQ0"}})
                                  .records)
    EXPECT_EQ(record.failure, "") << record.key.method;
}

// At first errors fall as the layer at the ends does, from the other side: 1 - 1/C(m) of them
// stays.
TEST(StaticsOnLine, an_error_as_large_as_its_moment_makes_it_is_not_hidden)
{
  const auto verdict = [](const std::string &h)
  {
    for (const Trend &trend : run({{"Problem/solution", ""},
                                   {"Problem/load", "1"},
                                   {"Problem/constraint", "0"},
                                   {"Problem/local solution", "x*(1 - x)/2"},
                                   {"Study/h", h},
                                   {"Methods/names", "PA-AC"},
                                   {"Study/norms", "nodal Linf"},
                                   {"Study/decisive error", "nodal Linf | local"}})
                                  .trends)
      return trend.verdict;
    return std::string();
  };
  EXPECT_EQ(verdict("1/10, 1/20, 1/40, 1/80"), "undecided");
  EXPECT_EQ(verdict("1/10, 1/20, 1/40, 1/80, 1/160, 1/320, 1/640"), "not AC");
}

TEST(StaticsOnLine, smooth_solutions_converge_with_rate_two)
{
  const auto results = run({{"Problem/solution", "sin(3*x)"},
                            {"Methods/names", "IPA-AC-R2, Q1, DGQ1"},
                            {"Domain/boxes", "0 : 1; 3/2 : 2"}}); // two intervals
  std::map<std::string, std::vector<double>> errors;
  for (const Record &record : results.records)
  {
    errors[record.key.method].push_back(record["averages L2 | exact"]);
    EXPECT_NEAR(record["area"], 1.5, 1e-14);
  }
  for (const auto &[method, found] : errors)
    EXPECT_NEAR(std::log2(found[2] / found[3]), 2, .25) << method;
}

TEST(StaticsOnLine, backends_agree)
{
  std::map<std::string, double> found;
  for (const std::string backend : {"direct", "fft"})
    for (const auto &record :
         run({{"Solver/operator", backend}, {"Methods/names", "FA"}, {"Study/h", "1/64"}}).records)
      found[backend] = record["nodal Linf | exact"];
  EXPECT_NEAR(found["direct"], found["fft"], 1e-11);
  EXPECT_GT(found["fft"], 1e-3);
}

TEST(StaticsOnLine, references_have_estimates_that_are_bounds)
{
  const auto results = run({{"Problem/solution", "exp(2*x)"},
                            {"Methods/names", "IPA-AC-R2"},
                            {"Reference/method", "Q1"},
                            {"Study/norms", "averages L2"},
                            {"Study/decisive error", "averages L2 | reference"},
                            {"Study/h", "1/20, 1/40"}});
  ASSERT_EQ(results.references.size(), 2u);
  const auto direct = run({{"Problem/solution", "exp(2*x)"},
                           {"Methods/names", "Q1"},
                           {"Study/norms", "averages L2"},
                           {"Study/decisive error", "averages L2 | exact"},
                           {"Study/h", "1/20, 1/40"}});
  for (unsigned int i = 0; i < 2; ++i)
  {
    const double error = direct.records[i]["averages L2 | exact"];
    EXPECT_GT(results.references[i].estimate, error);
    EXPECT_LT(results.references[i].estimate, 20 * error);
  }
}

TEST(StaticsOnLine, pictures_are_curves)
{
  const auto results = run({{"Study/h", "1/10, 1/20"}});
  ASSERT_EQ(results.maps.size(), 1u);
  EXPECT_EQ(results.maps[0].n_x, 20u);
  const std::string script = report::solution_script(results.maps[0], "u.svg");
  expect_in("x [length]", script);
  EXPECT_EQ(script.find("palette"), std::string::npos);
  expect_in("x [length]", report::map_script(results.maps, "e.svg"));
}

TEST(StaticsOnLine, errors_that_are_zero_everywhere_are_drawn)
{
  const auto results = run({{"Study/h", "1/10, 1/20"},
                            {"Problem/solution", ""},
                            {"Problem/load", "1"},
                            {"Problem/constraint", "0"},
                            {"Methods/names", "Q1"},
                            {"Reference/method", "Q1"},
                            {"Study/norms", "averages L2"},
                            {"Study/decisive error", "averages L2 | reference"}});
  ASSERT_EQ(results.maps.size(), 1u);
  const std::string script = report::map_script(results.maps, "e.svg");
  expect_in("x [length]", script);
  EXPECT_EQ(script.find("logscale y"), std::string::npos);
}

TEST(StaticsOnLine, refuses_what_a_line_does_not_have)
{
  const std::map<std::string, std::pair<Settings, std::string>> refused = {
      {"two coordinates", {{{"Domain/boxes", "0, 0 : 1, 1"}}, "write 'x0 : x1', such as '0 : 1'"}},
      {"a line in the plane", {{{"Domain/dimension", "2"}}, "write Domain/dimension = 1"}},
      {"an empty interval", {{{"Domain/boxes", "1 : 0"}}, "x0 < x1"}},
      {"holes", {{{"Domain/holes", "1/4 : 1/2"}}, "Domain/holes"}},
      {"no divisor", {{{"Study/h", "0.3"}}, "whole cells"}},
      {"gmsh", {{{"Domain/mesh", "body.geo"}}, "write lattice"}},
      {"scattered nodes", {{{"Methods/perturbation", "0.2"}}, "Methods/perturbation = 0"}},
      {"tensors",
       {{{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}}, "write a scalar kernel"}},
      {"solids",
       {{{"Material/model", "LPS"},
         {"Kernel/type", "1/r"},
         {"Kernel/limit", "Navier"},
         {"Material/E", "1"},
         {"Material/nu", "0.2"}},
        "Domain/dimension = 1 does not support Material/model = LPS"}},
      {"fracture",
       {{{"Domain/cracks", "0.2, 0.1 : 0.3, 0.4"}}, "Domain/cracks and Domain/outside"}},
      {"time", {{{"Time/final time", "1"}}, "transient analyses"}},
      {"free ends", {{{"Domain/boundary", "free"}}, "write constrained"}},
      {"y", {{{"Problem/solution", "x*y"}}, "depends on y"}},
      {"a rule", {{{"Methods/names", "OPT"}}, "not integrable in one dimension"}},
      {"triangles", {{{"Methods/names", "P1"}}, "its cells are triangles (Domain/dimension = 1)"}},
      {"norms", {{{"Study/norms", "nodal Linf, truncation L2"}}, "nodal or averages norms"}},
      {"fields",
       {{{"Study/norms", "field L2"}, {"Study/decisive error", "field L2 | exact"}},
        "write a nodal or averages norm"}}};
  for (const auto &[what, given] : refused)
    expect_in(given.second, message_of(given.first));
}

TEST(StaticsOnLine, other_analyses_say_why_they_cannot)
{
  for (const scene::Analysis analysis :
       {scene::Analysis::stability, scene::Analysis::dispersion, scene::Analysis::check})
    try
    {
      check_analysis(make_scene(Settings{}), analysis);
      ADD_FAILURE();
    }
    catch (const InputError &error)
    {
      expect_in("static analyses of scalar kernels on intervals", error.what());
    }
  // of the plane, as samples are
  EXPECT_THROW((void)make_problem(make_scene(Settings{}), 0, {.1, .3}), InputError);
}
