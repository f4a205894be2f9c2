// Pairs of triangles by their sides for all kernels: against integrals in higher precision, and
// against identities that only exact entries satisfy. The number of pairs is PLUMBLINE_PAIRS of the
// environment, a few hundred without.
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/entry_check.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/rows.h"
#include "tests/reference/pair_oracle.h"

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::Point;
  using physics::Structure;
  using reference::MeshCells;
  using reference::MeshSpace;
  using reference::PairBlocks;
  using Powers = physics::RadialProfile::Powers;
  using tests::Real;

  const std::vector<Powers> profiles = {
      {{1, 0}}, {{1, 0}, {-1, 1}}, {{1, -1}}, {{1, 0}, {-1, 2}}, {{1, 2}}};

  /// A profile, also in higher precision; times r it is a polynomial of a degree, to rounding.
  struct Profile
  {
    physics::RadialProfile profile;
    std::function<Real(Real)> value;
    unsigned int degree = 0;
  };

  std::vector<Profile> all_profiles()
  {
    std::vector<Profile> result;
    for (const Powers &powers : profiles)
      result.push_back({powers,
                        [powers](Real t)
                        {
                          Real sum = 0;
                          for (const auto &[coefficient, exponent] : powers)
                            sum += coefficient * std::pow(t, static_cast<Real>(exponent));
                          return sum;
                        },
                        2});
    result.push_back(
        {physics::RadialProfile::smooth([](double t) { return std::exp(-t * t); }, true),
         [](Real t) { return std::exp(-t * t); }, 24});
    result.push_back(
        {physics::RadialProfile::smooth([](double t) { return std::exp(-2 * t); }, false),
         [](Real t) { return std::exp(-2 * t); }, 24});
    return result;
  }

  Mesh triangles(double h, double horizon, double part)
  {
    const geometry::Domain square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};
    Mesh mesh = geometry::lattice_mesh(square, h, horizon, true);
    std::mt19937 random(3);
    for (auto &vertex : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
        if (std::min({vertex[0], vertex[1], 1 - vertex[0], 1 - vertex[1]}) > 1e-9)
          vertex[d] += part * h * (2. * random() / random.max() - 1);
    return mesh;
  }

  tests::OracleKernel oracle(const Profile &profile, const physics::Kernel<2> &kernel)
  {
    const Real horizon = kernel.horizon();
    return {[profile, horizon](Real r) { return profile.value(r / horizon); }, profile.degree,
            kernel.structure() == Structure::tensor, horizon};
  }

  tests::Triangle corners(const Mesh &mesh, std::size_t cell)
  {
    const auto polygon = mesh.polygon(cell);
    tests::Triangle result;
    for (unsigned int v = 0; v < 3; ++v)
      result[v] = {polygon[v][0], polygon[v][1]};
    return result;
  }

  double largest_difference(const PairBlocks &found, const tests::OracleBlocks &expected)
  {
    Real largest = 0;
    for (std::size_t i = 0; i < found.cross.size(); ++i)
      for (const Real difference :
           {found.outer[i] - expected.outer[i], found.cross[i] - expected.cross[i],
            found.inner[i] - expected.inner[i]})
        largest = std::max(largest, std::isfinite(difference) ? std::abs(difference) : 1e300L);
    return static_cast<double>(largest);
  }

  /// Of C |T| |T'| / 9, of pairs at random on a moved mesh.
  double worst_pair(const MeshSpace &space, const physics::Kernel<2> &kernel,
                    const tests::OracleKernel &exact, unsigned int n_pairs, unsigned int seed)
  {
    const MeshCells cells(space.mesh());
    const reference::PolygonPairs pairs(space, cells, kernel);
    std::vector<double> difference(n_pairs);
    reference::in_parallel(
        n_pairs,
        [&](std::size_t first, std::size_t last)
        {
          reference::PolygonPairs own = pairs;
          PairBlocks sides;
          std::vector<unsigned int> near;
          for (std::size_t k = first; k < last; ++k)
          {
            std::mt19937 random(static_cast<unsigned int>(seed + k));
            const std::size_t outer = random() % cells.size();
            cells.find_near(outer, kernel.horizon(), near);
            const std::size_t inner = near[random() % near.size()];
            own.integrate(outer, inner, sides);
            const double scale = cells.area(outer) * cells.area(inner) *
                                 std::max(1., kernel.radial(.125)) /
                                 (space.shapes().degree() == 0 ? 1 : 9);
            difference[k] =
                largest_difference(sides, tests::integrate_pair(corners(space.mesh(), outer),
                                                                corners(space.mesh(), inner),
                                                                space.shapes().degree(), exact)) /
                scale;
          }
        },
        1);
    return *std::max_element(difference.begin(), difference.end());
  }

  struct Assembled
  {
    std::shared_ptr<const MeshSpace> space;
    reference::MeshMatrix matrix;
  };

  Assembled assemble(const Mesh &mesh, const physics::Kernel<2> &kernel, bool is_continuous,
                     unsigned int degree,
                     const std::optional<physics::Coefficient> &coefficient = {})
  {
    auto space = std::make_shared<const MeshSpace>(std::make_shared<const Mesh>(mesh),
                                                   is_continuous, degree);
    return {space, reference::assemble(*space, MeshCells(mesh), kernel, coefficient, {},
                                       base::Communicator::alone())};
  }

  physics::Kernel<2> bond_tensor(const Powers &powers, double horizon)
  {
    return physics::Kernel<2>::with_bulk_modulus(powers, horizon, 1);
  }

  using Field = std::function<dealii::Tensor<1, 2>(const dealii::Tensor<1, 2> &)>;

  /// The largest |Σ_j A_ij u(x_j - x_i)| of the rows of tensors, in units of the diagonal.
  double worst_row(const Assembled &system, const Field &u)
  {
    double worst = 0;
    const auto &rows = system.matrix.rows;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0, largest = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const dealii::Tensor<1, 2> offset =
            system.space->support(rows.column[k] / 2) - system.space->support(i / 2);
        sum += rows.value[k] * u(offset)[rows.column[k] % 2];
        largest = std::max(largest, rows.value[k]);
      }
      worst = std::max(worst, std::abs(sum) / largest);
    }
    return worst;
  }

  void expect_symmetric(const algebra::CsrMatrix &rows)
  {
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (const unsigned int j = rows.column[k]; j < i)
        {
          const auto first = rows.column.begin();
          const auto at =
              std::lower_bound(first + static_cast<std::ptrdiff_t>(rows.start[j]),
                               first + static_cast<std::ptrdiff_t>(rows.start[j + 1]), i);
          ASSERT_EQ(rows.value[k], rows.value[static_cast<std::size_t>(at - first)]);
        }
  }
} // namespace

TEST(PairKernels, AgreeWithIntegralsInHigherPrecision)
{
  constexpr unsigned int few = 224;
  const char *const wanted = std::getenv("PLUMBLINE_PAIRS");
  const unsigned int n_pairs = wanted == nullptr ? few : std::stoul(wanted);
  const unsigned int n_degrees = n_pairs > few ? 3 : 1; // else in turn
  const auto kernels = all_profiles();
  const double h = .125;
  unsigned int place = 0;
  double worst[2][3] = {};
  for (const double m : {.7, 1.5, 3., 5.5})
    for (const Profile &profile : kernels)
      for (const Structure structure : {Structure::scalar, Structure::tensor})
        for (unsigned int turn = 0; turn < n_degrees; ++turn)
        {
          const unsigned int degree = (place++ + turn) % 3;
          const MeshSpace space(std::make_shared<const Mesh>(triangles(h, m * h, .25)), false,
                                degree);
          const physics::Kernel<2> kernel(structure, profile.profile, m * h, 1);
          if (!reference::PolygonPairs::refuse(space, kernel).empty())
          {
            EXPECT_LT(m, 3); // functions vary fast in triangles
            continue;
          }
          const double found = worst_pair(space, kernel, oracle(profile, kernel),
                                          n_pairs / (56 * n_degrees), 1000 * place);
          const bool is_tensor = structure == Structure::tensor;
          // polynomials of ξ have small potentials in near pairs, others lose digits with degree 2
          const bool is_smooth = profile.profile.is_even(is_tensor);
          EXPECT_LT(found, degree < 2  ? 1e-11
                           : is_smooth ? 2e-11
                                       : 1e-9)
              << "m = " << m << ", degree " << degree << ", " << (is_tensor ? "tensor" : "scalar");
          worst[is_tensor][degree] = std::max(worst[is_tensor][degree], found);
        }
  for (unsigned int degree = 0; degree < 3; ++degree)
    std::cout << "worst of " << n_pairs << " pairs, degree " << degree << ": scalar "
              << worst[0][degree] << ", tensor " << worst[1][degree] << " of C |T| |T'| / 9\n";
}

TEST(PairKernels, OfFunctionsAndTablesMakeExactMatrices)
{
  const double h = .25, horizon = 3 * h;
  const Mesh mesh = triangles(h, horizon, .2);
  const auto kernels = all_profiles();
  const auto table = physics::RadialProfile::table({{0, 1}, {.4, .9}, {.8, .3}, {1, .2}});
  for (const auto &profile : {kernels[5].profile, kernels[6].profile, table})
    for (const Structure structure : {Structure::scalar, Structure::tensor})
    {
      const physics::Kernel<2> kernel(structure, profile, horizon, 1);
      const Assembled system = assemble(mesh, kernel, false, 1);
      EXPECT_TRUE(system.matrix.is_exact) << system.matrix.way;
      const auto check =
          reference::check_entries(*system.space, kernel, {}, system.matrix.rows, 30, 1);
      EXPECT_GE(check.n_pairs, 30u);
      EXPECT_LT(check.worst_difference, 1e-13);
      expect_symmetric(system.matrix.rows);
      if (structure == Structure::tensor)
      {
        const auto linear = [&](const auto &x)
        { return Point<2>(x[0] - 2 * x[1], 3 * x[0] + x[1]) / horizon; };
        EXPECT_LT(worst_row(system, linear), 1e-12);
      }
    }
}

TEST(PairKernels, ThatAreNarrowOrHaveManyBreaksTakeQuadratureAndSayWhy)
{
  const double h = .25, horizon = 2 * h;
  const Mesh mesh = triangles(h, horizon, .2);
  std::vector<std::array<double, 2>> rows;
  for (unsigned int i = 0; i <= 10; ++i)
    rows.push_back({.1 * i, 1. + (i % 2)});
  const auto way = [&](const physics::RadialProfile &profile, double of_horizon)
  {
    const physics::Kernel<2> kernel(Structure::scalar, profile, of_horizon * horizon, 1);
    return assemble(mesh, kernel, false, 0).matrix.way;
  };
  const std::string start = "by quadrature, not exact by sides of triangles: ";
  EXPECT_EQ(
      way(physics::RadialProfile::smooth([](double t) { return std::exp(-36 * t * t); }, true), 1),
      start + "the kernel varies fast in relation to the horizon or the cells");
  EXPECT_EQ(way(physics::RadialProfile::table(rows), 1),
            start + "the kernel's profile has more than 7 breaks");
  EXPECT_EQ(way(profiles[1], .1),
            start + "cells are large in relation to the horizon or a break of the kernel");
}

TEST(PairTensors, AnnihilateRigidMotionsAndLinearFields)
{
  for (const double m : {1.3, 2.})
    for (const Powers &powers : {profiles[0], profiles[1], profiles[2]})
      for (const unsigned int degree : {0u, 1u, 2u})
      {
        const double h = .25;
        const Assembled system =
            assemble(triangles(h, m * h, .2), bond_tensor(powers, m * h), false, degree);
        EXPECT_TRUE(system.matrix.is_exact);
        EXPECT_EQ(system.matrix.way, "exact by sides of pairs of triangles");
        const double allowed = degree < 2 ? 1e-12 : 1e-10;
        EXPECT_LT(worst_row(system, [](const auto &) { return Point<2>(1, -2); }), allowed) << m;
        if (degree > 0)
        {
          const auto turned = [&](const auto &x) { return Point<2>(-x[1], x[0]) / (m * h); };
          EXPECT_LT(worst_row(system, turned), allowed) << m;
          const auto linear = [&](const auto &x)
          { return Point<2>(x[0] - 2 * x[1], 3 * x[0] + x[1]) / (m * h); };
          EXPECT_LT(worst_row(system, linear), allowed) << m;
        }
        expect_symmetric(system.matrix.rows);
      }
}

TEST(PairTensors, OfFreeBodiesAnnihilateRotations)
{
  const double h = .25, horizon = 2 * h; // ξ⊗ξ times what is turned from ξ is 0, on any mesh
  for (const double collar : {0., h})
    for (const unsigned int degree : {1u, 2u})
      for (const Powers &powers : {profiles[1], profiles[2]})
      {
        const Assembled system =
            assemble(triangles(h, collar, .2), bond_tensor(powers, horizon), true, degree);
        EXPECT_EQ(system.matrix.way, "exact by sides of pairs of triangles");
        const double allowed = degree == 1 ? 1e-12 : 1e-10;
        const auto turned = [&](const auto &x) { return Point<2>(-x[1], x[0]) / horizon; };
        EXPECT_LT(worst_row(system, turned), allowed) << collar;
        EXPECT_LT(worst_row(system, [](const auto &) { return Point<2>(1, -2); }), allowed);
        expect_symmetric(system.matrix.rows);
      }
}

TEST(PairTensors, GiveContinuousMatricesThoseOfPairsOfNodes)
{
  const double h = .125;
  const physics::Coefficient one(physics::Expression("Kernel/coefficient", "1"),
                                 physics::Mean::arithmetic);
  for (const Powers &powers : {profiles[1], profiles[2]})
  {
    const Mesh mesh = triangles(h, 4 * h, .2);
    const Assembled by_pairs = assemble(mesh, bond_tensor(powers, 4 * h), true, 1, one),
                    by_nodes = assemble(mesh, bond_tensor(powers, 4 * h), true, 1);
    EXPECT_NE(by_pairs.matrix.way, by_nodes.matrix.way);
    const algebra::CsrMatrix &a = by_pairs.matrix.rows, &b = by_nodes.matrix.rows;
    ASSERT_EQ(a.n_rows(), b.n_rows());
    const double largest = *std::max_element(b.value.begin(), b.value.end());
    for (std::size_t i = 0; i < a.n_rows(); ++i)
    {
      std::vector<double> row(2 * by_nodes.space->n_dofs());
      for (std::size_t k = a.start[i]; k < a.start[i + 1]; ++k)
        row[a.column[k]] += a.value[k];
      for (std::size_t k = b.start[i]; k < b.start[i + 1]; ++k)
        row[b.column[k]] -= b.value[k];
      for (const double difference : row)
        EXPECT_LT(std::abs(difference), 1e-12 * largest);
    }
  }
}

TEST(PairTensors, DoNotDependOnTheNumberOfThreads)
{
  const double h = .25;
  std::vector<double> first;
  for (const unsigned int n_threads : {1u, 2u, 5u})
  {
    dealii::MultithreadInfo::set_thread_limit(n_threads);
    const Assembled system =
        assemble(triangles(h, 2 * h, .2), bond_tensor(profiles[1], 2 * h), false, 1);
    if (first.empty())
      first = system.matrix.rows.value;
    EXPECT_EQ(system.matrix.rows.value, first);
  }
  dealii::MultithreadInfo::set_thread_limit();
}
