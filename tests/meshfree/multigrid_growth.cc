// Cracks that grow without a factor, by multigrid: the same events as with one.

#include "analysis/fracture.h"
#include "growth_plate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace growth_plate;
  using analysis::Event;
  using analysis::Growth;
  using meshfree::BreakingNetwork;
  using problem::GrowthSolver;

  meshfree::BondNetwork<2> plate_of(double nu)
  {
    return network(plate(40, 20, 20 * h, nu));
  }

  Growth grow(BreakingNetwork<2> &body, std::vector<Event> earlier = {})
  {
    return analysis::grow(body, rules(), std::move(earlier));
  }
} // namespace

TEST(MultigridGrowth, breaks_the_same_bonds_at_the_same_loads)
{
  for (const double nu : {.25, .35})
  {
    const meshfree::BondNetwork<2> net = plate_of(nu);
    BreakingNetwork<2> factored(net, problem::Stretch::linear),
        iterated(net, problem::Stretch::linear, GrowthSolver::multigrid);
    const Growth expected = grow(factored), growth = grow(iterated);
    EXPECT_EQ(growth.end, expected.end);
    ASSERT_EQ(growth.events.size(), expected.events.size());
    for (std::size_t i = 0; i < growth.events.size(); ++i)
    {
      const Event &a = growth.events[i], &b = expected.events[i];
      ASSERT_EQ(a.bonds, b.bonds) << i;
      EXPECT_NEAR(a.critical / b.critical, 1, 1e-9) << i;
      EXPECT_LT(a.residual, 1e-10) << i;
      EXPECT_LT(a.imbalance(), 1e-10) << i;
    }
    const auto &work = iterated.work();
    EXPECT_LT(work.n_factorisations, growth.events.size() / 5);
    EXPECT_GT(work.n_iterations, growth.events.size());
    EXPECT_LT(work.most_iterations, 20u);
    // bonds that break between two set-ups are counted: several in a row, not all
    EXPECT_GT(work.largest_rank, 2u);
    EXPECT_LT(work.largest_rank, net.bonds.size());
  }
}

TEST(MultigridGrowth, goes_on_to_the_same_bits)
{
  const meshfree::BondNetwork<2> net = plate_of(.25);
  BreakingNetwork<2> whole(net, problem::Stretch::linear, GrowthSolver::multigrid);
  const Growth expected = grow(whole);
  ASSERT_GT(whole.work().n_factorisations, 3u);
  const auto half = static_cast<std::ptrdiff_t>(expected.events.size() / 2);
  BreakingNetwork<2> body(net, problem::Stretch::linear, GrowthSolver::multigrid);
  const Growth growth = grow(body, {expected.events.begin(), expected.events.begin() + half});
  ASSERT_EQ(growth.events.size(), expected.events.size());
  for (std::size_t i = 0; i < growth.events.size(); ++i)
  {
    const Event &a = growth.events[i], &b = expected.events[i];
    EXPECT_TRUE(a.bonds == b.bonds && a.load == b.load && a.stored == b.stored &&
                a.work == b.work && a.released == b.released)
        << i;
  }
}
