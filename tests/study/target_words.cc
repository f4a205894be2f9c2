// What reports say that methods are held against.
#include "study/target_words.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::study;

TEST(TargetWords, name_each_target)
{
  StudyResults results;
  results.regime = scene::Regime::m;
  const auto words = [&](const std::string &error)
  {
    results.decisive_error = error;
    return target_words(results);
  };
  EXPECT_EQ(words("nodal Linf | exact"),
            "the exact solution of the nonlocal problem, Problem/solution");
  EXPECT_FALSE(is_between_models(results));
  EXPECT_EQ(words("nodal L2 | own finest level"), "each method's own finest level");
  EXPECT_EQ(words("averages L2 | reference"), "the reference solution");
  results.references.resize(1);
  results.references[0].method = "Q2";
  EXPECT_EQ(words("averages L2 | reference"), "the reference solution by Q2");
  EXPECT_EQ(words("nodal L2 | local"), "the solution of the local limit");
  EXPECT_TRUE(is_between_models(results));
  results.regime = scene::Regime::delta;
  EXPECT_FALSE(is_between_models(results));
}
