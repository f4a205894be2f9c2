// Bonds that break between scattered nodes: against lattices, motions of the body, and the balance
// of energy.

#include "analysis/fracture.h"
#include "base/error.h"
#include "geometry/mesh_input.h"
#include "growth_plate.h"
#include "study/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{
  using namespace plumbline;
  using analysis::Event;
  using analysis::grow;
  using analysis::Growth;
  using meshfree::BondNetwork;
  using meshfree::BreakingNetwork;
  using meshfree::BreakingSolid;
  using namespace growth_plate;

  /// The plate's body in squares, their nodes moved by up to perturbation h.
  BreakingSolid<2> scattered(BreakingSolid<2> solid, double perturbation)
  {
    const geometry::Mesh mesh = geometry::lattice_mesh(solid.domain, h, 0, false);
    solid.cells = std::make_shared<const geometry::NodeCells<2>>(
        voronoi_cells(lattice_nodes(mesh, h, perturbation, 1), mesh));
    return solid;
  }

  /// By the middle of the bond and its direction, in 1e-6 h.
  using BondPlace = std::array<long, 4>;
  std::map<BondPlace, std::size_t> places(const BondNetwork<2> &net)
  {
    std::map<BondPlace, std::size_t> result;
    for (std::size_t b = 0; b < net.bonds.size(); ++b)
    {
      const auto &bond = net.bonds[b];
      const double sign = std::abs(bond.xi[0]) > 1e-6 * h ? bond.xi[0] : bond.xi[1];
      const Tensor<1, 2> xi = sign > 0 ? bond.xi : -bond.xi,
                         middle = net.nodes[bond.from] + .5 * bond.xi - Point<2>();
      const auto at = [](double x) { return std::lround(x / (1e-6 * h)); };
      result[{at(middle[0]), at(middle[1]), at(xi[0]), at(xi[1])}] = b;
    }
    return result;
  }

  /// @param least_reaction  where it ends, over the largest
  Growth growth_of(const BondNetwork<2> &net, double least_reaction = 0)
  {
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    problem::FractureSettings settings = rules();
    settings.least_reaction = least_reaction;
    return grow(body, settings);
  }

  /// Turned about the origin, with its grips: what they do is turned too.
  BreakingSolid<2> turned(const BreakingSolid<2> &solid)
  {
    const auto turn = [](const Tensor<1, 2> &x) { return Tensor<1, 2>({-x[1], x[0]}); };
    const auto turn_back = [](const Point<2> &x) { return Point<2>(x[1], -x[0]); };
    auto cells = *solid.cells;
    for (auto *const points : {&cells.nodes, &cells.centroid})
      for (Point<2> &x : *points)
        x = Point<2>() + turn(x - Point<2>());
    for (geometry::Polygon &piece : cells.pieces)
      for (Point<2> &x : piece)
        x = Point<2>() + turn(x - Point<2>());
    BreakingSolid<2> result = solid;
    result.cells = std::make_shared<const geometry::NodeCells<2>>(cells);
    for (geometry::Box &grip : result.grips)
      grip = {{-grip.upper[1], grip.lower[0]}, {-grip.lower[1], grip.upper[0]}};
    for (geometry::Polyline &line : result.notch)
      for (Point<2> &x : line)
        x = Point<2>() + turn(x - Point<2>());
    result.constrained = [=](const Point<2> &x) { return turn(solid.constrained(turn_back(x))); };
    return result;
  }
} // namespace

TEST(ScatteredFracture, nodes_of_a_lattice_have_its_bonds_and_events)
{
  for (const double nu : {.25, .35})
  {
    const BreakingSolid<2> solid = plate(24, 14, 10 * h, nu);
    const BondNetwork<2> lattice = network(solid), net = network(scattered(solid, 0));
    ASSERT_EQ(net.bonds.size(), lattice.bonds.size());
    EXPECT_EQ(net.cut.size(), lattice.cut.size());
    EXPECT_NEAR(net.h, h, 1e-12);
    const auto found = places(net);
    for (const auto &[place, b] : places(lattice))
    {
      ASSERT_EQ(found.count(place), 1u);
      const auto &one = net.bonds[found.at(place)], &other = lattice.bonds[b];
      EXPECT_NEAR(one.stiffness, other.stiffness, 1e-12 * other.stiffness);
      EXPECT_EQ(std::isfinite(one.critical), std::isfinite(other.critical));
      if (std::isfinite(other.critical))
      {
        EXPECT_NEAR(one.critical, other.critical, 1e-12 * other.critical);
      }
    }
    const Growth mine = growth_of(net), its = growth_of(lattice);
    ASSERT_EQ(mine.events.size(), its.events.size());
    for (std::size_t i = 0; i < mine.events.size(); ++i)
    {
      EXPECT_EQ(mine.events[i].bonds.size(), its.events[i].bonds.size()) << i;
      EXPECT_NEAR(mine.events[i].critical / its.events[i].critical, 1, 1e-8) << i;
      EXPECT_NEAR(mine.events[i].stored, its.events[i].stored, 1e-8 * its.events[i].work) << i;
    }
  }
}

TEST(ScatteredFracture, every_event_balances_its_energy)
{
  for (const double nu : {.25, .35})
  {
    const Growth growth = growth_of(network(scattered(plate(24, 14, 10 * h, nu), .3)), 1e-3);
    EXPECT_GT(growth.events.size(), 50u);
    EXPECT_EQ(growth.end, problem::GrowthEnd::unloaded);
    for (const Event &event : growth.events)
      EXPECT_LT(event.imbalance(), 1e-10);
  }
}

TEST(ScatteredFracture, a_body_that_is_turned_breaks_in_the_same_way)
{
  const BreakingSolid<2> solid = scattered(plate(20, 12, 8 * h, .35), .3);
  const Growth upright = growth_of(network(solid)), other = growth_of(network(turned(solid)));
  ASSERT_EQ(upright.events.size(), other.events.size());
  for (std::size_t i = 0; i < upright.events.size(); ++i)
  {
    EXPECT_EQ(upright.events[i].bonds, other.events[i].bonds) << i;
    EXPECT_NEAR(upright.events[i].critical / other.events[i].critical, 1, 1e-9) << i;
  }
}

TEST(ScatteredFracture, a_crack_follows_the_sides_of_cells_from_the_notch_across_the_body)
{
  const BreakingSolid<2> solid = scattered(plate(40, 30, 16 * h, .25), .3);
  const auto body = std::make_shared<BreakingNetwork<2>>(network(solid), problem::Stretch::linear);
  const auto model = breakable_body(body, solid.notch[0].back());
  const Growth growth = grow(*body, rules());
  const study::CrackPath path = study::find_path(model, growth.events);
  EXPECT_GT(path.notch.size(), 14u);
  EXPECT_NEAR(path.tips.back()[0], 40 * h, 1e-6 * h); // an end of a side is on the edge
  EXPECT_NEAR(path.width, 24 * h, h);
  EXPECT_LT(path.n_elsewhere, path.sides.size() / 5);
  // as on a lattice: 18 bonds in each h, and with them almost G
  EXPECT_NEAR(study::bonds_across(model), 18, 2);
  EXPECT_NEAR(model.cut_energy, 1, .1);
}

TEST(ScatteredFracture, refuses_rules_that_adjust_weights_and_surface_terms)
{
  BreakingSolid<2> solid = scattered(plate(20, 12, 8 * h, .25), .3);
  const auto K = influence(3 * h);
  EXPECT_THROW(make_bond_network(solid,
                                 meshfree::optimisation_based(physics::deviatoric_kernel(K, 1)), K,
                                 h, geometry::Backend::fast),
               InputError);
  solid.surface_terms = problem::SurfaceTerms::none;
  EXPECT_THROW(network(solid), InputError);
}

TEST(ScatteredFracture, grips_hold_the_nodes_in_their_boxes)
{
  BreakingSolid<2> solid = scattered(plate(20, 12, 8 * h, .25), .3);
  const BondNetwork<2> net = network(solid);
  for (std::size_t i = 0; i < net.nodes.size(); ++i)
    EXPECT_EQ(net.grip[i] >= 0, std::abs(net.nodes[i][1]) > 3 * h) << i;
  solid.grips[1] = {{0, 5}, {1, 6}};
  EXPECT_THROW(network(solid), InputError);
}
