// Bonds that break in equilibrium: against brute force, the audit of energy, mirror images, damage
// beside a crack, what hangs loose, and going on.

#include "analysis/fracture.h"
#include "base/error.h"
#include "growth_plate.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
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
  using meshfree::BondNetwork;
  using meshfree::BreakingNetwork;
  using meshfree::BreakingSolid;
  using namespace growth_plate;

  const double inf = std::numeric_limits<double>::infinity();

  /// The same by a factorisation at every event, written without the library.
  std::vector<Event> by_brute_force(const BondNetwork<2> &net, std::size_t n_events)
  {
    using Sparse = Eigen::SparseMatrix<double>;
    std::vector<int> unknown;
    int n = 0;
    for (const int grip : net.grip)
    {
      unknown.push_back(grip < 0 ? n : -1);
      n += grip < 0 ? 2 : 0;
    }
    std::vector<char> is_whole(net.bonds.size(), 1);
    std::vector<Event> events;
    while (events.size() < n_events)
    {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
      for (std::size_t i = 0; i < net.loads.size(); ++i)
        for (unsigned int d = 0; d < 2 && unknown[i] >= 0; ++d)
          b[unknown[i] + static_cast<int>(d)] = net.loads[i][d];
      std::vector<Eigen::Triplet<double>> entries;
      // k (c·u + o)² of a linear form c over nodes
      const auto add = [&](double k, const std::map<unsigned int, Tensor<1, 2>> &form)
      {
        double o = 0;
        for (const auto &[node, c] : form)
          o += c * net.constrained[node];
        for (const auto &[i, ci] : form)
          for (unsigned int d = 0; d < 2 && unknown[i] >= 0; ++d)
          {
            b[unknown[i] + static_cast<int>(d)] -= k * o * ci[d];
            for (const auto &[j, cj] : form)
              for (unsigned int e = 0; e < 2 && unknown[j] >= 0; ++e)
                entries.emplace_back(unknown[i] + static_cast<int>(d),
                                     unknown[j] + static_cast<int>(e), k * ci[d] * cj[e]);
          }
      };
      std::vector<std::map<unsigned int, Tensor<1, 2>>> dilatation(net.dilatation.size());
      for (std::size_t i = 0; i < net.bonds.size(); ++i)
        if (is_whole[i])
        {
          const auto &bond = net.bonds[i];
          add(bond.stiffness, {{bond.from, -bond.way}, {bond.to, bond.way}});
          if (!dilatation.empty())
            for (const unsigned int node : {bond.from, bond.to})
            {
              dilatation[node][bond.from] -= bond.share * bond.xi;
              dilatation[node][bond.to] += bond.share * bond.xi;
            }
        }
      for (std::size_t i = 0; i < dilatation.size(); ++i)
        add(net.dilatation[i], dilatation[i]);
      Sparse A(n, n);
      A.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Sparse> cholesky(A);
      const Eigen::VectorXd x = cholesky.solve(b);
      const auto u = [&](unsigned int node)
      {
        Tensor<1, 2> result = net.constrained[node];
        for (unsigned int d = 0; d < 2 && unknown[node] >= 0; ++d)
          result[d] = x[unknown[node] + static_cast<int>(d)];
        return result;
      };
      std::vector<double> loads(net.bonds.size(), inf);
      for (std::size_t i = 0; i < net.bonds.size(); ++i)
        if (const auto &bond = net.bonds[i]; is_whole[i])
        {
          const double s = bond.xi * (u(bond.to) - u(bond.from)) / bond.xi.norm_square();
          loads[i] = s > 0 ? bond.critical / s : inf;
        }
      Event event;
      event.critical = *std::min_element(loads.begin(), loads.end());
      for (std::size_t i = 0; i < loads.size(); ++i)
        if (loads[i] <= event.critical * (1 + 1e-6))
        {
          event.bonds.push_back(i);
          is_whole[i] = 0;
        }
      events.push_back(event);
    }
    return events;
  }

  std::vector<std::size_t> all_broken(const Growth &growth)
  {
    std::vector<std::size_t> result;
    for (const Event &event : growth.events)
      result.insert(result.end(), event.bonds.begin(), event.bonds.end());
    return result;
  }

  /// Two layers, the crack between them.
  BreakingSolid<2> layers(int n1, int n2, double notch)
  {
    BreakingSolid<2> solid = plate(n1, n2, notch, .25);
    solid.material = [](const Point<2> &x)
    {
      return x[1] > 0 ? physics::lame_from_young(3, .1, physics::PlaneState::strain)
                      : physics::lame_from_young(1, .35, physics::PlaneState::strain);
    };
    return solid;
  }

  void expect_same_as_brute_force(const BreakingSolid<2> &solid, std::size_t n_events)
  {
    const BondNetwork<2> net = network(solid);
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    const Growth growth = grow(body, rules());
    ASSERT_GE(growth.events.size(), n_events);
    EXPECT_LT(body.work().n_factorisations, growth.events.size() / 5);
    const std::vector<Event> expected = by_brute_force(net, n_events);
    for (std::size_t i = 0; i < n_events; ++i)
    {
      ASSERT_EQ(growth.events[i].bonds, expected[i].bonds) << i;
      EXPECT_NEAR(growth.events[i].critical / expected[i].critical, 1, 1e-9) << i;
    }
  }
} // namespace

TEST(Fracture, events_are_those_of_brute_force_on_a_plate_of_bonds)
{
  expect_same_as_brute_force(plate(40, 20, 20 * h, .25), 200);
}

TEST(Fracture, events_are_those_of_brute_force_on_a_plate_with_dilatations)
{
  expect_same_as_brute_force(plate(40, 20, 20 * h, .35), 60);
  expect_same_as_brute_force(plate(40, 20, 20 * h, .1), 30);
  expect_same_as_brute_force(layers(40, 20, 20 * h), 40);
}

namespace
{
  /// The plate without its upper grip, which a traction pulls in its last row instead.
  BreakingSolid<2> pulled(BreakingSolid<2> solid)
  {
    const double top = solid.grips[0].upper[1];
    solid.grips.erase(solid.grips.begin());
    solid.constrained = [](const Point<2> &) { return Tensor<1, 2>(); };
    solid.load = [top](const Point<2> &x) {
      return x[1] > top - h ? Tensor<1, 2>({0, 1 / h}) : Tensor<1, 2>();
    };
    return solid;
  }
} // namespace

TEST(Fracture, events_under_a_traction_are_those_of_brute_force)
{
  for (const double nu : {.25, .3})
    expect_same_as_brute_force(pulled(plate(20, 14, .3, nu)), 10);
}

TEST(Fracture, traction_and_grips_superpose_and_the_energy_is_accounted_for)
{
  const BreakingSolid<2> grips = plate(20, 14, .3, .3);
  BreakingSolid<2> load = grips, both = grips;
  load.constrained = [](const Point<2> &) { return Tensor<1, 2>(); };
  load.load = both.load = [](const Point<2> &x) { return Tensor<1, 2>({x[1], 1 + x[0]}); };
  const auto reaction = [](const BreakingSolid<2> &solid)
  { return BreakingNetwork<2>(network(solid), problem::Stretch::linear).response().reaction; };
  // by Betti's theorem the work of each through the other cancels
  EXPECT_NEAR(reaction(both), reaction(grips) + reaction(load), 1e-12 * reaction(both));

  BreakingNetwork<2> body(network(pulled(grips)), problem::Stretch::linear);
  EXPECT_NEAR(body.response().energy, .5 * body.response().reaction,
              1e-12 * body.response().energy);
  for (const Event &event : grow(body, rules()).events)
    EXPECT_LT(event.imbalance(), 1e-10);
}

namespace
{
  /// Bonds by where they broke: beside the notch's line, at loaded nodes, and elsewhere.
  struct Broken
  {
    std::size_t at_notch = 0, at_loads = 0, elsewhere = 0;
  };

  /// Pull until no loaded node is connected any more.
  Broken pull_apart(const BreakingSolid<2> &solid)
  {
    const BondNetwork<2> net = network(solid);
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    const Growth growth = grow(body, rules());
    EXPECT_EQ(growth.end, problem::GrowthEnd::parted);
    EXPECT_TRUE(growth.is_separated);
    EXPECT_EQ(growth.load_left, 0.);
    Broken broken;
    for (const std::size_t b : all_broken(growth))
    {
      const auto [from, to] = std::pair(net.bonds[b].from, net.bonds[b].to);
      const double middle = .5 * (net.nodes[from][1] + net.nodes[to][1]);
      ++(net.loads[from].norm() + net.loads[to].norm() > 0 ? broken.at_loads
         : std::abs(middle) < 3 * h                        ? broken.at_notch
                                                           : broken.elsewhere);
    }
    return broken;
  }
} // namespace

// A body also counts as separated where its loaded nodes have broken off, each alone.
TEST(Fracture, a_traction_drives_a_crack_across_the_body_or_breaks_off_the_loaded_row)
{
  for (const double nu : {.25, .3})
  {
    const Broken crossed = pull_apart(pulled(plate(20, 14, .5, nu)));
    EXPECT_GT(crossed.at_notch, 0u);
    EXPECT_EQ(crossed.at_loads, 0u);
    EXPECT_EQ(crossed.elsewhere, 0u);

    BreakingSolid<2> tough = pulled(plate(20, 14, .1, nu));
    tough.toughness = [](const Point<2> &x) { return x[1] < 4 * h ? 100. : 1.; };
    const Broken crumbled = pull_apart(tough);
    EXPECT_EQ(crumbled.at_notch, 0u);
    EXPECT_GT(crumbled.at_loads, 0u);
  }
}

TEST(Fracture, nodes_that_come_loose_lose_their_part_of_the_dead_loads)
{
  BreakingSolid<2> solid = pulled(plate(20, 14, .5, .3));
  solid.load = [even = solid.load](const Point<2> &x) { return (1 + x[0]) * even(x); };
  const BondNetwork<2> net = network(solid);
  BreakingNetwork<2> body(net, problem::Stretch::linear);
  EXPECT_EQ(body.load_left(), 1.);
  double all = 0;
  std::size_t node = 0; // the one with the largest load
  for (std::size_t i = 0; i < net.nodes.size(); ++i)
  {
    all += net.loads[i].norm();
    node = net.loads[i].norm() > net.loads[node].norm() ? i : node;
  }
  std::vector<std::size_t> own;
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
    if (net.bonds[b].from == node || net.bonds[b].to == node)
      own.push_back(b);
  (void)body.break_bonds(own);
  EXPECT_FALSE(body.is_separated());
  EXPECT_NEAR(body.load_left().value(), 1 - net.loads[node].norm() / all, 1e-14);

  const BreakingNetwork<2> held(network(plate(20, 14, .5, .3)), problem::Stretch::linear);
  EXPECT_FALSE(held.load_left().has_value());
}

// Of long strips between rigid grips: each length more costs half of the layers' modulus in series
// over the height, but for what grips do within a horizon.
TEST(Fracture, layers_have_the_energy_of_their_local_limit)
{
  const auto modulus = [](double E, double nu)
  {
    const physics::Lame lame = physics::lame_from_young(E, nu, physics::PlaneState::strain);
    return lame.lambda + 2 * lame.mu;
  };
  const auto K = influence(3 * h);
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) // rows between the grips
  {
    const auto energy = [&](int n1)
    {
      const BondNetwork<2> net = make_bond_network(
          layers(n1, n + 6, 0), meshfree::optimisation_based(physics::deviatoric_kernel(K, 1)), K,
          h, geometry::Backend::fast);
      return BreakingNetwork<2>(net, problem::Stretch::linear).response().energy;
    };
    const double of_length = (energy(4 * n) - energy(3 * n)) / (n * h), height = n * h;
    const double local = .5 / (.5 * height / modulus(3, .1) + .5 * height / modulus(1, .35));
    errors.push_back(of_length / local - 1);
  }
  EXPECT_LT(std::abs(errors[0]), .2);
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i] / errors[i - 1], .5, .1) << errors[i];
}

TEST(Fracture, every_event_accounts_for_the_energy)
{
  for (const BreakingSolid<2> &solid :
       {plate(30, 20, 10 * h, .25), plate(30, 20, 10 * h, .35), layers(30, 20, 10 * h)})
    for (const auto breaking : {problem::BreakMode::events, problem::BreakMode::batches})
    {
      BreakingNetwork<2> body(network(solid), problem::Stretch::linear);
      const Growth growth = grow(body, rules(breaking));
      EXPECT_TRUE(growth.end == problem::GrowthEnd::parted ||
                  growth.events.back().reaction < 1e-9 * growth.events.front().reaction);
      for (const Event &event : growth.events)
      {
        EXPECT_LT(event.imbalance(), 1e-10);
        EXPECT_LT(event.residual, 1e-11);
        EXPECT_GE(event.released, 0);
      }
      // grips that are rigid leave nothing stored in halves that have parted
      EXPECT_LT(std::abs(growth.events.back().stored), 1e-12 * growth.events.back().work);
    }
}

TEST(Fracture, mirror_images_break_together_if_ties_do)
{
  const BondNetwork<2> net = network(plate(30, 20, 10 * h, .25));
  const auto asymmetry = [&](double ties)
  {
    std::map<std::array<long, 4>, std::size_t> place;
    const auto key = [&](Point<2> a, Point<2> b, double sign)
    {
      std::array<std::array<long, 2>, 2> ends{};
      for (unsigned int d = 0; d < 2; ++d)
      {
        ends[0][d] = std::lround(a[d] * (d == 1 ? sign : 1) / h * 2);
        ends[1][d] = std::lround(b[d] * (d == 1 ? sign : 1) / h * 2);
      }
      std::sort(ends.begin(), ends.end());
      return std::array<long, 4>{ends[0][0], ends[0][1], ends[1][0], ends[1][1]};
    };
    for (std::size_t b = 0; b < net.bonds.size(); ++b)
      place[key(net.nodes[net.bonds[b].from], net.nodes[net.bonds[b].to], 1)] = b;
    auto events = rules();
    events.tie_tolerance = ties;
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    std::size_t n_alone = 0;
    for (const Event &event : grow(body, events).events)
      for (const std::size_t b : event.bonds)
        if (std::find(event.bonds.begin(), event.bonds.end(),
                      place.at(key(net.nodes[net.bonds[b].from], net.nodes[net.bonds[b].to],
                                   -1))) == event.bonds.end())
          ++n_alone;
    return n_alone;
  };
  EXPECT_EQ(asymmetry(1e-6), 0u);
  EXPECT_GT(asymmetry(0), 0u);
}

TEST(Fracture, damage_beside_a_straight_crack_counts_its_bonds)
{
  const BondNetwork<2> net = network(plate(30, 20, 20 * h, .25));
  const std::vector<double> damage = net.damage({});
  for (std::size_t i = 0; i < net.nodes.size(); ++i)
    if (const Point<2> &x = net.nodes[i]; x[0] > 5 * h && x[0] < 15 * h)
    {
      const auto row = static_cast<int>(std::lround(std::abs(x[1]) / h - .5));
      const double expected = row == 0 ? 11. / 28 : row == 1 ? 6. / 28 : row == 2 ? 1. / 28 : 0;
      if (net.grip[i] < 0)
      {
        EXPECT_NEAR(damage[i], expected, 1e-15) << x;
      }
    }
}

TEST(Fracture, toughness_of_lattices_tends_to_that_of_the_law)
{
  // of a straight cut with the optimisation-based rule, by m
  const std::map<int, double> expected = {{2, .7854}, {3, .9158}, {4, .9445},
                                          {5, .9855}, {6, .9890}, {8, .9973}};
  for (const auto &[m, value] : expected)
  {
    const auto K = influence(m * h);
    const auto rule = meshfree::optimisation_based(physics::deviatoric_kernel(K, 1));
    EXPECT_NEAR(lattice_toughness(rule, K, h, geometry::Backend::fast), value, 5e-5) << m;
  }
}

TEST(Fracture, toughness_of_lattices_tends_to_that_of_the_law_for_all_influence_functions)
{
  for (const char *const type : {"constant", "conical"})
  {
    const auto toughness = [&](int m)
    {
      const auto K = physics::influence_function<2>(physics::kernel_type(type).profile, m * h);
      return lattice_toughness(meshfree::partial_area(physics::deviatoric_kernel(K, 1)), K, h,
                               geometry::Backend::fast);
    };
    EXPECT_NEAR(toughness(4), 1, .06) << type;
    EXPECT_NEAR(toughness(16), 1, .006) << type;
  }
}

TEST(Fracture, events_are_those_of_brute_force_with_a_conical_influence_function)
{
  const BreakingSolid<2> solid = plate(30, 16, 12 * h, .35);
  const auto K = physics::influence_function<2>(physics::kernel_type("conical").profile, 3 * h);
  const BondNetwork<2> net = make_bond_network(
      solid, meshfree::full_area(physics::deviatoric_kernel(K, 1)), K, h, geometry::Backend::fast);
  BreakingNetwork<2> body(net, problem::Stretch::linear);
  const Growth growth = grow(body, rules());
  const std::vector<Event> expected = by_brute_force(net, 20);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    ASSERT_EQ(growth.events[i].bonds, expected[i].bonds) << i;
    EXPECT_NEAR(growth.events[i].critical / expected[i].critical, 1, 1e-9) << i;
  }
  for (const Event &event : growth.events)
    EXPECT_LT(event.imbalance(), 1e-10);
}

TEST(Fracture, toughness_of_a_lattice_depends_on_the_direction_of_a_cut)
{
  const auto K = influence(3 * h);
  const auto rule = meshfree::optimisation_based(physics::deviatoric_kernel(K, 1));
  const auto along = [&](int p, int q) {
    return lattice_toughness(rule, K, h, geometry::Backend::fast, {p, q});
  };
  EXPECT_NEAR(along(3, 1), .9551, 5e-5); // 18.4 degrees
  EXPECT_NEAR(along(2, 1), .9411, 5e-5); // 26.6
  EXPECT_NEAR(along(1, 1), .9130, 5e-5); // 45
  // a line is that of any of its steps and of its mirror images
  EXPECT_NEAR(along(4, -2), along(2, 1), 1e-14);
  EXPECT_NEAR(along(-1, 2), along(2, 1), 1e-14);
  EXPECT_NEAR(along(0, 1), lattice_toughness(rule, K, h, geometry::Backend::fast), 1e-14);
}

TEST(Fracture, grips_hold_the_nodes_whose_cells_share_area_with_them)
{
  const auto rows = [](double thickness, double length)
  {
    BreakingSolid<2> solid = plate(10, 16, 2 * h, .25);
    solid.grips[0].lower[1] = solid.grips[0].upper[1] - thickness * h;
    solid.grips[0].upper[0] = length * h;
    const BondNetwork<2> net = network(solid);
    return std::count(net.grip.begin(), net.grip.end(), 0);
  };
  EXPECT_EQ(rows(3, 10), 30);
  EXPECT_EQ(rows(2.9, 10), 30); // the third row's cells reach into it
  EXPECT_EQ(rows(2.1, 10), 30); // though their nodes are outside
  EXPECT_EQ(rows(2, 10), 20);
  EXPECT_EQ(rows(.2, 10), 10);
  EXPECT_EQ(rows(2.1, 4.3), 15);
  EXPECT_EQ(rows(2 + 1e-12, 5 - 1e-12), 10); // rounding is no area
}

TEST(Fracture, finite_stretches_reach_their_limits_at_critical_loads)
{
  const BondNetwork<2> net = network(plate(20, 16, 5 * h, .25));
  for (const auto stretch : {problem::Stretch::finite, problem::Stretch::linear})
  {
    const BreakingNetwork<2> body(net, stretch);
    for (std::size_t b = 0; b < net.bonds.size(); ++b)
    {
      const BondNetwork<2>::Bond &bond = net.bonds[b];
      const double load = body.response().critical_loads[b];
      if (!std::isfinite(load))
        continue;
      const Tensor<1, 2> du =
          load * (body.displacements()[bond.to] - body.displacements()[bond.from]);
      const double s = stretch == problem::Stretch::finite
                           ? (bond.xi + du).norm() / bond.xi.norm() - 1
                           : bond.xi * du / bond.xi.norm_square();
      EXPECT_NEAR(s, bond.critical, 1e-9 * bond.critical) << b;
    }
  }
}

TEST(Fracture, bonds_between_materials_have_means_of_both_ends)
{
  BreakingSolid<2> solid = plate(10, 16, 2 * h, .25);
  solid.material = [](const Point<2> &x) {
    return physics::Lame{x[0] < .25 ? 1. : 3., x[0] < .25 ? 1. : 3.};
  };
  solid.toughness = [](const Point<2> &x) { return x[0] < .25 ? 1. : 5.; };
  const BondNetwork<2> net = network(solid);
  const BondNetwork<2> soft = network(plate(10, 16, 2 * h, .25));
  // at λ = μ = 1 and G = 1; s0² goes with G/(2μ)
  const double first = M_PI / (6 * 3 * h);
  for (const BondNetwork<2>::Bond &bond : net.bonds)
  {
    const int n_right =
        (net.nodes[bond.from][0] > .25 ? 1 : 0) + (net.nodes[bond.to][0] > .25 ? 1 : 0);
    const double G = std::array{1., 3., 5.}[static_cast<std::size_t>(n_right)],
                 mu = std::array{1., 1.5, 3.}[static_cast<std::size_t>(n_right)];
    if (std::isfinite(bond.critical))
    {
      EXPECT_NEAR(bond.critical * bond.critical, first * G / mu, 1e-12 * first);
    }
  }
  EXPECT_TRUE(net.dilatation.empty());
  EXPECT_EQ(net.bonds.size(), soft.bonds.size());
}

TEST(Fracture, bonds_across_an_interface_have_its_toughness)
{
  BreakingSolid<2> solid = plate(10, 16, 2 * h, .25);
  const BondNetwork<2> plain = network(solid);
  double y = plain.nodes[0][1]; // between two rows, above those of the notch
  for (const Point<2> &x : plain.nodes)
    y = std::max(y, x[1]);
  y -= 4.5 * h;
  solid.interfaces = {{{{-1, y}, {6.3 * h, y}}, .04}, {{{3 * h, y + 1}, {3 * h, y}}, .01}};
  const BondNetwork<2> net = network(solid);
  ASSERT_EQ(net.bonds.size(), plain.bonds.size());
  std::size_t n_first = 0, n_second = 0;
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
  {
    const Point<2> from = net.nodes[net.bonds[b].from], to = net.nodes[net.bonds[b].to];
    const auto crosses = [&](double at, unsigned int d, double least, double most)
    {
      const double s = (at - from[d]) / (to[d] - from[d]);
      const double along = from[1 - d] + s * (to[1 - d] - from[1 - d]);
      return s > 0 && s < 1 && along > least + 1e-9 && along < most - 1e-9; // an end is free
    };
    const bool is_first = crosses(y, 1, -1, 6.3 * h), is_second = crosses(3 * h, 0, y, y + 1);
    n_first += is_first ? 1 : 0;
    n_second += is_second ? 1 : 0;
    const double G = is_second ? .01 : is_first ? .04 : 1;
    EXPECT_EQ(net.toughness[b], G);
    if (std::isfinite(plain.bonds[b].critical))
    {
      EXPECT_NEAR(net.bonds[b].critical, std::sqrt(G) * plain.bonds[b].critical, 1e-14);
    }
  }
  EXPECT_GT(n_first, 20u);
  EXPECT_GT(n_second, 20u);
  solid.interfaces = {{{{5, y}, {6, y}}, 1}};
  EXPECT_THROW(network(solid), InputError); // nowhere near
}

TEST(Fracture, the_least_toughness_along_a_bond_is_seen_between_nodes)
{
  BreakingSolid<2> solid = plate(10, 16, 2 * h, .25);
  const double y = network(solid).nodes[0][1] + 6.5 * h; // between two rows
  solid.toughness = [y](const Point<2> &x) { return std::abs(x[1] - y) < .2 * h ? .25 : 1; };
  const BondNetwork<2> mean = network(solid);
  solid.takes_least_toughness = true;
  const BondNetwork<2> least = network(solid);
  std::size_t n_weak = 0;
  for (std::size_t b = 0; b < least.bonds.size(); ++b)
  {
    const double from = least.nodes[least.bonds[b].from][1], to = least.nodes[least.bonds[b].to][1];
    const bool is_across = (from - y) * (to - y) < 0;
    n_weak += is_across ? 1 : 0;
    EXPECT_EQ(least.toughness[b], is_across ? .25 : 1);
    EXPECT_EQ(mean.toughness[b], 1);
    if (std::isfinite(mean.bonds[b].critical))
    {
      EXPECT_NEAR(least.bonds[b].critical, (is_across ? .5 : 1) * mean.bonds[b].critical, 1e-14);
    }
  }
  EXPECT_GT(n_weak, 20u);
}

TEST(Fracture, goes_on_from_any_event_to_the_same_bits)
{
  const BondNetwork<2> net = network(plate(40, 20, 20 * h, .25));
  BreakingNetwork<2> whole(net, problem::Stretch::finite);
  const Growth expected = grow(whole, rules());
  ASSERT_GT(whole.work().n_factorisations, 3u);
  for (const std::size_t n :
       {std::size_t{1}, expected.events.size() / 2, expected.events.size() - 2})
  {
    BreakingNetwork<2> body(net, problem::Stretch::finite);
    const auto begin = expected.events.begin();
    const Growth growth = grow(body, rules(), {begin, begin + static_cast<std::ptrdiff_t>(n)});
    EXPECT_EQ(growth.n_resumed, n);
    ASSERT_EQ(growth.events.size(), expected.events.size());
    for (std::size_t i = 0; i < growth.events.size(); ++i)
    {
      const Event &a = growth.events[i], &b = expected.events[i];
      EXPECT_TRUE(a.bonds == b.bonds && a.load == b.load && a.critical == b.critical &&
                  a.stored == b.stored && a.work == b.work && a.released == b.released)
          << i;
    }
  }
}

TEST(Fracture, what_hangs_loose_carries_no_force)
{
  const BondNetwork<2> net = network(plate(20, 16, 5 * h, .25));
  // a free node, and one beside it
  std::size_t node = 0;
  while (net.grip[node] >= 0 || net.nodes[node][0] < 10 * h || net.nodes[node][1] < 0)
    ++node;
  std::vector<std::size_t> own, row;
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
    if (net.bonds[b].from == node || net.bonds[b].to == node)
      (std::abs(net.bonds[b].xi[1]) > 1e-12 ? own : row).push_back(b);
  for (const bool is_at_once : {true, false})
  {
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    (void)body.break_bonds(own); // its bonds lie on a line
    EXPECT_LT(body.response().residual, 1e-12);
    if (is_at_once)
      (void)body.break_bonds(row);
    else
      for (const std::size_t b : row)
        (void)body.break_bonds({b});
    EXPECT_LT(body.response().residual, 1e-12);
    EXPECT_NEAR(body.response().reaction, 2 * body.response().energy,
                1e-12 * body.response().reaction);
    EXPECT_FALSE(body.is_separated());
  }
}

TEST(Fracture, a_piece_that_no_grip_holds_carries_no_force)
{
  const BondNetwork<2> net = network(plate(20, 16, 5 * h, .25));
  const auto is_in = [&](unsigned int node) {
    return net.nodes[node].distance({10 * h, 0}) < 2.2 * h;
  };
  std::vector<std::size_t> around;
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
    if (is_in(net.bonds[b].from) != is_in(net.bonds[b].to))
      around.push_back(b);
  BreakingNetwork<2> body(net, problem::Stretch::linear);
  (void)body.break_bonds(around);
  EXPECT_LT(body.response().residual, 1e-12);
  for (std::size_t b = 0; b < net.bonds.size(); ++b)
    if (is_in(net.bonds[b].from) && is_in(net.bonds[b].to))
    {
      EXPECT_EQ(body.response().critical_loads[b], inf);
    }
}

TEST(Fracture, ends_where_it_is_told_to)
{
  const auto end = [](const std::function<void(problem::FractureSettings &)> &change)
  {
    problem::FractureSettings section = rules();
    change(section);
    BreakingNetwork<2> body(network(plate(20, 16, 10 * h, .25)), problem::Stretch::linear);
    Growth growth = grow(body, section);
    EXPECT_EQ(growth.is_separated, body.is_separated());
    return growth;
  };
  const Growth whole = end([](auto &) {});
  EXPECT_NE(whole.end, problem::GrowthEnd::loaded);
  const Growth unloaded = end([](auto &section) { section.least_reaction = .5; });
  EXPECT_EQ(unloaded.end, problem::GrowthEnd::unloaded);
  EXPECT_FALSE(unloaded.is_separated);
  EXPECT_LE(unloaded.reaction_left(), .5);
  EXPECT_GT(unloaded.reaction_left(), .1);
  EXPECT_LT(unloaded.events.size(), whole.events.size());
  const double first = whole.events.front().load;
  const Growth loaded = end([&](auto &section) { section.largest_load = .5 * first; });
  EXPECT_EQ(loaded.end, problem::GrowthEnd::loaded);
  EXPECT_TRUE(loaded.events.empty());
  EXPECT_FALSE(loaded.is_separated);
  EXPECT_EQ(loaded.reaction_left(), 1);
}

TEST(Fracture, load_steps_break_more_bonds_than_events)
{
  const auto n_broken = [](problem::BreakMode breaking, double step)
  {
    problem::FractureSettings section = rules(breaking);
    section.load_step = step;
    BreakingNetwork<2> body(network(plate(40, 20, 20 * h, .25)), problem::Stretch::linear);
    return all_broken(grow(body, section)).size();
  };
  const std::size_t events = n_broken(problem::BreakMode::events, 0);
  EXPECT_GT(n_broken(problem::BreakMode::batches, 0), events);
  EXPECT_GT(n_broken(problem::BreakMode::steps, 1), 1.2 * static_cast<double>(events));
}

TEST(Fracture, refuses_bodies_that_cannot_be_pulled_apart)
{
  const auto refused = [](const std::function<void(BreakingSolid<2> &)> &change)
  {
    BreakingSolid<2> solid = plate(20, 16, 10 * h, .25);
    change(solid);
    EXPECT_THROW(BreakingNetwork<2>(network(solid), problem::Stretch::linear), InputError);
  };
  refused([](auto &solid) { solid.toughness = [](const Point<2> &x) { return x[0] - .5; }; });
  refused([](auto &solid) { solid.notch = {{{-1, .3 * h}, {-.5, .3 * h}}}; });
  refused([](auto &solid) { solid.notch = {{{-h, .5 * h}, {10 * h, .5 * h}}}; });
  refused([](auto &solid) { solid.notch = {{{-h, 0}, {30 * h, 0}}}; });
  refused([](auto &solid) { solid.grips[1] = {{0, 5}, {1, 6}}; });
}
