// Bonds that break in equilibrium in space: constants against formulas, brute force, the audit of
// energy, mirror images and turned bodies, what hangs loose, both solvers, and going on.

#include "analysis/fracture.h"
#include "base/error.h"
#include "growth_plate.h"
#include "meshfree/fracture/connections.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace
{
  using namespace plumbline;
  using analysis::Event;
  using analysis::grow;
  using analysis::Growth;
  using dealii::Point;
  using dealii::Tensor;
  using growth_plate::rules;
  using meshfree::BondNetwork;
  using meshfree::BreakingNetwork;
  using meshfree::BreakingSolid;
  using problem::GrowthSolver;
  using problem::Stretch;

  constexpr double h = .1;
  const double inf = std::numeric_limits<double>::infinity();

  physics::Lame lame_of(double nu)
  {
    return physics::lame_from_young(1, nu, physics::PlaneState::strain);
  }

  physics::Kernel<3> influence(double horizon)
  {
    return physics::influence_function<3>(physics::kernel_type("1/r").profile, horizon);
  }

  /// A plate of n1 × n2 × n3 nodes about y = 0 and z = 0 with a notch through its thickness, its
  /// upper and lower layers held and pulled apart by 1 at load 1.
  BreakingSolid<3> plate(int n1, int n2, int n3, int n_notch, double nu = .25, int m = 2)
  {
    const double length = n1 * h, half = .5 * n2 * h, depth = .5 * n3 * h, grip = m * h;
    BreakingSolid<3> solid;
    solid.domain.include = {{{0, -half, -depth}, {length, half, depth}}};
    solid.grips = {{{0, half - grip, -depth}, {length, half, depth}},
                   {{0, -half, -depth}, {length, grip - half, depth}}};
    if (n_notch > 0)
      solid.notch = {{{-h, 0}, {n_notch * h, 0}}};
    solid.constrained = [](const Point<3> &x)
    {
      Tensor<1, 3> u;
      u[1] = x[1] > 0 ? .5 : -.5;
      return u;
    };
    solid.material = [lame = lame_of(nu)](const Point<3> &) { return lame; };
    solid.toughness = [](const Point<3> &) { return 1.; };
    return solid;
  }

  enum class Weights
  {
    full,
    optimised
  };

  BondNetwork<3> network(const BreakingSolid<3> &solid, int m = 2, Weights weights = Weights::full)
  {
    const auto K = influence(m * h);
    const auto C = physics::deviatoric_kernel(K, 1);
    return make_bond_network(
        solid, weights == Weights::full ? meshfree::full_area(C) : meshfree::optimisation_based(C),
        K, h, geometry::Backend::fast);
  }

  double volume()
  {
    return h * h * h;
  }

  /// A place in mesh sizes, twice.
  std::array<long, 3> place(const Point<3> &x)
  {
    return {std::lround(2 * x[0] / h), std::lround(2 * x[1] / h), std::lround(2 * x[2] / h)};
  }

  using Ends = std::set<std::array<long, 3>>;

  /// A bond by its ends after a map of places.
  template <class Map>
  Ends ends_of(const BondNetwork<3> &net, std::size_t bond, const Map &map)
  {
    return {place(map(net.nodes[net.bonds[bond].from])), place(map(net.nodes[net.bonds[bond].to]))};
  }

  std::size_t middle_node(const BondNetwork<3> &net, const Point<3> &x)
  {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < net.nodes.size(); ++i)
      if (net.nodes[i].distance(x) < net.nodes[nearest].distance(x))
        nearest = i;
    return nearest;
  }

  /// Loads at which bonds break, and which, by a dense matrix at every event.
  std::vector<Event> by_brute_force(const BondNetwork<3> &net, std::size_t n_events)
  {
    const auto n = static_cast<Eigen::Index>(3 * net.nodes.size());
    std::vector<char> is_whole(net.bonds.size(), 1);
    Eigen::VectorXd given = Eigen::VectorXd::Zero(n);
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < net.nodes.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
      {
        given[static_cast<Eigen::Index>(3 * i + d)] = net.constrained[i][d];
        if (net.grip[i] < 0)
          free.push_back(static_cast<Eigen::Index>(3 * i + d));
      }
    const auto form =
        [&](const BondNetwork<3>::Bond &bond, const Tensor<1, 3> &direction, Eigen::VectorXd &row)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        row[3 * bond.to + d] += direction[d];
        row[3 * bond.from + d] -= direction[d];
      }
    };
    std::vector<Event> events;
    while (events.size() < n_events)
    {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
      std::map<unsigned int, Eigen::VectorXd> theta;
      for (std::size_t b = 0; b < net.bonds.size(); ++b)
        if (const auto &bond = net.bonds[b]; is_whole[b] != 0)
        {
          for (unsigned int d = 0; d < 3; ++d)
            for (unsigned int e = 0; e < 3; ++e)
              for (const auto &[i, si] : {std::pair(bond.from, -1.), std::pair(bond.to, 1.)})
                for (const auto &[j, sj] : {std::pair(bond.from, -1.), std::pair(bond.to, 1.)})
                  all(3 * i + d, 3 * j + e) += si * sj * bond.stiffness * bond.way[d] * bond.way[e];
          for (const unsigned int node : {bond.from, bond.to})
            if (!net.dilatation.empty())
              form(bond, bond.share * bond.xi,
                   theta.emplace(node, Eigen::VectorXd::Zero(n)).first->second);
        }
      for (const auto &[node, row] : theta)
        all += net.dilatation[node] * row * row.transpose();
      const Eigen::MatrixXd stiffness = all(free, free);
      const Eigen::VectorXd forces = -(all * given), on_free = forces(free);
      Eigen::VectorXd u = given;
      u(free) = Eigen::VectorXd(stiffness.ldlt().solve(on_free));
      std::vector<double> loads(net.bonds.size(), inf);
      for (std::size_t b = 0; b < net.bonds.size(); ++b)
        if (const auto &bond = net.bonds[b]; is_whole[b] != 0)
        {
          double pull = 0;
          for (unsigned int d = 0; d < 3; ++d)
            pull += bond.xi[d] * (u[3 * bond.to + d] - u[3 * bond.from + d]);
          loads[b] = pull > 0 ? bond.critical * bond.xi.norm_square() / pull : inf;
        }
      Event event;
      event.critical = *std::min_element(loads.begin(), loads.end());
      for (std::size_t b = 0; b < loads.size(); ++b)
        if (loads[b] <= event.critical * (1 + 1e-6))
        {
          event.bonds.push_back(b);
          is_whole[b] = 0;
        }
      events.push_back(event);
    }
    return events;
  }
} // namespace

TEST(FractureInSpace, critical_stretches_are_those_of_the_published_formula)
{
  for (const double nu : {.25, .1, .35})
  {
    const BondNetwork<3> net = network(plate(6, 8, 4, 2, nu));
    const physics::Lame lame = lame_of(nu);
    const double delta = 2 * h, k = lame.lambda + 2 * lame.mu / 3,
                 c = 18 * k / (M_PI * std::pow(delta, 4));
    for (const auto &bond : net.bonds)
      if (std::isfinite(bond.critical))
      {
        EXPECT_NEAR(bond.critical, std::sqrt(10 / (M_PI * c * std::pow(delta, 5))),
                    1e-12 * bond.critical);
      }
    EXPECT_EQ(net.dilatation.empty(), nu == .25);
  }
}

TEST(FractureInSpace, bonds_have_the_published_micromodulus)
{
  // c ξ⊗ξ/|ξ|³ of c = 18k/(πδ⁴): a bond's stiffness is V² c/|ξ|
  const BondNetwork<3> net = network(plate(6, 8, 4, 0));
  const physics::Lame lame = lame_of(.25);
  const double c = 18 * (lame.lambda + 2 * lame.mu / 3) / (M_PI * std::pow(2 * h, 4));
  ASSERT_FALSE(net.bonds.empty());
  for (const auto &bond : net.bonds)
    EXPECT_NEAR(bond.stiffness, volume() * volume() * c / bond.xi.norm(), 1e-12 * bond.stiffness);
}

TEST(FractureInSpace, toughness_of_lattices_tends_to_that_of_the_law)
{
  // of all bonds across a plane at s0, summed over the ball: G of the continuum as m grows
  const auto toughness = [](int m, std::array<int, 3> normal)
  {
    const auto K = influence(m * h);
    return meshfree::lattice_toughness<3>(meshfree::full_area(physics::deviatoric_kernel(K, 1)), K,
                                          h, geometry::Backend::fast, normal);
  };
  const auto sum = [](int m, std::array<int, 3> normal)
  {
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] +
                                    normal[2] * normal[2] + 0.),
                 c = 30 / (M_PI * std::pow(m, 4)), s2 = 1 / (3. * m); // h = μ = 1
    double all = 0;
    for (int i = -m; i <= m; ++i)
      for (int j = -m; j <= m; ++j)
        for (int k = -m; k <= m; ++k)
          if (const double r2 = i * i + j * j + k * k; r2 > 0 && r2 <= m * m)
            all += .25 * c * s2 * std::sqrt(r2) *
                   std::abs(i * normal[0] + j * normal[1] + k * normal[2]) / length;
    return all;
  };
  for (const std::array<int, 3> normal :
       {std::array{0, 1, 0}, std::array{1, 1, 0}, std::array{1, 1, 1}, std::array{2, -1, 3}})
  {
    for (const int m : {2, 3, 5})
      EXPECT_NEAR(toughness(m, normal), sum(m, normal), 1e-12) << m;
    EXPECT_NEAR(toughness(16, normal), 1, .012);
    // octahedral symmetry
    EXPECT_NEAR(toughness(3, {normal[2], -normal[0], normal[1]}), toughness(3, normal), 1e-13);
  }
}

TEST(FractureInSpace, a_uniform_strain_has_the_energy_of_the_material)
{
  Tensor<2, 3> strain;
  strain[0][0] = .3;
  strain[1][1] = -.7;
  strain[2][2] = .9;
  strain[0][1] = strain[1][0] = .25;
  strain[1][2] = strain[2][1] = -.4;
  strain[0][2] = strain[2][0] = .15;
  for (const double nu : {.25, .1, .4})
  {
    BreakingSolid<3> solid = plate(11, 11, 11, 0, nu);
    // all but the node in the middle and its neighbours, whose dilatations reach four nodes far
    constexpr double end = .55, free = .15;
    solid.grips = {{{0, -end, -end}, {.4, end, end}},      {{.7, -end, -end}, {1.1, end, end}},
                   {{.4, -end, -end}, {.7, -free, end}},   {{.4, free, -end}, {.7, end, end}},
                   {{.4, -free, -end}, {.7, free, -free}}, {{.4, -free, free}, {.7, free, end}}};
    solid.constrained = [&](const Point<3> &x) { return strain * x; };
    const BondNetwork<3> net = network(solid, 2, Weights::optimised);
    const BreakingNetwork<3> body(net, Stretch::linear);
    EXPECT_EQ(body.n_unknowns(), 81u);
    for (std::size_t i = 0; i < net.nodes.size(); ++i)
      EXPECT_LT((body.displacements()[i] - strain * net.nodes[i]).norm(), 1e-12);
    const std::size_t middle = middle_node(net, {.55, 0, 0});
    double energy = 0, theta = 0;
    for (const auto &bond : net.bonds)
      if (bond.from == middle || bond.to == middle)
      {
        const double pull = bond.way * (strain * bond.xi);
        energy += .25 * bond.stiffness * pull * pull;
        theta += bond.share * (bond.xi * (strain * bond.xi));
      }
    EXPECT_NEAR(theta, trace(strain), 1e-12);
    if (!net.dilatation.empty())
      energy += .5 * net.dilatation[middle] * theta * theta;
    const physics::Lame lame = lame_of(nu);
    const double expected =
        .5 * lame.lambda * trace(strain) * trace(strain) + lame.mu * strain.norm_square();
    EXPECT_NEAR(energy / volume(), expected, 1e-10 * expected) << nu;
  }
}

TEST(FractureInSpace, events_are_those_of_brute_force)
{
  for (const double nu : {.25, .35})
  {
    const BondNetwork<3> net = network(plate(7, 8, 3, 3, nu));
    constexpr std::size_t n = 12;
    const std::vector<Event> expected = by_brute_force(net, n);
    BreakingNetwork<3> body(net, Stretch::linear);
    const Growth growth =
        grow(body, rules(), {}, [](const Growth &now) { return now.events.size() < n; });
    ASSERT_GE(growth.events.size(), n);
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_EQ(growth.events[i].bonds, expected[i].bonds) << i;
      EXPECT_NEAR(growth.events[i].critical / expected[i].critical, 1, 1e-9) << i;
    }
  }
}

TEST(FractureInSpace, every_event_balances_its_energy_until_nothing_is_held)
{
  for (const double nu : {.25, .35})
  {
    BreakingNetwork<3> body(network(plate(10, 8, 3, 4, nu)), Stretch::linear);
    const Growth growth = grow(body, rules());
    // bonds may still join the grips when they carry nothing any more
    EXPECT_TRUE(growth.end == problem::GrowthEnd::parted ||
                growth.end == problem::GrowthEnd::unloaded);
    EXPECT_LT(growth.reaction_left(), 1e-8);
    ASSERT_GT(growth.events.size(), 10u);
    EXPECT_GT(body.work().n_updates, 0u);
    for (const Event &event : growth.events)
    {
      EXPECT_LT(event.imbalance(), 1e-10);
      EXPECT_LT(event.residual, 1e-10);
      EXPECT_GE(event.load, event.critical * (1 - 1e-12));
    }
  }
}

TEST(FractureInSpace, mirror_images_break_together)
{
  const BondNetwork<3> net = network(plate(10, 8, 5, 4));
  BreakingNetwork<3> body(net, Stretch::linear);
  const Growth growth = grow(body, rules());
  const auto mirrored = [&](const Event &event, const Tensor<1, 3> &signs)
  {
    std::set<Ends> as_they_are, images;
    for (const std::size_t b : event.bonds)
    {
      as_they_are.insert(ends_of(net, b, [](const Point<3> &x) { return x; }));
      images.insert(ends_of(net, b,
                            [&](const Point<3> &x) {
                              return Point<3>(signs[0] * x[0], signs[1] * x[1], signs[2] * x[2]);
                            }));
    }
    return as_they_are == images;
  };
  ASSERT_GT(growth.events.size(), 10u);
  for (const Event &event : growth.events)
  {
    EXPECT_TRUE(mirrored(event, Tensor<1, 3>({1, -1, 1}))); // the plane of the notch
    EXPECT_TRUE(mirrored(event, Tensor<1, 3>({1, 1, -1}))); // the middle of the thickness
  }
}

TEST(FractureInSpace, a_body_that_is_moved_and_turned_breaks_in_the_same_way)
{
  const BondNetwork<3> net = network(plate(8, 8, 3, 3));
  BreakingNetwork<3> body(net, Stretch::linear);
  const Growth expected = grow(body, rules());
  // (x, y, z) -> (y, x, z) + shift
  const Tensor<1, 3> shift({7 * h, -3 * h, 11 * h});
  const auto image = [&](const Point<3> &x) { return Point<3>(x[1], x[0], x[2]) + shift; };
  BreakingSolid<3> solid = plate(8, 8, 3, 3);
  for (auto *const boxes : {&solid.domain.include, &solid.grips})
    for (geometry::Cuboid &box : *boxes)
      box = {image(box.lower), image(box.upper)};
  for (Point<2> &x : solid.notch[0])
    x = Point<2>(x[1] + shift[0], x[0] + shift[1]);
  solid.constrained = [&](const Point<3> &x)
  {
    Tensor<1, 3> u;
    u[0] = x[0] > shift[0] ? .5 : -.5;
    return u;
  };
  const BondNetwork<3> turned_net = network(solid);
  BreakingNetwork<3> turned(turned_net, Stretch::linear);
  const Growth growth = grow(turned, rules());
  ASSERT_EQ(growth.events.size(), expected.events.size());
  for (std::size_t i = 0; i < growth.events.size(); ++i)
  {
    EXPECT_NEAR(growth.events[i].critical / expected.events[i].critical, 1, 1e-9) << i;
    std::set<Ends> a, b;
    for (const std::size_t bond : expected.events[i].bonds)
      a.insert(ends_of(net, bond, image));
    for (const std::size_t bond : growth.events[i].bonds)
      b.insert(ends_of(turned_net, bond, [](const Point<3> &x) { return x; }));
    EXPECT_EQ(a, b) << i;
  }
}

TEST(FractureInSpace, multigrid_breaks_the_same_bonds_at_the_same_loads)
{
  const BondNetwork<3> net = network(plate(10, 8, 3, 4));
  BreakingNetwork<3> factored(net, Stretch::linear),
      iterated(net, Stretch::linear, GrowthSolver::multigrid);
  const Growth expected = grow(factored, rules()), growth = grow(iterated, rules());
  EXPECT_EQ(growth.end, expected.end);
  ASSERT_EQ(growth.events.size(), expected.events.size());
  for (std::size_t i = 0; i < growth.events.size(); ++i)
  {
    ASSERT_EQ(growth.events[i].bonds, expected.events[i].bonds) << i;
    EXPECT_NEAR(growth.events[i].critical / expected.events[i].critical, 1, 1e-9) << i;
    EXPECT_LT(growth.events[i].imbalance(), 1e-10) << i;
  }
  EXPECT_LT(iterated.work().most_iterations, 40u);
}

TEST(FractureInSpace, goes_on_from_any_event_to_the_same_bits)
{
  const BondNetwork<3> net = network(plate(10, 8, 3, 4));
  BreakingNetwork<3> whole(net, Stretch::linear);
  const Growth expected = grow(whole, rules());
  for (const std::size_t n : {std::size_t{1}, expected.events.size() / 2})
  {
    BreakingNetwork<3> body(net, Stretch::linear);
    const auto begin = expected.events.begin();
    const Growth growth = grow(body, rules(), {begin, begin + static_cast<std::ptrdiff_t>(n)});
    ASSERT_EQ(growth.events.size(), expected.events.size());
    for (std::size_t i = 0; i < growth.events.size(); ++i)
    {
      const Event &a = growth.events[i], &b = expected.events[i];
      EXPECT_TRUE(a.bonds == b.bonds && a.load == b.load && a.stored == b.stored &&
                  a.work == b.work && a.released == b.released)
          << i;
    }
  }
}

TEST(FractureInSpace, what_hangs_loose_carries_no_force)
{
  const BondNetwork<3> net = network(plate(6, 10, 5, 0));
  const std::size_t node = middle_node(net, {.3, .05, .05});
  // its bonds outside of a plane, then all but those on a line, then all
  std::array<std::vector<std::size_t>, 3> parts;
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
    if (net.bonds[b].from == node || net.bonds[b].to == node)
    {
      const Tensor<1, 3> &xi = net.bonds[b].xi;
      const bool is_in_plane = std::abs(xi[1]) < .5 * h,
                 is_on_line = is_in_plane && std::abs(xi[2]) < .5 * h;
      parts[is_on_line ? 2 : is_in_plane ? 1 : 0].push_back(b);
    }
  for (const GrowthSolver solver : {GrowthSolver::factor, GrowthSolver::multigrid})
    for (const bool is_alone : {false, true})
    {
      BreakingNetwork<3> body(net, Stretch::linear, solver);
      for (const std::vector<std::size_t> &part : parts)
      {
        ASSERT_FALSE(part.empty());
        if (is_alone)
          for (const std::size_t b : part)
            (void)body.break_bonds({b});
        else
          (void)body.break_bonds(part);
        EXPECT_LT(body.response().residual, 1e-11);
        EXPECT_NEAR(body.response().reaction, 2 * body.response().energy,
                    1e-11 * body.response().reaction);
        EXPECT_FALSE(body.is_separated());
      }
    }
}

TEST(FractureInSpace, nodes_are_held_across_the_line_or_plane_of_their_bonds)
{
  const auto unit = [](double x, double y, double z)
  {
    const Tensor<1, 3> v({x, y, z});
    return v / v.norm();
  };
  const Tensor<1, 3> a = unit(1, 2, -2), b = unit(-3, 1, 1), c = unit(.2, -1, 4);
  // free nodes with bonds to nodes in a grip, each in three directions or fewer
  const std::vector<std::vector<Tensor<1, 3>>> ways = {
      {a, b, c},                     // as many as hold it
      {a, -a},                       // on a line
      {a, b, -unit(-2, 3, -1)},      // in a plane, a and b and what is between them
      {a, b, unit(1, 2, -1.999999)}, // in it to 1e-6
      {a, b},                        // two that carry nothing
      {}};
  BondNetwork<3> net;
  net.h = 1;
  net.horizon = 2;
  for (std::size_t i = 0; i < ways.size(); ++i)
    net.nodes.push_back({10. * static_cast<double>(i), 0, 0});
  net.grip.assign(ways.size(), -1);
  for (std::size_t i = 0; i < ways.size(); ++i)
    for (const Tensor<1, 3> &way : ways[i])
    {
      const auto to = static_cast<unsigned int>(net.nodes.size());
      net.nodes.push_back(net.nodes[i] + way);
      net.grip.push_back(0);
      net.bonds.push_back({static_cast<unsigned int>(i), to, way, way, 1, 1, 1});
    }
  net.constrained.resize(net.nodes.size());
  const meshfree::Connections<3> connections(net);
  std::map<std::size_t, std::vector<Tensor<1, 3>>> held;
  for (const auto &hold : connections.holds())
    held[hold.node].push_back(hold.direction);
  const std::array<std::size_t, 6> expected = {0, 2, 1, 1, 1, 3};
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    ASSERT_EQ(held[i].size(), expected[i]) << i;
    EXPECT_EQ(connections.is_loose(i), expected[i] > 0);
    for (std::size_t k = 0; k < held[i].size(); ++k)
    {
      EXPECT_NEAR(held[i][k].norm(), 1, 1e-14);
      for (const Tensor<1, 3> &way : ways[i])
        EXPECT_NEAR(held[i][k] * way, 0, 1e-6) << i;
      for (std::size_t l = 0; l < k; ++l)
        EXPECT_NEAR(held[i][k] * held[i][l], 0, 1e-14) << i;
    }
  }
}

TEST(FractureInSpace, a_notch_cuts_the_bonds_across_its_plane_through_the_thickness)
{
  const BondNetwork<3> net = network(plate(6, 8, 4, 3));
  std::size_t n_left = 0;
  for (const auto &bond : net.bonds)
  {
    const Point<3> &p = net.nodes[bond.from], &q = net.nodes[bond.to];
    if (p[1] * q[1] > 0)
      continue;
    const double x = p[0] + (q[0] - p[0]) * p[1] / (p[1] - q[1]); // in the plane
    EXPECT_GT(x, 3 * h - 1e-9);
    ++n_left;
  }
  for (const auto &ends : net.cut)
  {
    const Point<3> &p = net.nodes[ends[0]], &q = net.nodes[ends[1]];
    EXPECT_LT(p[1] * q[1], 0);
    EXPECT_LT(p[0] + (q[0] - p[0]) * p[1] / (p[1] - q[1]), 3 * h + 1e-9);
  }
  EXPECT_GT(n_left, 0u);
  EXPECT_EQ(net.bonds.size() + net.cut.size(), network(plate(6, 8, 4, 0)).bonds.size());
}

TEST(FractureInSpace, refuses_bodies_that_cannot_be_pulled_apart)
{
  const auto refused = [](const std::function<void(BreakingSolid<3> &)> &change)
  {
    BreakingSolid<3> solid = plate(6, 8, 4, 3);
    change(solid);
    EXPECT_THROW(BreakingNetwork<3>(network(solid), Stretch::linear), InputError);
  };
  refused([](auto &solid) { solid.notch = {{{-h, .5 * h}, {3 * h, .5 * h}}}; }); // through nodes
  refused([](auto &solid) { solid.notch = {{{-h, 0}, {9 * h, 0}}}; });           // apart
  refused([](auto &solid) { solid.notch = {{{-2, 0}, {-1, 0}}}; });              // elsewhere
  refused([](auto &solid) { solid.grips[1] = {{0, 5, 0}, {1, 6, 1}}; });
  refused([](auto &solid) { solid.toughness = [](const Point<3> &x) { return x[2]; }; });
  refused([](auto &solid) { solid.surface_terms = problem::SurfaceTerms::published; });
}
