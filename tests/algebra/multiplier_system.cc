#include "algebra/multiplier_system.h"

#include "algebra/slab_inverse.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  using Extents = std::array<int, 3>;

  Vector random_vector(std::size_t n)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector values(static_cast<Vector::size_type>(n));
    for (double &value : values)
      value = uniform(random);
    return values;
  }

  /// A solid on a lattice: bonds ξ⊗ξ/|ξ|³ to the neighbours in a ball of radius m, and
  /// `incompressibility` times the squares of the dilatation θ = Σ ξ·u(ξ) / |ξ|. Axes may have
  /// other spacings.
  Stencil solid(int m, double incompressibility, const std::array<double, 3> &spacing = {1, 1, 1})
  {
    std::vector<std::pair<Extents, std::array<double, 3>>> bonds; // offset, ξ/|ξ|
    geometry::for_each_index({-m, -m, -m}, {m + 1, m + 1, m + 1},
                             [&](const Extents &k)
                             {
                               const int square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
                               if (square == 0 || square > m * m)
                                 return;
                               std::array<double, 3> n{};
                               double length = 0;
                               for (unsigned int d = 0; d < 3; ++d)
                               {
                                 n[d] = k[d] * spacing[d];
                                 length = std::hypot(length, n[d]);
                               }
                               for (double &component : n)
                                 component /= length;
                               bonds.emplace_back(k, n);
                             });
    Stencil stencil(3, Extents{2 * m, 2 * m, 2 * m});
    for (const auto &[k, n] : bonds)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
        {
          stencil(a, b, k[0], k[1], k[2]) -= n[a] * n[b];
          stencil(a, b, 0, 0, 0) += n[a] * n[b];
          for (const auto &[l, other] : bonds)
            stencil(a, b, k[0] + l[0], k[1] + l[1], k[2] + l[2]) -=
                incompressibility * n[a] * other[b];
        }
    return stencil;
  }

  struct Outcome
  {
    LinearSolve solved;
    double error, residual; ///< relative
  };

  Outcome solve(const LinearSystem &system, const Extents &n, unsigned int n_blocks = 3)
  {
    const Vector exact = random_vector(static_cast<std::size_t>(n_blocks) * n[0] * n[1] * n[2]);
    Vector b(exact.size()), x(exact.size()), residual(exact.size());
    system.vmult(b, exact);
    Outcome outcome{system.solve(x, b, {1e-12, 1000}), 0, 0};
    system.vmult(residual, x);
    residual -= b;
    x -= exact;
    outcome.error = x.l2_norm() / exact.l2_norm();
    outcome.residual = residual.l2_norm() / b.l2_norm();
    return outcome;
  }
} // namespace

TEST(MultiplierSystem, solves_on_boxes_of_any_extents_and_spacings)
{
  for (const Extents &n : {Extents{5, 8, 6}, Extents{11, 3, 7}, Extents{1, 9, 4}})
  {
    const Stencil stencil = solid(2, .3, {1, 1.2, .7});
    const auto outcome = solve(MultiplierSystem(stencil, n, OperatorBackend::automatic), n);
    EXPECT_LT(outcome.error, 1e-11) << n[0];
    EXPECT_LE(outcome.residual, 1.01e-12) << n[0];
    EXPECT_LT(outcome.solved.n_iterations, 60u) << n[0];
  }
}

TEST(MultiplierSystem, needs_iterations_that_depend_on_incompressibility_but_hardly_on_n)
{
  unsigned int n_slow = 0;
  // λ/μ is some 113 times the first number; measured at n = 8 and 16: 40 and 42, 64 and 63, 158 and
  // 155, 527 and 534
  for (const auto &[incompressibility, most] :
       {std::pair(1., 60u), {10., 75u}, {100., 200u}, {1000., 650u}})
    for (const int n : {8, 16})
    {
      const Extents box = {n, n, n};
      const Stencil stencil = solid(2, incompressibility);
      const MultiplierSystem system(stencil, box, OperatorBackend::automatic);
      EXPECT_GT(coupling(stencil), 100 * incompressibility);
      const auto outcome = solve(system, box);
      EXPECT_LE(outcome.solved.n_iterations, most) << n << ", " << incompressibility;
      EXPECT_LE(outcome.residual, 4e-12) << n << ", " << incompressibility;
      if (incompressibility == 1)
        n_slow =
            solve(StencilSystem(stencil, geometry::BoxNodes{box}, OperatorBackend::automatic), box)
                .solved.n_iterations;
    }
  EXPECT_GT(n_slow, 75u); // sines of each component, the weaker coupling
}

TEST(MultiplierSystem, inverts_the_slabs_exactly)
{
  // with a layer across one axis alone the sum of slabs is the inverse itself, but for constants
  const Extents n = {6, 5, 4};
  PeriodicBox box(solid(2, 2), n);
  for (const unsigned int axis : {0u, 1u, 2u})
  {
    const SlabInverse slab(box, axis);
    std::vector<double> multipliers(3 * box.n_layer());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::array<double, 3> sum{};
    std::vector<std::size_t> places;
    geometry::for_each_index({0, 0, 0}, box.period(),
                             [&](const Extents &at)
                             {
                               if (at[axis] >= n[axis])
                                 places.push_back(box.number(at[0], at[1], at[2]));
                             });
    for (unsigned int c = 0; c < 3; ++c)
      for (const std::size_t place : places)
        sum[c] += multipliers[c * box.n_layer() + place] = uniform(random);
    for (unsigned int c = 0; c < 3; ++c)
      for (const std::size_t place : places)
        multipliers[c * box.n_layer() + place] -= sum[c] / static_cast<double>(places.size());
    const std::vector<double> nothing(3 * static_cast<std::size_t>(n[0]) * n[1] * n[2]);
    std::vector<double> values(multipliers.size()), found(multipliers.size());
    box.set_box(nothing.data());
    box.add_layer(multipliers.data());
    box.invert();
    box.get_layer(values.data());
    slab.add(box, values.data(), found.data());
    double error = 0;
    for (unsigned int c = 0; c < 3; ++c)
      for (const std::size_t place : places)
        error = std::max(error, std::abs(found[c * box.n_layer() + place] -
                                         multipliers[c * box.n_layer() + place]));
    EXPECT_LT(error, 1e-12) << axis;
  }
}

TEST(MultiplierSystem, is_chosen_where_components_are_coupled_strongly)
{
  const geometry::BoxNodes box{{6, 6, 6}};
  const auto is_chosen = [](const Stencil &stencil, const geometry::BoxNodes &nodes)
  {
    const auto system = make_box_system(stencil, nodes, OperatorBackend::automatic);
    return dynamic_cast<const MultiplierSystem *>(system.get()) != nullptr;
  };
  const Stencil weak = solid(2, 0), strong = solid(2, 1);
  EXPECT_LT(coupling(weak), 10);
  EXPECT_GT(coupling(strong), 100);
  EXPECT_FALSE(is_chosen(weak, box));
  EXPECT_TRUE(is_chosen(strong, box));
  geometry::BoxNodes part = box;
  part.is_free.assign(216, 1);
  part.is_free[0] = 0;
  EXPECT_FALSE(is_chosen(strong, part));
  Stencil skew = strong; // couples two components along the first axis
  for (const int side : {-1, 1})
    skew(0, 1, side, 0, 0) = skew(1, 0, side, 0, 0) = .1;
  EXPECT_FALSE(has_mirror_images(skew));
  EXPECT_FALSE(is_chosen(skew, box));
}

TEST(MultiplierSystem, is_foretold_to_take_no_more_memory_than_it_may)
{
  const Extents n = {64, 64, 64};
  const auto bytes = [&](int reach) { return multiplier_bytes(3, n, {reach, reach, reach}); };
  const double limit = most_multiplier_bytes(3, n);
  EXPECT_EQ(limit, 400. * 3 * 64 * 64 * 64);
  EXPECT_EQ(expected_multiplier_bytes(3, n, 6, 7), bytes(7));
  int last = 6; // the last reach with which it is chosen
  while (bytes(last + 1) <= limit)
    ++last;
  EXPECT_EQ(expected_multiplier_bytes(3, n, last, last + 1), limit);
  EXPECT_EQ(expected_multiplier_bytes(3, n, last + 1, last + 2), 0);
}

TEST(MultiplierSystem, is_replaced_where_the_periodic_operator_is_not_positive)
{
  // waves along the first axis lose 1.02 of their stiffness against shear, so that they grow; those
  // that vanish at the other faces as well do not
  const Extents n = {6, 6, 6};
  const Stencil whole = solid(2, 1);
  Stencil stencil = whole;
  whole.for_each_offset(
      [&](int k1, int k2, int k3)
      {
        for (const unsigned int c : {1u, 2u})
          stencil(c, c, k1, 0, 0) -= 1.02 * whole(c, c, k1, k2, k3);
      });
  EXPECT_GT(coupling(stencil), strong_coupling);
  EXPECT_THROW(MultiplierSystem(stencil, n, OperatorBackend::automatic), NumericalError);
  const auto system = make_box_system(stencil, geometry::BoxNodes{n}, OperatorBackend::automatic);
  const auto outcome = solve(*system, n);
  EXPECT_LE(outcome.residual, 1.01e-12);
  EXPECT_LT(outcome.error, 1e-9);
}

TEST(MultiplierSystem, is_refused_where_rounding_spoils_its_inverses)
{
  for (const double incompressibility : {1e16, 1e20})
    EXPECT_THROW(
        MultiplierSystem(solid(2, incompressibility), {6, 6, 6}, OperatorBackend::automatic),
        NumericalError);
}

TEST(PeriodicBox, knows_its_largest_eigenvalue)
{
  const PeriodicBox box(solid(2, 1), {5, 4, 6});
  double largest = 0;
  std::array<int, 3> k{};
  for (k[2] = 0; k[2] < box.period()[2]; ++k[2])
    for (k[1] = 0; k[1] < box.period()[1]; ++k[1])
      for (k[0] = 0; k[0] < box.period()[0]; ++k[0])
      {
        if (k == std::array<int, 3>{})
          continue;
        const double *packed = box.inverse(k);
        Eigen::Matrix3d inverse;
        for (int s = 0; s < 3; ++s)
          for (int t = 0; t <= s; ++t, ++packed)
            inverse(s, t) = inverse(t, s) = *packed;
        largest = std::max(
            largest, 1 / Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inverse).eigenvalues()[0]);
      }
  EXPECT_NEAR(box.largest(), largest, 1e-9 * largest);
}

TEST(MultiplierSystem, says_that_more_iterations_are_needed)
{
  const Extents n = {8, 8, 8};
  const MultiplierSystem system(solid(2, 10), n, OperatorBackend::automatic);
  const Vector b = random_vector(3 * 512);
  Vector x(b.size());
  try
  {
    system.solve(x, b, {1e-12, 5});
    ADD_FAILURE() << "5 iterations are enough";
  }
  catch (const NumericalError &error)
  {
    EXPECT_NE(std::string(error.what()).find("after 5 iterations"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("raise Solver/max iterations"), std::string::npos);
  }
  const Vector nothing(b.size());
  EXPECT_EQ(system.solve(x, nothing, {}).n_iterations, 0u);
  EXPECT_EQ(x.l2_norm(), 0);
}
