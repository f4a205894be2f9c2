// Times of short solves: the fastest of three, and nothing else of the repeats.
#include "study/timing.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace plumbline;

namespace
{
  analysis::Outcome outcome(double setup, double solve)
  {
    analysis::Outcome result;
    result.solution.emplace();
    result.solution->cost.setup_seconds = setup;
    result.solution->cost.solve_seconds = solve;
    return result;
  }
} // namespace

TEST(Timing, takes_the_fastest_of_three_short_solves_case_by_case)
{
  std::vector<std::vector<analysis::Outcome>> answers;
  answers.push_back({outcome(.002, .003), outcome(.001, .001), outcome(.1, .2), {}});
  answers.push_back({outcome(.001, .002), outcome(.001, .002), outcome(.01, .02), {}});
  answers.push_back({outcome(.004, .001), outcome(.003, .002), outcome(.01, .02), {}});
  for (unsigned int i = 0; i < answers.size(); ++i)
  {
    answers[i][0].solution->cost.n_iterations = i + 1;
    answers[i][3].failure = std::make_exception_ptr(std::runtime_error("none"));
  }
  std::size_t n_calls = 0;
  const auto found = study::solve_and_time([&] { return answers.at(n_calls++); });
  EXPECT_EQ(n_calls, 3u);
  EXPECT_EQ(found[0].solution->cost.setup_seconds, .001);
  EXPECT_EQ(found[0].solution->cost.solve_seconds, .002);
  EXPECT_EQ(found[0].solution->cost.n_iterations, 1u); // the solution is the first one
  EXPECT_EQ(found[1].solution->cost.seconds(), .002);
  EXPECT_EQ(found[2].solution->cost.seconds(), .1 + .2); // not short
  EXPECT_FALSE(found[3].solution);
  EXPECT_TRUE(found[3].failure);
}

TEST(Timing, repeats_nothing_that_is_long)
{
  std::size_t n_calls = 0;
  const auto solve = [&]
  {
    ++n_calls;
    return std::vector<analysis::Outcome>{outcome(.015, .01)};
  };
  study::solve_and_time(solve);
  EXPECT_EQ(n_calls, 1u);
}
