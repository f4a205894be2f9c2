#include "benchmarks/atlas_survey.h"

#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumbline::atlas
{
  namespace
  {
    /// Runs of a method at given costs [CPU s] and errors, of a solution of size 2.
    void add(study::StudyResults &results, const std::string &method, const std::string &series,
             const std::vector<std::pair<double, double>> &costs_and_errors, study::Outcome outcome,
             study::MethodFamily family = study::MethodFamily::meshfree)
    {
      for (const auto &[seconds, error] : costs_and_errors)
      {
        study::Record run;
        run.key.method = method;
        run.key.family = family;
        run.key.problem = "case";
        run.key.series = series;
        run.cost.solve_seconds = seconds;
        run.cost.n_unknowns = static_cast<std::size_t>(100 * seconds); // those break ties
        run.set("variation", 2);
        run.set(results.decisive_error, error);
        results.records.push_back(run);
      }
      study::Trend trend;
      trend.method = method;
      trend.problem = "case";
      trend.series = series;
      trend.error = results.decisive_error;
      trend.outcome = outcome;
      results.trends.push_back(trend);
    }

    study::StudyResults results()
    {
      using study::Outcome;
      study::StudyResults results;
      results.decisive_error = "nodal Linf | exact";
      add(results, "cheap but stalling", "m = 3", {{1, .1}, {4, .09}}, Outcome::stalls);
      add(results, "good", "m = 3", {{2, .18}, {8, .01}, {32, .001}}, Outcome::converges);
      add(results, "as good, a little dearer", "m = 3", {{8.5, .01}}, Outcome::converges);
      add(results, "dear", "m = 3", {{100, .01}}, Outcome::converges,
          study::MethodFamily::reference);
      add(results, "short", "m = 3", {{.5, 1e-4}}, Outcome::undecided);
      add(results, "local", "m = 3", {{.01, 1e-9}}, Outcome::converges, study::MethodFamily::local);
      add(results, "rough", "m = 3", {{.1, .9}}, Outcome::converges);
      return results;
    }
  } // namespace

  TEST(Atlas, names_the_cheapest_method_that_converges)
  {
    const study::StudyResults all = results();
    const Question question{&all, "case", ""};
    ASSERT_NE(cheapest(question, 1e-2), nullptr); // relative: .02 of a solution of size 2
    EXPECT_EQ(cheapest(question, 1e-2)->key.method, "good");
    EXPECT_EQ(cheapest(question, 1e-2)->cost.seconds(), 8);
    EXPECT_EQ(cheapest(question, 1e-4)->key.method, "short"); // none converges this far
    EXPECT_EQ(cheapest(question, 1e-5), nullptr);
  }

  TEST(Atlas, front_is_what_no_run_equals_for_clearly_less)
  {
    study::StudyResults all = results();
    const auto is_short = [](const auto &one) { return one.key.method == "short"; };
    all.records.erase(std::remove_if(all.records.begin(), all.records.end(), is_short),
                      all.records.end());
    EXPECT_EQ(methods_on_front({&all, "case", "m = 3"}),
              (std::vector<std::string>{"cheap but stalling", "good", "as good, a little dearer"}));
    EXPECT_TRUE(is_stalling({&all, "case", ""}, "cheap but stalling"));
  }

  TEST(Atlas, takes_the_worst_outcome_of_pooled_series)
  {
    study::StudyResults all = results();
    add(all, "good", "m = 4", {{1, .1}}, study::Outcome::stalls);
    EXPECT_EQ(outcome_of({&all, "case", "m = 3"}, "good"), study::Outcome::converges);
    EXPECT_EQ(outcome_of({&all, "case", ""}, "good"), study::Outcome::stalls);
    const auto tallies = tally({{&all, "case", "m = 3"}, {&all, "case", "m = 4"}});
    EXPECT_EQ(tallies.at("good").n, 2u);
    EXPECT_EQ(tallies.at("good").n_outcome.at(study::Outcome::stalls), 1u);
    EXPECT_EQ(tallies.count("local"), 0u);
  }
} // namespace plumbline::atlas
