// Surfaces free of traction: what their terms are for, and cracks that grow with them.

#include "meshfree/fracture/surface_forces.h"

#include "analysis/fracture.h"
#include "meshfree/fracture/breaking_network.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/state_based_operator.h"
#include "physics/state_based.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace
{
  using namespace plumbline;
  using analysis::Growth;
  using dealii::Point;
  using dealii::Tensor;
  using meshfree::BondNetwork;
  using meshfree::BreakingNetwork;
  using meshfree::BreakingSolid;
  using meshfree::Connections;
  using meshfree::SurfaceForces;
  using problem::SurfaceTerms;
  using Field = std::vector<Tensor<1, 2>>;

  constexpr double h = .05, m = 3, length = 40 * h, half = 12 * h;

  geometry::Polyline notch(bool is_through, double tip = length / 2)
  {
    return {{-h, 0}, {is_through ? length + h : tip, 0}};
  }

  /// A plate held at left and right and cut along its middle there, or one held above and below and
  /// cut from the left.
  BondNetwork<2> plate(const physics::Lame &lame, bool is_held_at_ends,
                       SurfaceTerms terms = SurfaceTerms::published, double tip = length / 2)
  {
    constexpr double grip = 2 * m * h;
    BreakingSolid<2> solid;
    solid.domain.include = {{{0, -half}, {length, half}}};
    if (is_held_at_ends)
      solid.grips = {{{0, -half}, {grip, half}}, {{length - grip, -half}, {length, half}}};
    else
      solid.grips = {{{0, half - grip}, {length, half}}, {{0, -half}, {length, grip - half}}};
    solid.notch = {notch(is_held_at_ends, tip)};
    solid.constrained = [](const Point<2> &x)
    {
      Tensor<1, 2> u;
      u[1] = x[1] > 0 ? .5 : -.5;
      return u;
    };
    solid.material = [lame](const Point<2> &) { return lame; };
    solid.toughness = [](const Point<2> &) { return 1.; };
    solid.surface_terms = terms;
    const auto K = physics::influence_function<2>(physics::kernel_type("1/r").profile, m * h);
    return make_bond_network(solid, meshfree::optimisation_based(physics::deviatoric_kernel(K, 1)),
                             K, h, geometry::Backend::fast);
  }

  /// The forces of the operator on nodes, which has ghosts where no node is.
  Field by_operator(const BondNetwork<2> &net, const physics::Lame &lame, const Field &u,
                    SurfaceTerms terms)
  {
    const auto K = physics::influence_function<2>(physics::kernel_type("1/r").profile, net.horizon);
    const auto deviatoric = physics::deviatoric_kernel(K, 1);
    const auto bonds = lattice_bonds(meshfree::optimisation_based(deviatoric), deviatoric, h,
                                     geometry::Backend::fast);
    std::vector<std::size_t> order; // free ones first
    for (const bool is_free : {true, false})
      for (std::size_t i = 0; i < net.nodes.size(); ++i)
        if ((net.grip[i] < 0) == is_free)
          order.push_back(i);
    geometry::NodeCells<2> cells;
    std::map<std::array<long, 2>, unsigned int> number;
    const auto outside = [](const Point<2> &x) {
      return std::max({-x[0], x[0] - length, std::abs(x[1]) - half});
    };
    meshfree::Damage damage{{notch(false)}, {}, terms, outside};
    const auto place = [](const Point<2> &x) {
      return std::array<long, 2>{std::lround(x[0] / h - .5), std::lround(x[1] / h - .5)};
    };
    const auto add = [&](const Point<2> &x, bool is_ghost)
    {
      if (!number.emplace(place(x), cells.nodes.size()).second)
        return;
      cells.source.push_back(cells.nodes.size());
      cells.nodes.push_back(x);
      damage.is_ghost.push_back(is_ghost);
    };
    for (const std::size_t i : order)
      add(net.nodes[i], false);
    cells.n_free = static_cast<std::size_t>(std::count(net.grip.begin(), net.grip.end(), -1));
    for (const Point<2> &x : net.nodes)
      for (const auto &bond : bonds.family)
        add(x + Tensor<1, 2>(bond.xi), true);
    const auto families = [&](std::size_t node, meshfree::Family<2> &family)
    {
      family.bonds = bonds.family;
      family.neighbours.clear();
      for (const auto &bond : bonds.family)
        family.neighbours.push_back(number.at(place(cells.nodes[node] + Tensor<1, 2>(bond.xi))));
    };
    cells.area.assign(cells.size(), h * h);
    const meshfree::StateBasedBody body{
        &cells, {K, [lame](const Point<2> &) { return lame; }, true, true}, damage};
    const auto rows = state_based_operator(families, body, {0, cells.n_free}).rows;
    Field force(u.size());
    for (std::size_t row = 0; row < 2 * cells.n_free; ++row)
      for (const auto &[part, first] :
           {std::pair(&rows.free, std::size_t{0}), {&rows.constrained, cells.n_free}})
        for (std::size_t k = part->start[row]; k < part->start[row + 1]; ++k)
          force[order[row / 2]][row % 2] -=
              h * h * part->value[k] * u[order[first + part->column[k] / 2]][part->column[k] % 2];
    return force;
  }

  Field noise(const BondNetwork<2> &net)
  {
    Field u(net.nodes.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        u[i][d] = std::sin(7. * static_cast<double>(i * i % 101) + d);
    return u;
  }

  double distance_to_corners(const Point<2> &x)
  {
    double least = length;
    for (const Point<2> &corner :
         {Point<2>(0, -half), Point<2>(length, -half), Point<2>(0, half), Point<2>(length, half)})
      least = std::min(least, x.distance(corner));
    return least;
  }

  double largest(const BondNetwork<2> &net, const Field &force)
  {
    double result = 0;
    for (std::size_t i = 0; i < force.size(); ++i)
      if (net.grip[i] < 0)
        result = std::max(result, force[i].norm());
    return result;
  }

  Growth grow(BreakingNetwork<2> &body, std::vector<analysis::Event> earlier = {})
  {
    problem::FractureSettings rules;
    rules.surface_terms = SurfaceTerms::published;
    return analysis::grow(body, rules, std::move(earlier));
  }
} // namespace

TEST(SurfaceForces, vanish_in_uniaxial_stress_along_sides_and_cracks)
{
  for (const physics::Lame &lame : {physics::Lame{1, 1}, {2.5, 1}, {.4, 1}})
  {
    const BondNetwork<2> net = plate(lame, true);
    Field u;
    for (const Point<2> &x : net.nodes)
    {
      u.emplace_back();
      u.back()[0] = x[0];
      u.back()[1] = -lame.lambda / (lame.lambda + 2 * lame.mu) * x[1];
    }
    const double of_strain = 2 * lame.mu * h; // a stress over the side of a cell
    const auto found = [&](SurfaceTerms terms)
    {
      const BondNetwork<2> other = plate(lame, true, terms);
      return largest(other, SurfaceForces(other, Connections<2>(other)).forces(u));
    };
    EXPECT_LT(found(SurfaceTerms::published), 1e-12 * of_strain);
    EXPECT_LT(found(SurfaceTerms::consistent), 1e-12 * of_strain);
    EXPECT_GT(found(SurfaceTerms::none), .05 * of_strain); // bonds that only end there pull
  }
}

TEST(SurfaceForces, are_those_of_the_operator_on_nodes)
{
  for (const physics::Lame &lame : {physics::Lame{1, 1}, {2.5, 1}, {.4, 1}})
    for (const SurfaceTerms terms :
         {SurfaceTerms::published, SurfaceTerms::none, SurfaceTerms::consistent})
    {
      const BondNetwork<2> net = plate(lame, false, terms);
      const Connections<2> connections(net);
      const Field u = noise(net);
      const Field expected = by_operator(net, lame, u, terms);
      Field difference = SurfaceForces(net, connections).forces(u);
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        difference[i] -= expected[i];
        // the zero line of a function has its corners cut off
        if (terms == SurfaceTerms::consistent && distance_to_corners(net.nodes[i]) < 3 * m * h)
          difference[i] = {};
      }
      EXPECT_GT(largest(net, expected), 1);
      EXPECT_LT(largest(net, difference), 1e-12 * largest(net, expected))
          << lame.lambda << ' ' << base::word(terms);
    }
}

TEST(SurfaceForces, are_the_same_whether_a_crack_was_there_or_has_grown)
{
  for (const SurfaceTerms terms : {SurfaceTerms::published, SurfaceTerms::consistent})
  {
    const BondNetwork<2> cut = plate({2.5, 1}, false, terms),
                         net = plate({2.5, 1}, false, terms, length / 4);
    std::set<std::pair<unsigned int, unsigned int>> there;
    for (const BondNetwork<2>::Bond &bond : cut.bonds)
      there.emplace(bond.from, bond.to);
    std::vector<std::size_t> broken;
    for (std::size_t b = 0; b < net.bonds.size(); ++b)
      if (there.count({net.bonds[b].from, net.bonds[b].to}) == 0)
        broken.push_back(b);
    ASSERT_EQ(net.bonds.size(), cut.bonds.size() + broken.size());
    ASSERT_GT(broken.size(), 100u);
    Connections<2> connections(net);
    connections.break_bonds(broken);
    const Field u = noise(net);
    const Field expected = SurfaceForces(cut, Connections<2>(cut)).forces(u);
    Field difference = SurfaceForces(net, connections).forces(u);
    for (std::size_t i = 0; i < u.size(); ++i)
      difference[i] -= expected[i];
    EXPECT_LT(largest(net, difference), 1e-12 * largest(net, expected)) << base::word(terms);
  }
}

// What holds grips is what the rest of the body, which is in equilibrium, exerts on them.
TEST(SurfaceForces, on_grips_are_in_the_reaction)
{
  for (const SurfaceTerms terms : {SurfaceTerms::published, SurfaceTerms::consistent})
  {
    const BondNetwork<2> net = plate({2.5, 1}, false, terms);
    const BreakingNetwork<2> body(net, problem::Stretch::linear);
    const Connections<2> connections(net);
    const Field &u = body.displacements(), forces = SurfaceForces(net, connections).forces(u);
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      sum -= forces[i] * net.constrained[i];
    EXPECT_NEAR(body.response().reaction / sum, 1, 1e-10) << base::word(terms);
  }
}

TEST(SurfaceForces, see_the_dilatation_of_linear_fields_at_sides_corners_and_tips)
{
  const BondNetwork<2> net = plate({2, 1}, false);
  const Connections<2> connections(net);
  Field u;
  for (const Point<2> &x : net.nodes)
  {
    u.emplace_back();
    u.back()[0] = 2 * x[0] + 3 * x[1];
    u.back()[1] = 5 * x[0] - .5 * x[1];
  }
  for (const double theta : SurfaceForces(net, connections).dilatations(u))
    EXPECT_NEAR(theta, 1.5, 1e-12);
}

TEST(SurfaceForces, are_in_equilibrium_while_a_crack_grows_and_go_on_to_the_same_bits)
{
  for (const auto &[lambda, terms] :
       {std::pair(1., SurfaceTerms::published), std::pair(1.5, SurfaceTerms::published),
        std::pair(1.5, SurfaceTerms::consistent)})
  {
    const BondNetwork<2> net = plate({lambda, 1}, false, terms);
    BreakingNetwork<2> body(net, problem::Stretch::linear);
    EXPECT_FALSE(body.has_energy());
    const Growth growth = grow(body);
    ASSERT_GT(growth.events.size(), 50u);
    EXPECT_TRUE(growth.end == problem::GrowthEnd::unloaded ||
                growth.end == problem::GrowthEnd::parted);
    double imbalance = 0;
    for (const analysis::Event &event : growth.events)
    {
      EXPECT_LT(event.residual, 1e-10);
      imbalance = std::max(imbalance, event.imbalance());
    }
    EXPECT_GT(imbalance, 1e-3); // no energy has these forces
    EXPECT_GT(body.work().n_updates, 5 * body.work().n_factorisations);
    EXPECT_LT(body.work().most_iterations, 60u);

    const auto half = static_cast<std::ptrdiff_t>(growth.events.size() / 2);
    BreakingNetwork<2> again(net, problem::Stretch::linear);
    const Growth later = grow(again, {growth.events.begin(), growth.events.begin() + half});
    ASSERT_EQ(later.events.size(), growth.events.size());
    for (std::size_t i = 0; i < later.events.size(); ++i)
      EXPECT_TRUE(later.events[i].bonds == growth.events[i].bonds &&
                  later.events[i].load == growth.events[i].load &&
                  later.events[i].reaction == growth.events[i].reaction)
          << i;
  }
}
