// Where errors of samples and of the mesh balance, of errors that are given.

#include "study/sampling_balance.h"

#include <gtest/gtest.h>

namespace
{
  using namespace plumbline::study;

  /// @param counts  of its sets, as many as errors; no error: negative
  CaseStatistics given(double h, const std::vector<unsigned int> &counts,
                       const std::vector<double> &errors, unsigned int n_modes = 0)
  {
    CaseStatistics one;
    one.of.method = "OPT";
    one.of.series = "m = 3";
    one.of.h = h;
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      SetStatistics set;
      set.count = counts[i];
      set.n_modes = n_modes;
      set.mean_size = 1;
      if (errors[i] >= 0)
        set.mean_error = errors[i];
      one.sets.push_back(set);
    }
    return one;
  }

  /// From which count on samples are enough; 0: they never are.
  unsigned int enough(const std::vector<double> &errors)
  {
    const auto balance = find_balance({given(.25, {1, 2, 4, 8}, errors)});
    EXPECT_EQ(balance.size(), 1u);
    return balance.at(0).enough.value_or(0);
  }
} // namespace

TEST(SamplingBalance, IsWhereTheErrorIsWithinATenthOfTheLast)
{
  EXPECT_EQ(enough({1, .3, .1099, .1}), 4);
  EXPECT_EQ(enough({1, .3, .0901, .1}), 4);
  EXPECT_EQ(enough({1, .3, .1101, .1}), 0);
  EXPECT_EQ(enough({1, .3, .0899, .1}), 0);
  EXPECT_EQ(enough({.1, .1, .1, .1}), 1);
  EXPECT_EQ(enough({1, .1, .05, .025}), 0);
  // what is as good by chance, and is left again, is not
  EXPECT_EQ(enough({.1, .3, .105, .1}), 4);
  // rounding is not halved by more samples
  EXPECT_EQ(enough({1, 4e-16, 1e-16, 2e-16}), 2);
}

TEST(SamplingBalance, IsOfEachLevelAndNumberOfModes)
{
  CaseStatistics modes = given(.5, {1, 2}, {.2, .2}, 1);
  for (const SetStatistics &set : given(.5, {1, 2}, {.2, .1}, 4).sets)
    modes.sets.push_back(set);
  const auto balance = find_balance({modes, given(.25, {1, 2, 3}, {.3, .05, .05}, 4)});
  ASSERT_EQ(balance.size(), 3u);
  EXPECT_EQ(balance[0].h, .5);
  EXPECT_EQ(balance[0].n_modes, 1u);
  EXPECT_EQ(balance[0].enough.value_or(0), 1u);
  EXPECT_EQ(balance[1].n_modes, 4u);
  EXPECT_FALSE(balance[1].enough);
  EXPECT_EQ(balance[2].h, .25);
  EXPECT_EQ(balance[2].enough.value_or(0), 2u);
  EXPECT_EQ(balance[2].largest, 3u);
  EXPECT_EQ(balance[2].error, .05);
}

TEST(SamplingBalance, IsNotKnownOfOneSetAndOfTheTargetsOwnLevel)
{
  CaseStatistics target = given(.25, {1, 2}, {.1, .1});
  target.is_target_level = true;
  EXPECT_TRUE(find_balance({target, given(.5, {1}, {.1}), given(.5, {1, 2}, {.1, -1})}).empty());
  // a set without an error says nothing, the others do
  const auto balance = find_balance({given(.5, {1, 2, 4}, {.1, .1, -1})});
  ASSERT_EQ(balance.size(), 1u);
  EXPECT_EQ(balance[0].enough.value_or(0), 1u);
  EXPECT_EQ(balance[0].largest, 2u);
}

TEST(SamplingBalance, IsSaidInASentence)
{
  const auto balance =
      find_balance({given(.5, {1, 2, 4}, {.3, .02, .02}), given(.25, {1, 2, 4}, {.3, .02, .005})});
  ASSERT_EQ(balance.size(), 2u);
  EXPECT_EQ(words_of(balance[0], false),
            "OPT, m = 3, h = 0.5: beyond count 2 more samples do not reduce the error of the mean, "
            "0.02 at count 4; the rest is due to h");
  EXPECT_EQ(words_of(balance[1], false),
            "OPT, m = 3, h = 0.25: samples still limit the error of the mean, 0.005 at count 4; "
            "it differs by more than a tenth from that of the count before. Take more samples");
  EXPECT_EQ(words_of(balance[0], true),
            "OPT, m = 3, h = 0.5, modes 0: beyond count 2 more samples do not reduce the error of "
            "the mean, 0.02 at count 4; the rest is due to h or to omitted modes");
}
