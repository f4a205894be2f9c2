// What hangs loose in a network: bonds on a line, mechanisms, and how stiffly they are constrained.

#include "meshfree/fracture/connections.h"
#include "meshfree/fracture/network_terms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;
  using dealii::Tensor;
  using meshfree::BondNetwork;
  using meshfree::Connections;

  Tensor<1, 2> direction(double angle)
  {
    Tensor<1, 2> result;
    result[0] = std::cos(angle);
    result[1] = std::sin(angle);
    return result;
  }

  /// Free nodes 0, 1, ..., each with bonds in some directions to nodes that a grip holds.
  BondNetwork<2> network(const std::vector<std::vector<double>> &angles)
  {
    BondNetwork<2> result;
    result.h = 1;
    result.horizon = 2;
    const auto add_node = [&](const Point<2> &x, int grip)
    {
      result.nodes.push_back(x);
      result.grip.push_back(grip);
      result.constrained.emplace_back();
    };
    for (std::size_t i = 0; i < angles.size(); ++i)
      add_node({10. * static_cast<double>(i), 0}, -1);
    for (std::size_t i = 0; i < angles.size(); ++i)
      for (const double angle : angles[i])
      {
        const auto to = static_cast<unsigned int>(result.nodes.size());
        add_node(result.nodes[i] + direction(angle), 0);
        result.bonds.push_back({static_cast<unsigned int>(i), to, direction(angle),
                                direction(angle), 2. + static_cast<double>(to), 1, 1});
      }
    return result;
  }
} // namespace

TEST(Connections, hold_a_node_across_bonds_that_lie_on_a_line)
{
  for (const double angle : {0., .3, 1.1, 2.5, 4.7})
  {
    // opposite bonds, rounding apart; bonds that cross at 1e-6 and 1e-3
    const Connections<2> connections(network(
        {{angle, angle + M_PI}, {angle, angle + 1e-6}, {angle, angle + 1e-3}, {angle, angle + 2}}));
    ASSERT_EQ(connections.holds().size(), 2u) << angle;
    for (const std::size_t node : {0, 1})
    {
      EXPECT_EQ(connections.holds()[1 - node].node, node); // the last node is looked at first
      EXPECT_NEAR(connections.holds()[1 - node].direction * direction(angle), 0, 2e-6);
    }
    EXPECT_FALSE(connections.is_loose(2));
    EXPECT_FALSE(connections.is_loose(3));
  }
}

TEST(Connections, a_mechanism_is_held_where_it_moves_most_and_loose_where_it_moves)
{
  Connections<2> connections(network({{0, 1}, {0, 1}, {0, 1}, {0, 1}}));
  ASSERT_TRUE(connections.holds().empty());
  std::vector<Tensor<1, 2>> mode(12); // of a factor of rounding 1e-12: node 2 stands still
  mode[0] = 1e-3 * direction(.5);
  mode[1] = -2 * direction(.7);
  mode[2] = 1e-9 * direction(.9);
  connections.hold(mode);
  ASSERT_EQ(connections.holds().size(), 1u);
  EXPECT_EQ(connections.holds()[0].node, 1u);
  EXPECT_NEAR((connections.holds()[0].direction + direction(.7)).norm(), 0, 1e-15);
  EXPECT_TRUE(connections.is_loose(0));
  EXPECT_TRUE(connections.is_loose(1));
  EXPECT_FALSE(connections.is_loose(2));
  EXPECT_FALSE(connections.is_loose(3));
}

TEST(Connections, what_is_loose_is_held_as_stiffly_as_the_stiffest_bond)
{
  // so that holds make no matrix worse conditioned than bonds do
  const BondNetwork<2> net = network({{0, M_PI}, {0, 1}});
  const Connections<2> connections(net);
  const meshfree::NetworkTerms<2> terms(net);
  ASSERT_EQ(connections.holds().size(), 1u);
  double stiffest = 0;
  for (const BondNetwork<2>::Bond &bond : net.bonds)
    stiffest = std::max(stiffest, bond.stiffness);
  EXPECT_EQ(terms.all(connections).factors.back(), stiffest);
  std::vector<Tensor<1, 2>> u(net.nodes.size()), forces(net.nodes.size());
  u[0] = 3 * connections.holds()[0].direction;
  terms.add_hold(connections.holds()[0], u, forces);
  EXPECT_NEAR((forces[0] - stiffest * u[0]).norm(), 0, 1e-15 * stiffest);
}
