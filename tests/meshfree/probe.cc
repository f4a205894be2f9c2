// Force constants by differences of forces, of programs that are known to the last bit.
#include "meshfree/check/probe.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace plumbline;
using namespace plumbline::meshfree;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double h = .1;

  template <int dim>
  std::vector<Point<dim>> lattice(int n, double perturbation = 0)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-perturbation, perturbation);
    std::vector<Point<dim>> places;
    std::array<int, 3> at{};
    for (at[2] = 0; at[2] < (dim == 3 ? n : 1); ++at[2])
      for (at[1] = 0; at[1] < n; ++at[1])
        for (at[0] = 0; at[0] < n; ++at[0])
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = h * (at[d] + off(random));
          places.push_back(x);
        }
    return places;
  }

  using Bonds = std::map<std::pair<std::size_t, std::size_t>, double>;

  /// The force on node i by the bond to node j is `of_pair` of its vector and the nodes' relative
  /// displacement, times a force constant of its own.
  template <int dim>
  struct Program
  {
    std::vector<Point<dim>> places;
    Bonds bonds;
    std::function<Tensor<1, dim>(const Tensor<1, dim> &xi, const Tensor<1, dim> &eta)> of_pair;

    NodeVectors<dim> operator()(const NodeVectors<dim> &displacements) const
    {
      NodeVectors<dim> result(places.size());
      for (const auto &[pair, constant] : bonds)
      {
        const auto [i, j] = pair;
        result[i] += constant * of_pair(places[j] - places[i], displacements[j] - displacements[i]);
      }
      return result;
    }
  };

  template <int dim>
  Tensor<1, dim> linear(const Tensor<1, dim> &xi, const Tensor<1, dim> &eta)
  {
    return (xi * eta) / xi.norm_square() * xi;
  }

  /// With different force constants, alike from both ends.
  template <int dim>
  Program<dim> program(const std::vector<Point<dim>> &places, double horizon)
  {
    Program<dim> result{places, {}, linear<dim>};
    std::mt19937 random(2);
    std::uniform_real_distribution<double> constant(1, 2);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (places[i].distance(places[j]) <= (1 + 1e-9) * horizon) // of lattices: to rounding
          result.bonds[{i, j}] = result.bonds[{j, i}] = constant(random);
    return result;
  }

  template <int dim>
  ProbeFindings probe_all(const Program<dim> &program, double horizon, std::size_t n_nodes,
                          double step = 1e-6)
  {
    return probe<dim>(plan_probe(program.places, {horizon, step, n_nodes}), program);
  }

  /// @return  whether `probe` refuses with these words
  template <int dim>
  bool is_refused(const Program<dim> &program, double horizon, const std::string &words)
  {
    try
    {
      probe_all(program, horizon, 4);
    }
    catch (const InputError &error)
    {
      return std::string(error.what()).find(words) != std::string::npos;
    }
    return false;
  }

  template <int dim>
  void expect_recovered(const std::vector<Point<dim>> &places, double horizon)
  {
    const Program<dim> one = program(places, horizon);
    const ProbeFindings found = probe_all(one, horizon, places.size());
    EXPECT_EQ(found.bonds.size(), one.bonds.size());
    EXPECT_EQ(found.n_two_sided, one.bonds.size() / 2);
    for (const ProbedBond &bond : found.bonds)
      EXPECT_NEAR(bond.force_constant, one.bonds.at({bond.i, bond.j}), 1e-9);
    for (const double defect :
         {found.asymmetry.value, found.noncentral.value, found.imbalance, found.nonlinearity})
      EXPECT_LT(defect, 1e-9);
    EXPECT_EQ(found.n_loaded, 0u);
  }
} // namespace

TEST(Probe, recovers_force_constants)
{
  expect_recovered(lattice<2>(9), 3 * h);
  expect_recovered(lattice<3>(5), 2 * h);
  expect_recovered(lattice<2>(9, .3), 2.7 * h);
  expect_recovered(lattice<3>(5, .3), 1.8 * h);
}

TEST(Probe, displaces_nodes_together_that_reach_no_node_twice)
{
  for (const double perturbation : {0., .3})
  {
    const auto plan = plan_probe(lattice<2>(20, perturbation), {3 * h, 1e-6, 400});
    std::size_t n_displaced = 0;
    for (const std::vector<std::size_t> &group : plan.groups)
    {
      n_displaced += group.size();
      std::set<std::size_t> reached;
      for (const std::size_t k : group)
      {
        EXPECT_TRUE(reached.insert(plan.displaced[k]).second);
        for (const std::size_t i : plan.neighbours[k])
          EXPECT_TRUE(reached.insert(i).second);
      }
    }
    EXPECT_EQ(n_displaced, 400u);
  }
}

TEST(Probe, takes_as_many_runs_on_larger_lattices)
{
  const auto n_runs = [](const auto &places, double horizon, std::size_t n) {
    return plan_probe(places, {horizon, 1e-6, n}).n_runs();
  };
  EXPECT_EQ(n_runs(lattice<2>(20), 3 * h, 2), 21u);
  EXPECT_EQ(n_runs(lattice<2>(20), 3 * h, 400), 165u); // 40 groups; of squares of 7 x 7 nodes: 49
  EXPECT_EQ(n_runs(lattice<2>(40), 3 * h, 1600), 165u);
  EXPECT_EQ(n_runs(lattice<3>(20), 2 * h, 2), 55u);
  EXPECT_EQ(n_runs(lattice<3>(20), 2 * h, 8000), 355u);
}

TEST(Probe, displaces_a_block_in_the_middle)
{
  const auto n_displaced = [](const auto &places, std::size_t n) {
    return plan_probe(places, {2 * h, 1e-6, n}).displaced.size();
  };
  EXPECT_EQ(n_displaced(lattice<2>(20), 2), 4u);
  EXPECT_EQ(n_displaced(lattice<2>(21), 2), 9u);
  EXPECT_EQ(n_displaced(lattice<2>(21), 1), 1u);
  EXPECT_EQ(n_displaced(lattice<3>(20), 2), 8u);
  EXPECT_EQ(n_displaced(lattice<2>(20, .3), 2), 2u);
}

TEST(Probe, has_whole_families_of_few_displaced_nodes)
{
  const Program<3> one = program(lattice<3>(8), 2 * h);
  const ProbeFindings found = probe_all(one, 2 * h, 2);
  EXPECT_EQ(found.bonds.size(), 8u * 32);
  EXPECT_EQ(found.n_two_sided, 28u); // of a cube's corners
  for (const ProbedBond &bond : found.bonds)
    EXPECT_NEAR(bond.force_constant, one.bonds.at({bond.i, bond.j}), 1e-9);
}

TEST(Probe, is_exact_to_second_order_in_the_step)
{
  Program<2> one = program(lattice<2>(8), 3 * h);
  one.of_pair = [](const Tensor<1, 2> &xi, const Tensor<1, 2> &eta)
  {
    const Tensor<1, 2> y = xi + eta;
    return Tensor<1, 2>((y.norm() - xi.norm()) / y.norm() * y);
  };
  double last = 0;
  for (const double step : {2e-3, 1e-3})
  {
    const ProbeFindings found = probe_all(one, 3 * h, 4, step);
    double worst = 0;
    for (const ProbedBond &bond : found.bonds)
      worst = std::max(worst, std::abs(bond.force_constant - one.bonds.at({bond.i, bond.j})));
    if (last > 0)
    {
      EXPECT_NEAR(last / worst, 4, .1);
    }
    EXPECT_GT(2 * found.nonlinearity, worst / found.largest);
    last = worst;
  }
}

TEST(Probe, tells_where_forces_of_a_pair_differ)
{
  Program<2> one = program(lattice<2>(8), 2 * h);
  const std::size_t i = 27, j = 28; // both in the middle
  one.bonds[{i, j}] += .5;
  const ProbeFindings found = probe_all(one, 2 * h, 4);
  EXPECT_NEAR(found.asymmetry.value * found.largest, .5, 1e-9);
  EXPECT_EQ(found.asymmetry.i, i);
  EXPECT_EQ(found.asymmetry.j, j);
  EXPECT_NEAR(found.imbalance * found.largest, .5, 1e-9);
  for (const ProbedBond &bond : found.bonds)
    EXPECT_NEAR(bond.force_constant, one.bonds.at({bond.i, bond.j}), 1e-9);
}

TEST(Probe, tells_the_part_of_forces_across_bonds)
{
  Program<2> one = program(lattice<2>(8), 2 * h);
  for (auto &[pair, constant] : one.bonds)
    constant = 2;
  one.of_pair = [](const Tensor<1, 2> &xi, const Tensor<1, 2> &eta)
  { return linear<2>(xi, eta) + .1 * (eta - linear<2>(xi, eta)); };
  const ProbeFindings found = probe_all(one, 2 * h, 4);
  EXPECT_NEAR(found.largest, 2, 1e-9);
  EXPECT_NEAR(found.noncentral.value, .1, 1e-9);
}

TEST(Probe, counts_nodes_that_are_loaded_from_the_start)
{
  const Program<2> one = program(lattice<2>(8), 2 * h);
  const auto loaded = [&](const NodeVectors<2> &displacements)
  {
    NodeVectors<2> forces = one(displacements);
    forces[3][0] += .1;
    forces[5][1] -= .2;
    return forces;
  };
  const ProbeFindings found = probe<2>(plan_probe(one.places, {2 * h, 1e-6, 2}), loaded);
  EXPECT_EQ(found.n_loaded, 2u);
  EXPECT_EQ(found.loaded, 5u);
}

TEST(Probe, refuses_what_has_no_force_constants)
{
  Program<2> one = program(lattice<2>(10), 3 * h);
  EXPECT_TRUE(is_refused(one, 2 * h, "the horizon 0.2 is too small"));
  EXPECT_TRUE(is_refused(one, 2 * h, "at a distance of 0.3 is displaced"));
  EXPECT_TRUE(is_refused(one, .5 * h, "is less than the distance 0.1"));
  EXPECT_TRUE(is_refused(one, -1, "the horizon is -1"));
  one.of_pair = [](const Tensor<1, 2> &, const Tensor<1, 2> &) { return Tensor<1, 2>(); };
  EXPECT_TRUE(is_refused(one, 3 * h, "no force changes when nodes are displaced"));
}

// the pressure of node i is its dilatation: forces reach twice the horizon
TEST(Probe, refuses_state_based_forces)
{
  const Program<2> bonds = program(lattice<2>(12), 2 * h);
  const auto state_based = [&](const NodeVectors<2> &displacements)
  {
    std::vector<double> dilatation(bonds.places.size());
    for (const auto &[pair, constant] : bonds.bonds)
      dilatation[pair.first] += (bonds.places[pair.second] - bonds.places[pair.first]) *
                                (displacements[pair.second] - displacements[pair.first]);
    NodeVectors<2> forces(bonds.places.size());
    for (const auto &[pair, constant] : bonds.bonds)
      forces[pair.first] += (dilatation[pair.first] + dilatation[pair.second]) *
                            (bonds.places[pair.second] - bonds.places[pair.first]);
    return forces;
  };
  EXPECT_THROW(probe<2>(plan_probe(bonds.places, {2 * h, 1e-6, 4}), state_based), InputError);
  const ProbeFindings found = probe<2>(plan_probe(bonds.places, {4 * h, 1e-6, 4}), state_based);
  EXPECT_GT(found.noncentral.value, .1);
}
