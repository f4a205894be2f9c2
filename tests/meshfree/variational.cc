#include "base/error.h"
#include "meshfree/body/operator.h"
#include "meshfree/rules/quadrature_rule.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace plumbline;
using namespace plumbline::meshfree;
using algebra::OperatorBackend;
using algebra::Vector;
using geometry::Lattice;
using geometry::Polygon;

namespace
{
  using BondOf = Bond<2> (*)(const Kernel<2> &, const Candidate<2> &);
  const std::vector<BondOf> all_rules = {full_area_bond, partial_area_bond, centroid_bond};

  Kernel<2> influence(double horizon)
  {
    return {physics::Structure::scalar, {{1, -1}}, horizon, 1};
  }

  Bonds<2> bonds_of(BondOf bond, double horizon, double h)
  {
    return lattice_bonds({bond}, influence(horizon), h, Backend::fast);
  }

  Polygon rectangle(double x0, double y0, double x1, double y1)
  {
    return {Point<2>(x0, y0), Point<2>(x1, y0), Point<2>(x1, y1), Point<2>(x0, y1)};
  }

  VariationalMaterial uniform(double k, double l)
  {
    return {[k](const Point<2> &) { return k; }, [l](const Point<2> &) { return l; }};
  }

  /// τ > 0 on one side and < 0 on the other.
  const VariationalMaterial varying{[](const Point<2> &x) { return 2 + x[0]; },
                                    [](const Point<2> &x) { return 6 + 9 * x[1]; }};

  /// 12 × 9 cells with a hole.
  VariationalBody small_body(const Polygons &fixed, const VariationalMaterial &material)
  {
    return body_on_vertices(Lattice({{{{0, 0}, {1.2, .9}}}, {{{.5, .3}, {.7, .6}}}}, .1), fixed,
                            material);
  }

  VariationalOperator small_operator(BondOf bond, const Polygons &fixed,
                                     const VariationalMaterial &material,
                                     OperatorBackend backend = OperatorBackend::automatic)
  {
    return {small_body(fixed, material), influence(.23), bonds_of(bond, .23, .1), backend};
  }

  Vector random_field(const VariationalBody &body)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    Vector u(2 * body.size());
    for (std::size_t i = 0; i < body.size(); ++i)
      for (unsigned int d = 0; d < 2 && body.V[i] > 0 && body.is_fixed[i] == 0; ++d)
        u[d * body.size() + i] = any(random);
    return u;
  }

  Vector apply(const VariationalOperator &matrix, const Vector &u)
  {
    Vector result(u.size());
    matrix.vmult(result, u);
    return result;
  }

  double distance(const Vector &a, const Vector &b)
  {
    Vector difference = a;
    difference -= b;
    return difference.linfty_norm();
  }

  std::vector<std::size_t> free_indices(const VariationalBody &body)
  {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < 2 * body.size(); ++i)
      if (body.V[i % body.size()] > 0 && body.is_fixed[i % body.size()] == 0)
        result.push_back(i);
    return result;
  }

  /// Ascending eigenvalues at the free nodes, relative to the largest.
  std::vector<double> spectrum(const VariationalOperator &matrix)
  {
    const auto free = free_indices(matrix.body());
    dealii::LAPACKFullMatrix<double> dense(free.size());
    for (std::size_t j = 0; j < free.size(); ++j)
    {
      Vector unit(2 * matrix.body().size());
      unit[free[j]] = 1;
      const Vector column = apply(matrix, unit);
      for (std::size_t i = 0; i < free.size(); ++i)
        dense(i, j) = column[free[i]];
    }
    dense.compute_eigenvalues();
    std::vector<double> values;
    for (std::size_t i = 0; i < free.size(); ++i)
      values.push_back(dense.eigenvalue(i).real());
    std::sort(values.begin(), values.end());
    for (double &value : values)
      value /= values.back();
    return values;
  }

  /// B u summed from its blocks, eqs. (16) and (23), each with its triple loop.
  Vector block_form(const VariationalBody &body, const Kernel<2> &kernel, const Bonds<2> &bonds,
                    const Vector &u, bool has_dilatation)
  {
    const std::size_t n = body.size();
    std::vector<std::vector<double>> w_rho(n, std::vector<double>(n));
    std::vector<double> m(n);
    const auto way = [&](std::size_t i, std::size_t j) { return body.node(j) - body.node(i); };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (const Bond<2> &bond : bonds.family)
          if ((way(i, j) - bond.xi).norm() < 1e-9)
          {
            w_rho[i][j] = bond.weight / (body.h * body.h) * radial_value(kernel, bond);
            m[i] += w_rho[i][j] * body.V[j] * way(i, j).norm_square();
          }
    std::vector<double> tau(n), alpha(n);
    for (std::size_t i = 0; i < n; ++i)
      if (body.V[i] > 0)
      {
        tau[i] = has_dilatation ? (4 * body.k[i] - body.l[i]) / (m[i] * m[i]) : 0;
        alpha[i] = body.l[i] / m[i];
      }

    Vector result(2 * n);
    const auto add = [&](std::size_t i, std::size_t j, double factor, const Tensor<1, 2> &a,
                         const Tensor<1, 2> &b) // result_i += factor a (b·u_j)
    {
      const double action = factor * (b[0] * u[j] + b[1] * u[n + j]);
      result[i] += action * a[0];
      result[n + i] += action * a[1];
    };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
      {
        if (i == j || body.V[i] * body.V[j] * w_rho[i][j] == 0)
          continue;
        const Tensor<1, 2> d = way(i, j);
        const double bond =
            (alpha[i] + alpha[j]) * body.V[i] * body.V[j] * w_rho[i][j] / d.norm_square();
        add(i, i, bond, d, d);
        add(i, j, -bond, d, d);
        for (std::size_t q = 0; q < n; ++q) // I2_ijq acts on the pairs (j - i) and (q - i)
        {
          if (q == i || w_rho[i][q] == 0)
            continue;
          const double I2 = body.V[i] * body.V[j] * body.V[q] * tau[i] * w_rho[i][j] * w_rho[i][q];
          add(j, q, I2, d, way(i, q));
          add(i, q, -I2, d, way(i, q));
          add(j, i, -I2, d, way(i, q));
          add(i, i, I2, d, way(i, q));
        }
      }
    return result;
  }
} // namespace

TEST(VariationalBody, cuts_the_cells_of_boundary_nodes)
{
  const auto body = small_body({}, varying);
  const double whole = .01;
  ASSERT_EQ(body.n, (std::array<int, 2>{13, 10}));
  const auto V = [&](int i, int j) { return body.V[j * 13 + i] / whole; };
  EXPECT_DOUBLE_EQ(V(0, 0), .25);
  EXPECT_DOUBLE_EQ(V(12, 4), .5);
  EXPECT_DOUBLE_EQ(V(3, 3), 1);
  EXPECT_DOUBLE_EQ(V(5, 3), .75); // a corner of the hole
  EXPECT_DOUBLE_EQ(V(6, 4), 0);   // inside it
}

TEST(VariationalBody, of_pieces_is_the_one_on_vertices)
{
  const Polygons fixed{rectangle(0, 0, .2, .9)};
  const auto a = small_body(fixed, varying);
  const auto b = body_of_pieces({rectangle(0, 0, .5, .9), rectangle(.7, 0, 1.2, .9),
                                 rectangle(.5, 0, .7, .3), rectangle(.5, .6, .7, .9)},
                                fixed, varying, .1);
  ASSERT_EQ(a.n, b.n);
  EXPECT_EQ(a.is_fixed, b.is_fixed);
  EXPECT_EQ(a.k, b.k);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a.V[i], b.V[i], 1e-16);
}

TEST(VariationalBody, areas_add_up_whatever_the_shape)
{
  Polygon disc;
  for (int i = 0; i < 100; ++i)
    disc.emplace_back(.013 + std::cos(.02 * M_PI * i), -.4 + std::sin(.02 * M_PI * i));
  const auto body = body_of_pieces({disc}, {}, uniform(1, 1), .07);
  double sum = 0;
  for (const double V : body.V)
    sum += V;
  EXPECT_NEAR(sum, 50 * std::sin(.02 * M_PI), 1e-13);
}

TEST(VariationalBody, fixes_cells_that_share_area_with_the_fixed_region)
{
  const auto body = small_body({rectangle(0, 0, .2, .9)}, varying);
  for (std::size_t i = 0; i < body.size(); ++i)
    EXPECT_EQ(body.is_fixed[i] != 0, body.node(i)[0] < .21) << body.node(i);
  // to the edge of a cell, not into the next one
  const auto half = small_body({rectangle(0, 0, .25, .9)}, varying);
  EXPECT_EQ(half.is_fixed, body.is_fixed);
}

TEST(VariationalBody, loads_free_cells_with_the_force_on_them)
{
  const auto body = small_body({rectangle(0, 0, .2, .9)}, varying);
  const Tensor<1, 2> force = Point<2>(3, -1);
  const Vector cells = cell_load(body, {{rectangle(.9, 0, 1.2, .9), force}}),
               nodes = nodal_load(body, [&](const Point<2> &x)
                                  { return x[0] > .899 ? force : Tensor<1, 2>(); });
  const std::size_t n = body.size();
  EXPECT_NEAR(std::accumulate(cells.begin(), cells.begin() + n, 0.), 3 * .3 * .9, 1e-14);
  EXPECT_NEAR(std::accumulate(cells.begin() + n, cells.end(), 0.), -.3 * .9, 1e-14);
  EXPECT_NEAR(std::accumulate(nodes.begin(), nodes.begin() + n, 0.), 3 * .35 * .9, 1e-14);
  const Vector constrained = cell_load(body, {{rectangle(0, 0, .25, .9), force}});
  EXPECT_EQ(constrained.l2_norm(), 0);
}

TEST(VariationalBody, distance_is_that_of_piecewise_constants)
{
  const Polygons pieces{rectangle(0, 0, 1.2, .9)};
  const auto coarse = body_of_pieces(pieces, {}, uniform(1, 1), .3),
             fine = body_of_pieces(pieces, {}, uniform(1, 1), .1),
             other = body_of_pieces(pieces, {}, uniform(1, 1), .17);
  const Vector u = random_field(coarse), zero(2 * other.size());
  Vector injected(2 * fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i) // three fine cells in a coarse one
  {
    const Point<2> x = fine.node(i);
    const std::size_t j = std::lround(x[1] / .3) * coarse.n[0] + std::lround(x[0] / .3);
    injected[i] = u[j];
    injected[fine.size() + i] = u[coarse.size() + j];
  }
  EXPECT_NEAR(meshfree::distance(pieces, coarse, u, fine, injected), 0, 1e-14);
  double square = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    square += coarse.V[i % coarse.size()] * u[i] * u[i];
  EXPECT_NEAR(meshfree::distance(pieces, coarse, u, other, zero), std::sqrt(square), 1e-14);
  EXPECT_NEAR(meshfree::distance(pieces, other, zero, coarse, u), std::sqrt(square), 1e-14);
}

TEST(VariationalBody, refuses_what_is_no_body)
{
  EXPECT_THROW(
      body_of_pieces({rectangle(0, 0, 1, 1), rectangle(.5, 0, 2, 1)}, {}, uniform(1, 1), .1),
      InputError);
  EXPECT_THROW(body_of_pieces({}, {}, uniform(1, 1), .1), InputError);
  EXPECT_THROW(body_of_pieces({rectangle(0, 0, 1, 1)}, {}, uniform(1, 1), 0), InputError);
  EXPECT_THROW(small_body({rectangle(0, 0, 1.2, .9)}, varying), InputError);
}

TEST(VariationalOperator, is_the_block_form)
{
  const auto body = small_body({}, varying);
  const Vector u = random_field(body);
  for (const BondOf bond : all_rules)
    for (const OperatorBackend backend : {OperatorBackend::fft, OperatorBackend::direct})
    {
      const Vector Bu = apply(small_operator(bond, {}, varying, backend), u);
      EXPECT_LT(distance(Bu, block_form(body, influence(.23), bonds_of(bond, .23, .1), u, true)),
                1e-13 * Bu.linfty_norm());
    }
}

TEST(VariationalOperator, is_bond_based_where_l_is_4k)
{
  const VariationalMaterial material{varying.k, [](const Point<2> &x) { return 4 * varying.k(x); }};
  const auto body = small_body({}, material);
  const Vector u = random_field(body);
  const Vector Bu = apply(small_operator(partial_area_bond, {}, material), u);
  const auto bonds = bonds_of(partial_area_bond, .23, .1);
  EXPECT_LT(distance(Bu, block_form(body, influence(.23), bonds, u, false)),
            1e-13 * Bu.linfty_norm());
}

TEST(VariationalOperator, is_symmetric)
{
  const Polygons fixed{rectangle(0, 0, .2, .9)};
  for (const OperatorBackend backend : {OperatorBackend::fft, OperatorBackend::direct})
  {
    const auto matrix = small_operator(partial_area_bond, fixed, varying, backend);
    const Vector u = random_field(matrix.body());
    Vector v(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      v[i] = u[i] * std::cos(37. * i);
    const Vector Bu = apply(matrix, u), Bv = apply(matrix, v);
    EXPECT_NEAR(v * Bu, u * Bv, 1e-15 * v.l2_norm() * Bu.l2_norm());
  }
}

TEST(VariationalOperator, potential_form_is_the_assembled_form)
{
  for (const BondOf bond : all_rules)
  {
    const auto matrix = small_operator(bond, {}, varying);
    const Vector u = random_field(matrix.body());
    const double energy = matrix.energy(u);
    EXPECT_NEAR(u * apply(matrix, u), energy, 1e-13 * energy);
  }
}

TEST(VariationalOperator, uniform_expansion_stores_4k)
{
  for (const BondOf bond : all_rules)
  {
    const auto matrix = small_operator(bond, {}, varying);
    const VariationalBody &body = matrix.body();
    Vector u(2 * body.size());
    double expected = 0;
    for (std::size_t i = 0; i < body.size(); ++i)
    {
      u[i] = body.node(i)[0];
      u[body.size() + i] = body.node(i)[1];
      expected += 4 * body.k[i] * body.V[i];
    }
    EXPECT_NEAR(matrix.energy(u), expected, 1e-13 * expected);
  }
}

TEST(VariationalOperator, transforms_give_what_sums_give)
{
  const Polygons pieces{{Point<2>(0, 0), Point<2>(1, .1), Point<2>(1.3, 1), Point<2>(.2, .8)}};
  const auto body = body_of_pieces(pieces, {rectangle(0, 0, .2, .1)}, varying, .03);
  for (const double horizon : {.05, .1, .2})
  {
    const auto bonds = bonds_of(partial_area_bond, horizon, .03);
    const VariationalOperator fft(body, influence(horizon), bonds, OperatorBackend::fft),
        direct(body, influence(horizon), bonds, OperatorBackend::direct);
    EXPECT_EQ(fft.backend(), "fft");
    EXPECT_EQ(direct.backend(), "direct");
    const Vector u = random_field(body), Bu = apply(direct, u);
    EXPECT_LT(distance(apply(fft, u), Bu), 1e-12 * Bu.linfty_norm());
  }
}

TEST(VariationalOperator, has_three_zero_modes_and_none_if_held)
{
  const VariationalMaterial negative = uniform(100, 800); // ν = 0, τ < 0
  for (const BondOf bond : all_rules)
    for (const auto &material : {uniform(100, 100), negative, varying})
    {
      const auto free = spectrum(small_operator(bond, {}, material));
      EXPECT_LT(std::max(-free[0], free[2]), 1e-13);
      EXPECT_GT(free[3], 1e-4);
      EXPECT_GT(spectrum(small_operator(bond, {rectangle(0, 0, .1, .9)}, material))[0], 1e-4);
    }
}

TEST(VariationalOperator, refuses_what_it_cannot_use)
{
  EXPECT_THROW(small_operator(full_area_bond, {}, uniform(-1, 1)), InputError);
  EXPECT_THROW(small_operator(full_area_bond, {}, uniform(1, 0)), InputError);
  EXPECT_THROW(small_operator(full_area_bond, {}, uniform(1, 1), OperatorBackend::sparse),
               InputError);
  auto body = small_body({}, uniform(1, 1));
  EXPECT_THROW(VariationalOperator(body, influence(.2), bonds_of(full_area_bond, .2, .05)),
               InputError);
  for (double &V : body.V) // all but one node, which has no neighbours then
    V = &V == &body.V[0] ? .01 : 0;
  EXPECT_THROW(VariationalOperator(body, influence(.2), bonds_of(full_area_bond, .2, .1)),
               NumericalError);
}

TEST(VariationalSolve, meets_the_equation_on_any_body)
{
  const Polygons skew{{Point<2>(0, 0), Point<2>(1, .1), Point<2>(1.3, 1), Point<2>(.2, .8)}};
  // held at a corner, all around, and inside
  for (const Polygons &fixed : {Polygons{rectangle(0, 0, .2, .1)},
                                Polygons{rectangle(0, 0, .3, 1), rectangle(.9, 0, 1.3, 1)},
                                Polygons{rectangle(.5, .4, .7, .6)}})
  {
    const auto body = body_of_pieces(skew, fixed, varying, .03);
    const VariationalOperator matrix(body, influence(.1), bonds_of(partial_area_bond, .1, .03));
    const Vector f = nodal_load(body, [](const Point<2> &x) { return Point<2>(x[1], 1); });
    Vector u(f.size());
    EXPECT_LT(solve(matrix, u, f, 1e-11, 500).n_iterations, 200u);
    EXPECT_LT(distance(apply(matrix, u), f), 1e-11 * f.l2_norm());
  }
}

// The bar of Pflug, Stingl & Zetzmann 2026, eq. (18): held at the left, pulled at the right.
namespace
{
  constexpr double delta = .05;
  const Polygons bar_pieces{rectangle(0, 0, 2, 1)};

  struct BarSolution
  {
    VariationalBody body;
    Vector u;
    unsigned int n_iterations;
  };

  BarSolution bar(int n, BondOf bond, bool is_averaged)
  {
    const double h = 1. / n;
    BarSolution result{body_on_vertices(Lattice({{{{0, 0}, {2, 1}}}, {}}, h),
                                        {rectangle(0, 0, 2 * delta, 1)}, uniform(100, 800)),
                       {},
                       0};
    const VariationalOperator matrix(result.body, influence(delta), bonds_of(bond, delta, h));
    const double from = 2 - 2 * delta;
    const Tensor<1, 2> force = Point<2>(100, 0);
    const Vector f = is_averaged
                         ? cell_load(result.body, {{rectangle(from, 0, 2, 1), force}})
                         : nodal_load(result.body, [&](const Point<2> &x)
                                      { return x[0] > from - 1e-9 ? force : Tensor<1, 2>(); });
    result.u.reinit(f.size());
    result.n_iterations = solve(matrix, result.u, f, 1e-10, 200).n_iterations;
    return result;
  }

  /// ×1e-3, h = 1/40, 1/60, 1/80, 1/100, to the solution by partial areas at h = 1/360.
  std::vector<double> bar_errors(BondOf bond, bool is_averaged, const BarSolution &reference)
  {
    std::vector<double> result;
    for (const int n : {40, 60, 80, 100})
    {
      const BarSolution coarse = bar(n, bond, is_averaged);
      result.push_back(
          1e3 * meshfree::distance(bar_pieces, coarse.body, coarse.u, reference.body, reference.u));
    }
    return result;
  }

  void expect_near(const std::vector<double> &values, const std::vector<double> &expected)
  {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], expected[i], .002 * expected[i]);
  }
} // namespace

TEST(VariationalBar, partial_areas_converge_steadily_and_full_areas_do_not)
{
  const BarSolution reference = bar(360, partial_area_bond, false);
  const auto partial = bar_errors(partial_area_bond, false, reference),
             full = bar_errors(full_area_bond, false, reference);
  EXPECT_TRUE(std::is_sorted(partial.rbegin(), partial.rend()));
  EXPECT_FALSE(std::is_sorted(full.rbegin(), full.rend()));
  // the circles of figure 1, as numbers by a second program
  expect_near(partial, {5.29, 4.02, 3.08, 2.37});
  expect_near(full, {4.31, 3.59, 2.06, 5.22});
}

TEST(VariationalBar, cell_averages_of_the_load_are_better)
{
  const BarSolution reference = bar(360, partial_area_bond, true);
  const auto partial = bar_errors(partial_area_bond, true, reference),
             full = bar_errors(full_area_bond, true, reference);
  EXPECT_TRUE(std::is_sorted(partial.rbegin(), partial.rend()));
  EXPECT_FALSE(std::is_sorted(full.rbegin(), full.rend()));
  expect_near(partial, {2.876, 1.203, .621, .410});
  expect_near(full, {10.65, 1.60, 1.596, 2.445});
}

TEST(VariationalBar, iterations_do_not_depend_on_h)
{
  for (const int n : {40, 80, 160})
    EXPECT_LE(bar(n, partial_area_bond, true).n_iterations, 30u) << n;
}
