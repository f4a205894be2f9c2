// What is said of the weights of families.
#include "meshfree/rules/family_statistics.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  /// Bonds of given weights and areas.
  std::vector<Bond<2>> bonds(const std::vector<std::pair<double, double>> &weights)
  {
    std::vector<Bond<2>> result;
    for (const auto &[weight, area] : weights)
      result.push_back({Point<2>(1, 0), weight, Point<2>(1, 0), area});
    return result;
  }
} // namespace

TEST(DescribeWeights, takes_the_least_weight_of_an_area_over_all_bonds_of_all_families)
{
  method::Diagnostics diagnostics;
  describe_weights(bonds({{.9, 1}, {.4, .5}}), {}, diagnostics);
  EXPECT_EQ(diagnostics.smallest_weight_ratio, .8);
  // -0.6 is the least weight, -0.5 the least for its area
  describe_weights(bonds({{1, 1}, {-.5, 1}, {-.6, 2}}), {}, diagnostics);
  describe_weights(bonds({{.7, 1}}), {}, diagnostics);
  EXPECT_EQ(diagnostics.smallest_weight_ratio, -.5);
  EXPECT_EQ(diagnostics.n_negative_weights, 2u);
  EXPECT_EQ(diagnostics.n_neighbours, 3u);
}
