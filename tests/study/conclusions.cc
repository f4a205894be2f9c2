// What is concluded from runs: doubt, jitter, expectations, the cheapest run. Tables of errors and
// costs as a sweep leaves them, and the answer that each of them deserves.
#include "study/conclusions.h"
#include "study/cheapest.h"
#include "study/solution_record.h"
#include "study/weigh_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  const std::string against_exact = "averages L2 | exact",
                    against_reference = "averages L2 | reference";
  const std::vector<double> h = {.2, .1, .05, .025};

  /// Two cases at m = 2 and 3 over four levels.
  scene::Scene make_scene(const std::string &decisive, const std::string &expected = "")
  {
    return scene::parse_scene(
        "test.prm",
        "subsection Problem\n set solution = one: x^3; two: y^3\nend\n"
        "subsection Methods\n set names = A, B\nend\n"
        "subsection Reference\n set method = Q2\nend\n"
        "subsection Study\n set regime = delta\n set m = 2, 3\n set h = 0.2, 0.1, 0.05, 0.025\n"
        " set norms = averages L2\n set decisive error = " +
            decisive + "\nend\nsubsection Expected\n" + expected + "\nend\n");
  }

  StudyResults make_results(const scene::Scene &scene)
  {
    StudyResults results;
    results.regime = scene::Regime::delta;
    results.decisive_error = scene.study.decisive_error.text();
    results.is_complete = true;
    return results;
  }

  /// The runs of one method, case and series; an error that is no number: no solution there.
  void add_runs(StudyResults &results, const std::string &method, const std::vector<double> &errors,
                const std::string &problem = "one", const std::string &series = "m = 2")
  {
    for (unsigned int level = 0; level < errors.size(); ++level)
    {
      Record run;
      run.key.method = method;
      run.key.family = study::MethodFamily::meshfree;
      run.key.problem = problem;
      run.key.series = series;
      run.key.level = level;
      run.key.h = h[level];
      run.key.horizon = (series == "m = 2" ? 2 : 3) * h[level];
      run.set("variation", 1);
      if (std::isnan(errors[level]))
        run.failure = "no solution";
      else
        run.set(results.decisive_error, errors[level]);
      results.records.push_back(run);
    }
  }

  /// How far the reference of one case and series may be wrong, level by level.
  void add_reference(StudyResults &results, const std::vector<double> &estimates,
                     const std::string &problem = "one", const std::string &series = "m = 2")
  {
    for (unsigned int level = 0; level < estimates.size(); ++level)
    {
      ErrorEstimate estimate;
      estimate.method = "Q2";
      estimate.problem = problem;
      estimate.series = series;
      estimate.level = level;
      estimate.h = h[level];
      estimate.estimate = estimates[level];
      results.references.push_back(estimate);
    }
  }

  const Trend &trend_of(const StudyResults &results, const std::string &method,
                        const std::string &problem = "one", const std::string &series = "m = 2")
  {
    const auto found = std::find_if(results.trends.begin(), results.trends.end(),
                                    [&](const Trend &trend)
                                    {
                                      return trend.method == method && trend.problem == problem &&
                                             trend.series == series &&
                                             trend.error == results.decisive_error;
                                    });
    EXPECT_NE(found, results.trends.end()) << method;
    return *found;
  }

  const std::vector<double> second_order = {8e-2, 2e-2, 5e-3, 1.25e-3};
  const std::vector<double> stalled = {5.2e-2, 5.05e-2, 5.01e-2, 5.003e-2};
} // namespace

// ---- doubt --------------------------------------------------------------------------------------

TEST(Conclusions, a_difference_below_ten_estimates_of_the_reference_decides_nothing)
{
  struct Doubt
  {
    std::vector<double> estimates; ///< of the reference, coarse to fine
    Outcome outcome;
  };
  // the last difference is 1.25e-3
  const std::vector<Doubt> table = {
      {{1e-6, 1e-6, 1e-6, 1e-6}, Outcome::converges},
      {{1e-6, 1e-6, 1e-6, 1.2e-4}, Outcome::converges},
      {{1e-6, 1e-6, 1e-6, 1.3e-4}, Outcome::undecided},
      {{1e-6, 1e-6, 1e-6, 1e-2}, Outcome::undecided},
      {{1e-2, 1e-3, 5e-4, 1e-5}, Outcome::converges}, // that of the finest level counts
      {{}, Outcome::converges}};
  const auto scene = make_scene(against_reference);
  for (const Doubt &row : table)
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", second_order);
    add_reference(results, row.estimates);
    // of others, which say nothing about this one
    add_reference(results, std::vector<double>(4, 1), "two");
    add_reference(results, std::vector<double>(4, 1), "one", "m = 3");
    conclude(scene, results);
    EXPECT_EQ(trend_of(results, "A").outcome, row.outcome)
        << (row.estimates.empty() ? 0 : row.estimates.back());
  }
}

TEST(Conclusions, a_reference_casts_no_doubt_on_errors_against_an_exact_solution)
{
  const auto scene = make_scene(against_exact);
  StudyResults results = make_results(scene);
  add_runs(results, "A", second_order);
  add_reference(results, std::vector<double>(4, 1));
  conclude(scene, results);
  EXPECT_EQ(trend_of(results, "A").outcome, Outcome::converges);
}

TEST(Conclusions, a_stall_below_the_estimate_of_the_reference_is_in_doubt_too)
{
  const auto scene = make_scene(against_reference);
  for (const auto &[estimate, outcome] :
       {std::pair{1e-3, Outcome::stalls}, {1e-2, Outcome::undecided}})
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", stalled);
    add_reference(results, std::vector<double>(4, estimate));
    conclude(scene, results);
    EXPECT_EQ(trend_of(results, "A").outcome, outcome) << estimate;
  }
}

TEST(Conclusions, a_method_that_fails_at_one_level_has_failed)
{
  const auto scene = make_scene(against_exact);
  for (unsigned int level = 0; level < h.size(); ++level)
  {
    StudyResults results = make_results(scene);
    auto errors = second_order;
    errors[level] = std::nan("");
    add_runs(results, "A", errors);
    conclude(scene, results);
    EXPECT_EQ(trend_of(results, "A").outcome, Outcome::failed) << level;
    EXPECT_EQ(trend_of(results, "A").verdict, "failed") << level;
    EXPECT_EQ(trend_of(results, "A").reason, "no solution") << level;
  }
}

// ---- expectations -------------------------------------------------------------------------------

namespace
{
  /// The one expectation of a scene, of a method with these errors.
  Expectation expectation(const std::string &expected, const std::vector<double> &errors)
  {
    const auto scene = make_scene(against_exact, expected);
    StudyResults results = make_results(scene);
    add_runs(results, "A", errors);
    conclude(scene, results);
    EXPECT_EQ(results.expectations.size(), 1u) << expected;
    return results.expectations.front();
  }

  bool holds(const std::string &expected, const std::vector<double> &errors)
  {
    return expectation(expected, errors).holds;
  }
} // namespace

TEST(Conclusions, jitter_is_the_sum_of_all_rises_over_the_first_error)
{
  const std::vector<double> ragged = {1e-1, 1.2e-1, 5e-2, 8e-2}; // rises .02 and .03: .5
  EXPECT_TRUE(holds(" set jitter = A: 0.49 0.51", ragged));
  EXPECT_FALSE(holds(" set jitter = A: 0.29 0.31", ragged)); // the largest alone
  EXPECT_FALSE(holds(" set jitter = A: 0.1 0.4", ragged));
  EXPECT_FALSE(holds(" set jitter = A: 0.6 0.9", ragged));
  EXPECT_TRUE(holds(" set jitter = A: 0 0.01", second_order)); // falls are no rises
}

TEST(Conclusions, expected_errors_hold_within_their_tolerance_at_every_level)
{
  const std::string close = " set error tolerance = 0.01\n set errors = A: ";
  EXPECT_TRUE(holds(close + "8.05e-2 1.99e-2 5e-3 1.25e-3", second_order));
  EXPECT_FALSE(holds(close + "8.2e-2 2e-2 5e-3 1.25e-3", second_order));
  EXPECT_FALSE(holds(close + "8e-2 2e-2 5e-3 1.22e-3", second_order));
  EXPECT_FALSE(holds(close + "8e-2 2e-2", second_order)); // more levels than expected
  EXPECT_TRUE(holds(close + "8e-2 2e-2 5e-3 1.25e-3 3.1e-4", second_order)); // a shortened sweep
}

TEST(Conclusions, expected_rates_hold_from_both_sides)
{
  const std::string close = " set rate tolerance = 0.1\n set rates = A: ";
  EXPECT_TRUE(holds(close + "2", second_order));
  EXPECT_TRUE(holds(close + "1.95", second_order));
  EXPECT_FALSE(holds(close + "1.8", second_order));
  EXPECT_FALSE(holds(close + "2.2", second_order));
}

TEST(Conclusions, an_expected_bound_is_on_the_largest_error)
{
  const std::vector<double> hump = {1e-2, 3e-2, 1e-3, 1e-4};
  EXPECT_TRUE(holds(" set bounds = A: 3.1e-2", hump));
  EXPECT_FALSE(holds(" set bounds = A: 2e-2", hump));
  EXPECT_FALSE(holds(" set bounds = A: 1", {1e-2, 1e-3, std::nan(""), 1e-4}));
}

TEST(Conclusions, an_expected_fall_is_at_every_level)
{
  EXPECT_TRUE(holds(" set monotone = A: yes", second_order));
  EXPECT_TRUE(holds(" set monotone = A: no", {1e-2, 1e-3, 1.1e-3, 1e-4}));
  EXPECT_FALSE(holds(" set monotone = A: yes", {1e-2, 1e-3, 1.1e-3, 1e-4}));
}

TEST(Conclusions, an_expectation_that_levels_are_missing_for_says_so)
{
  const auto found = [](const std::vector<double> &errors)
  {
    const Expectation found = expectation(" set verdicts = A: AC", errors);
    EXPECT_FALSE(found.holds);
    return found.found;
  };
  const std::string told = "were left out, for example by --levels";
  EXPECT_NE(found({1e-1, 5e-2}).find(told), std::string::npos) << found({1e-1, 5e-2});
  const std::vector<double> stalls = {1e-1, 1e-1, 1e-1, 1e-1};
  EXPECT_EQ(found(stalls).find(told), std::string::npos) << found(stalls);
}

TEST(Conclusions, an_expectation_of_what_was_not_run_does_not_hold)
{
  EXPECT_FALSE(holds(" set verdicts = C: AC", second_order));
  EXPECT_FALSE(holds(" set verdicts = A, two: AC", second_order));
  EXPECT_FALSE(holds(" set verdicts = A, m = 3: AC", second_order));
  EXPECT_TRUE(holds(" set verdicts = A, one, m = 2: AC", second_order));
  EXPECT_FALSE(holds(" set verdicts = A: not AC", second_order));

  const auto found = [](const std::string &expected)
  { return expectation(" set verdicts = " + expected, second_order).found; };
  EXPECT_EQ(found("C: AC"), "the method was not run (left out, for example, by --methods)");
  EXPECT_EQ(found("A, two: AC"), "no such case or series was run");
}

// ---- advice -------------------------------------------------------------------------------------

namespace
{
  /// Setup and solve of the runs of a method, each level four times the one before [CPU s].
  void set_cost(StudyResults &results, const std::string &method, double setup, double solve)
  {
    for (Record &run : results.records)
      if (run.key.method == method)
      {
        run.cost.setup_seconds = setup * std::pow(4., run.key.level);
        run.cost.solve_seconds = solve * std::pow(4., run.key.level);
      }
  }

  /// What is advised for case one at m = 2: method and h by target.
  std::map<double, std::pair<std::string, double>> advised(const StudyResults &results)
  {
    std::map<double, std::pair<std::string, double>> choices;
    for (const Advice &advice : results.advice)
      if (advice.problem == "one" && advice.series == "m = 2")
        for (const Choice &choice : advice.choices)
          choices[choice.target] = {choice.method, choice.h};
    return choices;
  }
} // namespace

TEST(Conclusions, the_cheapest_run_is_by_setup_and_solve_together)
{
  const auto scene = make_scene(against_exact);
  for (const bool is_solve_dear : {false, true})
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", second_order);
    add_runs(results, "B", second_order);
    set_cost(results, "A", is_solve_dear ? 1 : 5, is_solve_dear ? 5 : 1);
    set_cost(results, "B", 2, 2);
    conclude(scene, results);
    const auto choices = advised(results);
    ASSERT_EQ(choices.count(1e-2), 1u);
    EXPECT_EQ(choices.at(1e-2), std::pair(std::string("B"), .05));
    for (const Advice &advice : results.advice)
      for (const Choice &choice : advice.choices)
        EXPECT_EQ(choice.seconds, (2 + 2) * 16);
  }
}

TEST(Conclusions, costs_within_a_fifth_are_a_tie_that_fewer_unknowns_and_then_names_break)
{
  struct Row
  {
    double seconds_a, seconds_b; ///< at the level that reaches the target
    std::size_t unknowns_a, unknowns_b;
    std::string named;
    std::vector<std::string> tied;
  };
  const std::vector<Row> table = {
      {1., 1.19, 100, 400, "A", {"B"}}, {1., 1.19, 400, 100, "B", {"A"}},
      {1.19, 1., 100, 400, "A", {"B"}}, // whoever was faster this time
      {1.19, 1., 400, 100, "B", {"A"}}, {1.19, 1., 100, 100, "A", {"B"}},     // by name
      {1., 1.21, 400, 100, "A", {}},                                          // clearly cheaper
      {1.21, 1., 100, 400, "B", {}},    {1e-4, 2.6e-4, 400, 100, "B", {"A"}}, // .16 ms are noise
      {1e-4, 2.8e-4, 400, 100, "A", {}}};
  const auto scene = make_scene(against_exact);
  for (const Row &row : table)
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", second_order);
    add_runs(results, "B", second_order);
    set_cost(results, "A", row.seconds_a / 16, 0);
    set_cost(results, "B", row.seconds_b / 16, 0);
    for (study::Record &run : results.records)
      run.cost.n_unknowns = run.key.method == "A" ? row.unknowns_a : row.unknowns_b;
    conclude(scene, results);
    ASSERT_FALSE(results.advice.front().choices.empty());
    const Choice &choice = results.advice.front().choices.front();
    EXPECT_EQ(choice.method, row.named) << row.seconds_a << ' ' << row.seconds_b;
    EXPECT_EQ(choice.tied, row.tied) << row.seconds_a << ' ' << row.seconds_b;
    EXPECT_DOUBLE_EQ(choice.seconds, row.named == "A" ? row.seconds_a : row.seconds_b);
  }
}

TEST(Conclusions, a_method_does_not_tie_with_another_level_of_its_own)
{
  const auto scene = make_scene(against_exact);
  StudyResults results = make_results(scene);
  add_runs(results, "A", {9e-3, 2e-3, 5e-4, 1.25e-4}); // each level is accurate enough
  for (study::Record &run : results.records)
  {
    run.cost.solve_seconds = 1 - .01 * run.key.level;
    run.cost.n_unknowns = 100 << run.key.level;
  }
  conclude(scene, results);
  const Choice &choice = results.advice.front().choices.front();
  EXPECT_EQ(choice.h, h[0]); // alike in cost, with fewer unknowns
  EXPECT_TRUE(choice.tied.empty());
}

TEST(Conclusions, the_cheapest_run_meets_its_target)
{
  const auto scene = make_scene(against_exact);
  StudyResults results = make_results(scene);
  add_runs(results, "A", {8e-2, 2e-2, 5e-3, 1.25e-3}); // cheap, but never at 1e-4
  add_runs(results, "B", {8e-3, 5e-4, 3.1e-5, 2e-6});
  set_cost(results, "A", 1, 1);
  set_cost(results, "B", 50, 50);
  conclude(scene, results);
  const auto choices = advised(results);
  ASSERT_EQ(choices.size(), 2u); // none reaches 1e-6
  EXPECT_EQ(choices.at(1e-2), std::pair(std::string("A"), .05));
  EXPECT_EQ(choices.at(1e-4), std::pair(std::string("B"), .05));
}

TEST(Conclusions, a_reference_with_one_digit_or_none_gives_one_warning)
{
  const auto scene = make_scene(against_exact);
  for (const unsigned int digits : {0u, 1u, 2u})
    for (const std::string method : {"Q2", "P2", "DGQ1"})
    {
      StudyResults results = make_results(scene);
      add_runs(results, "A", second_order);
      add_reference(results, {1e-1, 1e-2});
      for (study::ErrorEstimate &one : results.references)
      {
        one.method = method;
        one.certified_digits = one.level == 0 ? 0 : digits;
      }
      conclude(scene, results);
      conclude(scene, results); // as an earlier run is taken up
      ASSERT_EQ(results.warnings.size(), digits < 2 ? 1u : 0u) << digits;
      if (digits == 2)
        continue;
      const std::string &warning = results.warnings[0];
      EXPECT_EQ(warning.find("the reference " + method + " of one, m = 2 has " +
                             (digits == 0 ? "no" : "1") + " certified digit"),
                0u)
          << warning;
      const std::string advised = method == "Q2" ? "DGQ1" : method == "P2" ? "DGP1" : "degree";
      EXPECT_NE(warning.find(advised), std::string::npos) << warning;
    }
}

// In a unit of 1e-9, and by an L2 norm on a domain of 1e-6 x 1e-6, errors are 1e-15 times as large.
TEST(Conclusions, a_reference_on_a_mesh_whose_quadrature_is_not_refined_is_told_so)
{
  const auto advised = [](double tolerance)
  {
    auto scene = make_scene(against_exact);
    scene.domain.mesh.name = "squares";
    scene.quadrature.tolerance = tolerance;
    StudyResults results = make_results(scene);
    add_runs(results, "A", second_order);
    add_reference(results, {1e-1, 1e-2});
    conclude(scene, results);
    return results.warnings.at(0).find("Quadrature/tolerance above 0") != std::string::npos;
  };
  EXPECT_TRUE(advised(0));
  EXPECT_FALSE(advised(1e-3));
}

TEST(Conclusions, targets_are_relative_to_the_solution)
{
  const auto scene = make_scene(against_exact);
  for (const auto &[size, side] : {std::pair(1e-9, 1.), std::pair(1e6, 1.), std::pair(1e-9, 1e-6)})
  {
    StudyResults results = make_results(scene);
    std::vector<double> errors = {8e-2, 2e-2, 5e-3, 1.25e-3};
    for (double &error : errors)
      error *= size * side;
    add_runs(results, "A", errors);
    for (study::Record &run : results.records)
    {
      run.set("variation", size);
      run.set("area", side * side, "length^2");
      run.set("round-off", 1e-13 * size);
    }
    conclude(scene, results);
    const auto choices = advised(results);
    ASSERT_EQ(choices.size(), 1u) << size << ' ' << side;
    EXPECT_EQ(choices.at(1e-2), std::pair(std::string("A"), .05));
    const Advice &advice = results.advice.front();
    EXPECT_NE(words_of(results, advice, advice.choices.front()).find("relative error 0.005,"),
              std::string::npos)
        << words_of(results, advice, advice.choices.front());
    ASSERT_FALSE(results.trends.empty());
    EXPECT_EQ(results.trends[0].outcome, Outcome::converges) << results.trends[0].reason;
    EXPECT_DOUBLE_EQ(results.trends[0].size, size * side);
    EXPECT_DOUBLE_EQ(results.trends[0].round_off, 1e-13 * size * side);
  }
}

TEST(Conclusions, advice_names_methods_that_converge_by_the_decisive_error_alone)
{
  const auto scene = make_scene(against_exact);
  const std::vector<double> ragged = {9e-3, 6e-3, 3e-3, 2.5e-3};
  StudyResults results = make_results(scene);
  add_runs(results, "A", second_order);
  add_runs(results, "stalls", {9.2e-3, 9.05e-3, 9.01e-3, 9.003e-3});
  add_runs(results, "ragged", ragged);
  add_runs(results, "fails", {8e-3, 2e-3, std::nan(""), 1e-4});
  set_cost(results, "A", 50, 50);            // all others would be cheaper
  for (study::Record &run : results.records) // by another error all of them converge
    if (run.failure.empty())
      run.set("averages Linf | exact", second_order[run.key.level]);
  conclude(scene, results);
  const auto choices = advised(results);
  ASSERT_EQ(choices.count(1e-2), 1u);
  EXPECT_EQ(choices.at(1e-2), std::pair(std::string("A"), .05));
  const auto advice =
      std::find_if(results.advice.begin(), results.advice.end(),
                   [](const Advice &one) { return one.problem == "one" && one.series == "m = 2"; });
  ASSERT_NE(advice, results.advice.end());
  EXPECT_EQ(advice->stalling, std::vector<std::string>{"stalls"});
}

// ---- proof beside observation -------------------------------------------------------------------

namespace
{
  void prove(StudyResults &results, const std::string &method, LimitProof::Answer answer,
             double defect)
  {
    for (Record &run : results.records)
      if (run.key.method == method)
      {
        LimitProof limit;
        limit.answer = answer;
        limit.defect = defect;
        limit.reason = "by this test";
        set_limit(run, limit);
      }
  }
} // namespace

TEST(Conclusions, a_field_that_hides_wrong_moments_proves_nothing)
{
  using Answer = LimitProof::Answer;
  struct Row
  {
    Answer answer;
    double defect;
    std::vector<double> errors;
    std::string verdict, reason;
    bool is_advised;
  };
  const std::vector<Row> table = {
      {Answer::compatible, 1e-14, second_order, "AC", "proven: by", true},
      {Answer::incompatible, .04, second_order, "AC for this field only", "other fields", false},
      {Answer::incompatible, .04, stalled, "not AC", "proven: by", false},
      {Answer::compatible, 1e-14, stalled, "not AC", "look at load", false},
      {Answer::unknown, 0, second_order, "AC", "not proven: by", true},
      {Answer::unknown, .1, second_order, "AC", "not proven: by", false}}; // scattered, no bias
  const auto scene = make_scene(against_exact);
  for (const Row &row : table)
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", row.errors);
    prove(results, "A", row.answer, row.defect);
    conclude(scene, results);
    const Trend &trend = trend_of(results, "A");
    EXPECT_EQ(trend.verdict, row.verdict);
    EXPECT_NE(trend.reason.find(row.reason), std::string::npos) << trend.reason;
    EXPECT_EQ(advised(results).count(1e-2), row.is_advised ? 1u : 0u) << row.verdict;
  }
}

TEST(Conclusions, a_proof_settles_what_errors_leave_open)
{
  using Answer = LimitProof::Answer;
  const std::vector<double> plateau_or_root = {6e-2, 2.6e-2, 1.5e-2, 1e-2};
  const std::vector<double> sure_rate = {2.622e-2, 4.216e-3, 8.83e-4, 2.02e-4}; // 2.6 to 2.1
  struct Row
  {
    Answer answer;
    std::vector<double> errors;
    Outcome outcome;
  };
  const std::vector<Row> table = {{Answer::unknown, plateau_or_root, Outcome::undecided},
                                  {Answer::compatible, plateau_or_root, Outcome::undecided},
                                  {Answer::incompatible, plateau_or_root, Outcome::stalls},
                                  {Answer::unknown, sure_rate, Outcome::undecided},
                                  {Answer::compatible, sure_rate, Outcome::converges},
                                  {Answer::incompatible, sure_rate, Outcome::undecided}};
  const auto scene = make_scene(against_exact);
  for (const Row &row : table)
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", row.errors);
    prove(results, "A", row.answer, row.answer == Answer::incompatible ? .1 : 0);
    conclude(scene, results);
    EXPECT_EQ(trend_of(results, "A").outcome, row.outcome) << trend_of(results, "A").reason;
  }
  // not where the reference is in doubt
  const auto held_against_reference = make_scene(against_reference);
  StudyResults results = make_results(held_against_reference);
  add_runs(results, "A", sure_rate);
  add_reference(results, std::vector<double>(4, 1e-4));
  prove(results, "A", Answer::compatible, 0);
  conclude(held_against_reference, results);
  EXPECT_EQ(trend_of(results, "A").outcome, Outcome::undecided);
}

namespace
{
  /// A and B over four levels at a fixed horizon or towards the local limit with m growing.
  StudyResults refined(const std::string &regime, const std::string &target,
                       const std::vector<double> &errors, const std::vector<double> &area_defects,
                       const std::vector<double> &ball_defects)
  {
    const std::string series = regime == "m" ? " set horizon = 0.4\n" : " set m = 2, 3, 4, 6\n";
    const auto scene = scene::parse_scene(
        "test.prm", "subsection Problem\n set solution = one: x^3\n"
                    " set local solution = x^2\nend\n"
                    "subsection Methods\n set names = A\nend\n"
                    "subsection Study\n set regime = " +
                        regime + "\n" + series +
                        " set h = 0.2, 0.1, 0.05, 0.025\n set norms = averages L2\n"
                        " set decisive error = averages L2 | " +
                        target + "\nend\n");
    StudyResults results = make_results(scene);
    results.regime = scene.study.regime;
    const std::string name = scene.study.series.front().name;
    add_runs(results, "A", errors, "one", name);
    for (std::size_t level = 0; level < results.records.size(); ++level)
    {
      Record &run = results.records[level];
      run.key.horizon = scene.study.series.front().levels[level].horizon;
      LimitProof limit;
      limit.area_defect = area_defects[level];
      limit.ball_defect = ball_defects[level];
      set_limit(run, limit);
    }
    conclude(scene, results);
    return results;
  }

  const std::vector<double> falling = {.2, .05, .0125, .003}, staying = {.31, .3, .3, .3},
                            exact = {1e-13, 1e-13, 1e-13, 1e-13};
} // namespace

TEST(Conclusions,
     at_a_fixed_horizon_weights_that_do_not_tend_to_areas_are_right_for_this_field_only)
{
  const auto verdict = [](const StudyResults &results) { return results.trends.front().verdict; };
  EXPECT_EQ(verdict(refined("m", "exact", second_order, falling, falling)), "m-convergent");
  const StudyResults wrong = refined("m", "exact", second_order, staying, {.25, .03, .002, .02});
  EXPECT_EQ(verdict(wrong), "m-convergent for this field only");
  EXPECT_TRUE(wrong.advice.front().choices.empty());
  EXPECT_EQ(verdict(refined("m", "exact", stalled, staying, staying)), "not m-convergent");
  // towards the local limit second moments decide
  EXPECT_EQ(verdict(refined("delta-m", "exact", second_order, staying, exact)),
            "delta-m-convergent");
  EXPECT_EQ(verdict(refined("delta-m", "exact", second_order, staying, staying)),
            "delta-m-convergent for this field only");
  EXPECT_EQ(verdict(refined("delta-m", "exact", second_order, falling, {.03, .01, .002, .008})),
            "delta-m-convergent");
}

TEST(Conclusions, what_is_proven_wrong_at_every_level_is_wrong_without_weights)
{
  LimitProof wrong;
  wrong.answer = LimitProof::Answer::incompatible;
  wrong.defect = .05;
  wrong.reason = "another operator";
  for (const auto regime : {scene::Regime::m, scene::Regime::delta_m})
  {
    const LimitProof found = prove_by_levels(regime, Trend(), {wrong, wrong});
    EXPECT_EQ(found.answer, LimitProof::Answer::incompatible);
    EXPECT_EQ(found.defect, .05);
    EXPECT_EQ(found.reason, "another operator");
    for (const auto &levels : {std::vector<LimitProof>{}, {wrong, LimitProof()}})
      EXPECT_EQ(prove_by_levels(regime, Trend(), levels).answer, LimitProof::Answer::unknown);
  }
}

TEST(Conclusions, a_fixed_horizon_against_the_local_solution_decides_nothing)
{
  for (const auto &errors : {stalled, std::vector<double>{1.9e-1, 1.4e-1, 1.12e-1, 1.05e-1}})
  {
    const StudyResults results = refined("m", "local", errors, falling, falling);
    EXPECT_EQ(results.trends.front().verdict, "undecided");
    EXPECT_NE(results.trends.front().reason.find("nonlocal from the local"), std::string::npos);
    EXPECT_EQ(results.warnings.size(), 1u);
    EXPECT_TRUE(results.advice.front().stalling.empty());
  }
  EXPECT_EQ(refined("m", "exact", stalled, falling, falling).trends.front().verdict,
            "not m-convergent");
  EXPECT_EQ(refined("delta-m", "local", stalled, falling, falling).trends.front().verdict,
            "not delta-m-convergent");
}

TEST(Conclusions, the_weakest_proof_of_all_levels_counts)
{
  const auto scene = make_scene(against_exact);
  for (const unsigned int wrong : {0u, 2u, 3u})
  {
    StudyResults results = make_results(scene);
    add_runs(results, "A", second_order);
    prove(results, "A", LimitProof::Answer::compatible, 0);
    LimitProof limit = limit_of(results.records[wrong]);
    limit.answer = LimitProof::Answer::incompatible;
    limit.defect = .02;
    set_limit(results.records[wrong], limit);
    conclude(scene, results);
    EXPECT_EQ(trend_of(results, "A").verdict, "AC for this field only") << wrong;
  }
}

// ---- the own finest level -----------------------------------------------------------------------

namespace
{
  /// What conclude says of differences to a finest level at h = .0125.
  Trend judged_by_own(const std::vector<double> &differences, LimitProof::Answer answer)
  {
    const auto scene = make_scene("averages L2 | own finest level");
    StudyResults results = make_results(scene);
    add_runs(results, "A", differences);
    Record finest = results.records.back();
    finest.key.level = 4;
    finest.key.h = .0125;
    finest.scalars.erase(results.decisive_error);
    results.records.push_back(finest);
    prove(results, "A", answer, answer == LimitProof::Answer::incompatible ? .04 : 0);
    conclude(scene, results);
    return trend_of(results, "A");
  }

  /// |u_h - u_H| of u_h = u + h^p.
  std::vector<double> differences(double p)
  {
    std::vector<double> values;
    for (const double size : h)
      values.push_back(std::pow(size, p) - std::pow(.0125, p));
    return values;
  }
} // namespace

TEST(Conclusions, differences_to_the_own_finest_level_show_the_rate_to_the_limit)
{
  using Answer = LimitProof::Answer;
  for (const double p : {1., 2.})
  {
    const Trend trend = judged_by_own(differences(p), Answer::compatible);
    EXPECT_EQ(trend.verdict, "self-convergent") << trend.reason;
    EXPECT_NEAR(trend.rate, p, .03); // raw differences would say 1.58 of 1
    EXPECT_NEAR(trend.rates.back(), p, .03);
    EXPECT_EQ(trend.finest, .0125);
  }
  EXPECT_EQ(judged_by_own(differences(2), Answer::incompatible).verdict,
            "self-convergent to a wrong limit");
  EXPECT_EQ(judged_by_own(differences(.4), Answer::compatible).outcome, Outcome::undecided);
  // solutions that move by as much at every level have no limit
  EXPECT_NE(judged_by_own({4e-2, 3e-2, 2e-2, 1e-2}, Answer::unknown).outcome, Outcome::converges);
  EXPECT_EQ(judged_by_own({1e-3, 2e-3, 1e-3, 4e-3}, Answer::unknown).verdict,
            "not self-convergent");
}
