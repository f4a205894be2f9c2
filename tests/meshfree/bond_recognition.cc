// When a rule counts as recognised, and when moments name the one bond that is wrong.
#include "given_bonds.h"

#include "base/error.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/node_moments.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::meshfree;

TEST(Recognition, takes_nine_of_ten_weights)
{
  const Weights sound = weights_of("PA-AC", nodes_for(3, 0, "linear-decay"));
  for (const double wrong : {.06, .14})
  {
    Weights weights = sound;
    double n = 0, n_wrong = 0;
    for (Family<2> &family : weights.families)
      for (Bond<2> &bond : family.bonds)
        if (++n * wrong >= n_wrong + 1)
        {
          ++n_wrong;
          bond.weight *= 1.7;
        }
    const auto rule = recognise(weights.given());
    EXPECT_EQ(rule.has_value(), wrong < .1) << wrong;
    if (rule)
    {
      EXPECT_EQ(rule->rule, "PA-AC");
    }
  }
}

TEST(Recognition, knows_rules_that_all_leaves_out_and_skips_those_without_tensors)
{
  for (const std::string name : {"GFD", "PDDO", "GMLS"})
  {
    const Weights weights = weights_of(name, nodes_for(3, .2, "constant"));
    const auto rule = recognise(weights.given());
    ASSERT_TRUE(rule) << name;
    EXPECT_EQ(rule->rule, name);
  }
  const Weights solid = weights_of("GFD", nodes_for(3, .2, "bond-tensor"));
  const auto rule = recognise(solid.given());
  ASSERT_TRUE(rule);
  EXPECT_EQ(rule->rule, "GFD");
  EXPECT_THROW(weights_of("PDDO", nodes_for(3, .2, "bond-tensor")), InputError);
}

TEST(Recognition, finds_the_common_factor_by_weights_that_rounding_leaves_alone)
{
  // at m = 1.6 twelve of twenty cells are barely cut: what rounds them up by 1.5e-5 of a cell
  // changes them by a percent
  Weights weights = weights_of("PA-AC", nodes_for(1.6, 0, "constant"));
  for (Family<2> &family : weights.families)
    for (Bond<2> &bond : family.bonds)
      bond.weight += 1.5e-5 * bond.area;
  const auto rule = recognise(weights.given());
  ASSERT_TRUE(rule);
  EXPECT_EQ(rule->rule, "PA-AC");
  EXPECT_NEAR(rule->factor, 1, 3e-5);
}

namespace
{
  constexpr std::size_t node = 27;

  /// What the moments say of the node after one of its weights changed by a part of itself, and
  /// another one by another.
  Outlier<2> of_changes(Weights weights, std::size_t first, double by, std::size_t second,
                        double by_less)
  {
    std::vector<Bond<2>> &bonds = weights.families[node].bonds;
    bonds[first].weight *= 1 + by;
    bonds[second].weight *= 1 + by_less;
    const auto found = find_moment_outliers(weights.given(), all_pairs(weights.given()));
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? Outlier<2>{Defect::moments, 0} : found[0];
  }

  std::size_t bond_at(const Weights &weights, int k1, int k2)
  {
    const std::vector<Bond<2>> &bonds = weights.families[node].bonds;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      if (bonds[k].xi.distance(Point<2>(k1 * node_distance, k2 * node_distance)) < 1e-9)
        return k;
    throw std::logic_error("no such bond");
  }
} // namespace

TEST(MomentOutliers, name_the_bond_that_explains_all_but_a_twentieth)
{
  const Weights weights = weights_of("FA", nodes_for(3, 0, "linear-decay"));
  const std::size_t one = bond_at(weights, 1, 1), two = bond_at(weights, -2, 0);
  for (const auto &[less, defect] : {std::pair{0., Defect::weight},
                                     {.03, Defect::weight},
                                     {.1, Defect::moments},
                                     {.25, Defect::moments},
                                     {.8, Defect::moments}})
  {
    const Outlier<2> found = of_changes(weights, one, 1, two, less);
    EXPECT_EQ(found.node, node);
    EXPECT_EQ(found.defect, defect) << less;
    if (found.defect == Defect::weight)
    {
      EXPECT_EQ(found.bond, one) << less;
      EXPECT_NEAR(found.found / found.expected, 2, .1) << less;
    }
  }
}

TEST(MomentOutliers, name_no_bond_where_another_explains_nearly_as_much)
{
  // seen from afar the bonds to (8, 1) and (8, 0) are nearly alike: of a change to one of them
  // alone each is told from the other, not where something else is off by a few percent
  const Weights weights = weights_of("FA", nodes_for(9, 0, "constant"));
  const std::size_t one = bond_at(weights, 8, 1), two = bond_at(weights, -8, 2);
  const Outlier<2> alone = of_changes(weights, one, 1, two, 0);
  EXPECT_EQ(alone.defect, Defect::weight);
  EXPECT_EQ(alone.bond, one);
  EXPECT_EQ(of_changes(weights, one, 1, two, .04).defect, Defect::moments);
}
