// Symbols of stencils whose waves have closed forms.
#include "algebra/symbol.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  constexpr double h = .1;

  /// The mass matrix 1 of nodes at the cells' centres.
  Stencil unit_mass(unsigned int n_blocks)
  {
    Stencil mass(n_blocks, 0);
    for (unsigned int s = 0; s < n_blocks; ++s)
      mass(s, s, 0, 0) = 1;
    return mass;
  }

  /// The five-point Laplacian on a lattice of size h.
  WaveOperator five_points()
  {
    Stencil a(1, 1);
    a(0, 0, 0, 0) = 4 / (h * h);
    a(0, 0, 1, 0) = a(0, 0, -1, 0) = a(0, 0, 0, 1) = a(0, 0, 0, -1) = -1 / (h * h);
    return {h, a, unit_mass(1), 1, {{.5, .5}}};
  }

  double five_point_symbol(double k, double angle)
  {
    return 4 / (h * h) *
           (std::pow(std::sin(.5 * k * h * std::cos(angle)), 2) +
            std::pow(std::sin(.5 * k * h * std::sin(angle)), 2));
  }

  /// The same with four nodes on each cell of size 2 h.
  WaveOperator five_points_on_double_cells()
  {
    Stencil a(4, 1);
    for (int s2 = 0; s2 < 2; ++s2)
      for (int s1 = 0; s1 < 2; ++s1)
        for (const auto &[d1, d2, value] :
             {std::tuple{0, 0, 4.}, {1, 0, -1.}, {-1, 0, -1.}, {0, 1, -1.}, {0, -1, -1.}})
        {
          const int t1 = s1 + d1, t2 = s2 + d2;
          const auto cell = [](int t) { return t < 0 ? -1 : t / 2; };
          a(s1 + 2 * s2, (t1 + 2) % 2 + 2 * ((t2 + 2) % 2), cell(t1), cell(t2)) = value / (h * h);
        }
    return {2 * h, a, unit_mass(4), 1, {{.25, .25}, {.75, .25}, {.25, .75}, {.75, .75}}};
  }

  /// Continuous bilinear elements of the Laplacian on squares: K⊗M + M⊗K.
  WaveOperator bilinear()
  {
    const double stiffness[] = {-1, 2, -1}, mass[] = {1. / 6, 4. / 6, 1. / 6};
    Stencil a(1, 1), m(1, 1);
    for (int j2 = -1; j2 <= 1; ++j2)
      for (int j1 = -1; j1 <= 1; ++j1)
      {
        a(0, 0, j1, j2) = stiffness[j1 + 1] * mass[j2 + 1] + mass[j1 + 1] * stiffness[j2 + 1];
        m(0, 0, j1, j2) = h * h * mass[j1 + 1] * mass[j2 + 1];
      }
    return {h, a, m, 1, {{0, 0}}};
  }

  /// Springs of two components to the eight neighbours, along each bond.
  WaveOperator springs()
  {
    Stencil a(2, 1);
    for (int j2 = -1; j2 <= 1; ++j2)
      for (int j1 = -1; j1 <= 1; ++j1)
        for (int s = 0; s < 2 && (j1 != 0 || j2 != 0); ++s)
          for (int t = 0; t < 2; ++t)
          {
            const double e[] = {double(j1), double(j2)};
            const double entry = e[s] * e[t] / (j1 * j1 + j2 * j2);
            a(s, t, j1, j2) -= entry;
            a(s, t, 0, 0) += entry;
          }
    return {h, a, unit_mass(2), 2, {{.5, .5}}};
  }

  const double angles[] = {0, .3, M_PI / 4, 1.4};
} // namespace

TEST(Symbol, of_the_five_point_laplacian)
{
  const Symbol symbol(five_points());
  for (const double angle : angles)
  {
    for (const double k : {.1, 3., 20., 31.})
    {
      const auto waves = symbol.waves(k, in_plane(angle));
      ASSERT_EQ(waves.size(), 1u);
      EXPECT_NEAR(waves[0].squared, five_point_symbol(k, angle), 1e-13 * 8 / (h * h)) << k;
      const double c = std::cos(angle), s = std::sin(angle);
      EXPECT_NEAR(waves[0].slope, 2 / h * (c * std::sin(k * h * c) + s * std::sin(k * h * s)),
                  1e-12 / h);
    }
    EXPECT_NEAR(symbol.long_waves(in_plane(angle)).front(), 1, 1e-13);
  }
  EXPECT_NEAR(symbol.range().largest, 8 / (h * h), 1e-12 * 8 / (h * h));
  EXPECT_NEAR(symbol.range().least, 0, 1e-12 * 8 / (h * h));
}

TEST(Symbol, acoustic_waves_do_not_depend_on_how_many_nodes_a_cell_has)
{
  const Symbol one(five_points()), four(five_points_on_double_cells());
  for (const double angle : angles)
  {
    for (const double k : {.5, 5., 14.})
    {
      const auto a = one.waves(k, in_plane(angle)), b = four.waves(k, in_plane(angle));
      ASSERT_EQ(b.size(), 1u);
      EXPECT_NEAR(a[0].squared, b[0].squared, 1e-12 * 8 / (h * h)) << k << ' ' << angle;
      EXPECT_NEAR(a[0].slope, b[0].slope, 1e-11 / h) << k << ' ' << angle;
    }
    EXPECT_NEAR(four.long_waves(in_plane(angle)).front(), 1, 1e-12);
  }
  EXPECT_NEAR(four.range().largest, 8 / (h * h), 1e-12 * 8 / (h * h));
}

TEST(Symbol, with_a_consistent_and_a_lumped_mass)
{
  // along an axis the other one's factor is 1: ω² = (6/h²) (1 - cos kh) / (2 + cos kh) · 2
  const Symbol consistent(bilinear());
  WaveOperator other = bilinear();
  EXPECT_TRUE(couples_cells(other.mass));
  other.mass = lump(other.mass, 1);
  EXPECT_FALSE(couples_cells(other.mass));
  EXPECT_NEAR(other.mass(0, 0, 0, 0), h * h, 1e-16);
  const Symbol lumped(other);
  for (const double k : {1., 10., 30.})
  {
    const double c = std::cos(k * h), wave = 6 * (1 - c) / (2 + c) / (h * h);
    EXPECT_NEAR(consistent.waves(k, in_plane(0))[0].squared, wave, 1e-13 * 24 / (h * h)) << k;
    EXPECT_NEAR(consistent.waves(k, in_plane(0))[0].slope,
                18 * std::sin(k * h) / std::pow(2 + c, 2) / h, 1e-11 / h)
        << k;
    EXPECT_NEAR(lumped.waves(k, in_plane(0))[0].squared, 2 * (1 - c) / (h * h), 1e-12 / (h * h))
        << k;
  }
  EXPECT_NEAR(consistent.long_waves(in_plane(.3))[0], 1, 1e-13);
  // both factors at the corner of the zone: 2 · 12/h²; lumped (1 - c1)(2 + c2)/3 + ... has its
  // maximum 4/h² along an axis
  EXPECT_NEAR(consistent.range().largest, 24 / (h * h), 1e-11 / (h * h));
  EXPECT_NEAR(lumped.range().largest, 4 / (h * h), 1e-11 / (h * h));
}

TEST(Symbol, of_a_chain_of_two_springs)
{
  // springs a and b in turn between unit masses d = h/2 apart: not even long waves are linear
  // from node to node, ω² = a + b - √(a² + b² + 2 a b cos kh), ω²/k² → 2 a b d² / (a + b)
  constexpr double a = 1, b = 3, d = h / 2;
  WaveOperator chain{h, Stencil(2, 1), unit_mass(2), 1, {{.25, .5}, {.75, .5}}};
  chain.stiffness(0, 0, 0, 0) = chain.stiffness(1, 1, 0, 0) = a + b;
  chain.stiffness(0, 1, 0, 0) = chain.stiffness(1, 0, 0, 0) = -a;
  chain.stiffness(0, 1, -1, 0) = chain.stiffness(1, 0, 1, 0) = -b;
  const Symbol symbol(chain);
  for (const double k : {1., 10., 25.})
    EXPECT_NEAR(symbol.waves(k, in_plane(0))[0].squared,
                a + b - std::sqrt(a * a + b * b + 2 * a * b * std::cos(k * h)), 1e-13);
  EXPECT_NEAR(symbol.long_waves(in_plane(0))[0], 2 * a * b * d * d / (a + b), 1e-15);
  EXPECT_NEAR(symbol.range().largest, 2 * (a + b), 1e-12);
}

TEST(Symbol, tells_waves_along_from_waves_across)
{
  const Symbol symbol(springs());
  for (const double k : {.2, 4., 25.})
  {
    const double c = 1 - std::cos(k * h);
    const auto axis = symbol.waves(k, in_plane(0));
    ASSERT_EQ(axis.size(), 2u);
    EXPECT_NEAR(axis[0].squared, 4 * c, 1e-12); // 2 along, 4 diagonal bonds with one half
    EXPECT_NEAR(axis[1].squared, 2 * c, 1e-12);
    // across the diagonal: two axes with one half each, the other diagonal's bonds do not move
    const double a = 1 - std::cos(k * h * M_SQRT1_2), b = 1 - std::cos(k * h * M_SQRT2);
    const auto diagonal = symbol.waves(k, in_plane(M_PI / 4));
    EXPECT_NEAR(diagonal[0].squared, 2 * a + 2 * b, 1e-12);
    EXPECT_NEAR(diagonal[1].squared, 2 * a, 1e-12);
  }
  EXPECT_NEAR(symbol.long_waves(in_plane(0))[0], 2 * h * h, 1e-14);
  EXPECT_NEAR(symbol.long_waves(in_plane(M_PI / 4))[0], 2.5 * h * h, 1e-14);
  EXPECT_NEAR(symbol.long_waves(in_plane(M_PI / 4))[1], .5 * h * h, 1e-14);
}

TEST(Symbol, finds_extrema_that_lie_between_points_of_a_grid)
{
  // 1 - cos κ_1 + a (1 - cos 2 κ_1) is largest where cos κ_1 = -1 / (4 a)
  constexpr double a = .8;
  WaveOperator waves{1, Stencil(1, 2), unit_mass(1), 1, {{.5, .5}}};
  for (const auto &[j, factor] : {std::pair{1, 1.}, {2, a}})
  {
    waves.stiffness(0, 0, 0, 0) += factor;
    waves.stiffness(0, 0, j, 0) -= factor / 2;
    waves.stiffness(0, 0, -j, 0) -= factor / 2;
  }
  const double c = -1 / (4 * a);
  EXPECT_NEAR(Symbol(waves).range().largest, 1 - c + a * (2 - 2 * c * c), 1e-12);
}

namespace
{
  /// Adds a cos(j·κ) to a scalar symbol.
  void add_cosine(Stencil &stencil, int j1, int j2, double a)
  {
    stencil(0, 0, j1, j2) += a / 2;
    stencil(0, 0, -j1, -j2) += a / 2;
  }

  /// -b (cos κ_1 + q cos κ_2 - c)².
  void subtract_square(Stencil &stencil, double b, double q, double c)
  {
    add_cosine(stencil, 0, 0, -b * (c * c + .5 * (1 + q * q)));
    add_cosine(stencil, 2, 0, -b / 2);
    add_cosine(stencil, 0, 2, -b * q * q / 2);
    add_cosine(stencil, 1, 1, -b * q);
    add_cosine(stencil, 1, -1, -b * q);
    add_cosine(stencil, 1, 0, 2 * b * c);
    add_cosine(stencil, 0, 1, 2 * b * q * c);
  }

  /// Bonds to the cells that a ball of radius m reaches, by full or sampled areas, of equal or
  /// decaying stiffness, scalar or along the bond; rough ones differ from bond to bond.
  WaveOperator bonds_of_a_ball(std::mt19937 &generator, double m, unsigned int n, bool is_partial,
                               bool decays, bool is_rough)
  {
    std::uniform_real_distribution<double> rough(.2, 1.2);
    const int reach = static_cast<int>(m + .5);
    Stencil a(n, reach);
    for (int j2 = 0; j2 <= reach; ++j2)
      for (int j1 = -reach; j1 <= reach; ++j1)
        if (j2 > 0 || j1 > 0)
        {
          const double r = std::hypot(j1, j2);
          constexpr int n_points = 9;
          int n_inside = 0;
          for (int k = 0; k < n_points * n_points; ++k)
            n_inside += std::hypot(j1 + (k % n_points - 4.) / n_points,
                                   j2 + (k / n_points - 4.) / n_points) < m
                            ? 1
                            : 0;
          const double area = is_partial ? n_inside / double(n_points * n_points)
                              : r < m    ? 1
                                         : 0,
                       weight = area * (decays ? 1 - r / (m + 1) : 1) *
                                (is_rough ? rough(generator) : 1);
          const double e[] = {j1 / r, j2 / r};
          for (unsigned int s = 0; s < n; ++s)
            for (unsigned int t = 0; t < n; ++t)
            {
              const double entry = n == 1 ? weight : weight * e[s] * e[t];
              a(s, t, j1, j2) -= entry;
              a(s, t, -j1, -j2) -= entry;
              a(s, t, 0, 0) += 2 * entry;
            }
        }
    return {1, a, unit_mass(n), n, {{.5, .5}}};
  }
} // namespace

TEST(Symbol, finds_the_top_of_a_ring_shaped_ridge)
{
  // 3 - (cos κ_1 + q cos κ_2 - c)² - b (cos κ_1 - d)²: a ridge along a closed curve, along which
  // the symbol varies by b alone; 3 where both squares vanish
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 100; ++i)
  {
    const double first = .95 * uniform(generator), second = .95 * uniform(generator),
                 q = 1 + .3 * uniform(generator), b = std::pow(10, -2 + 2 * uniform(generator));
    WaveOperator waves{1, Stencil(1, 2), unit_mass(1), 1, {{.5, .5}}};
    add_cosine(waves.stiffness, 0, 0, 3);
    subtract_square(waves.stiffness, 1, q, first + q * second);
    subtract_square(waves.stiffness, b, 0, first);
    EXPECT_NEAR(Symbol(waves).range().largest, 3, 1e-12 * 3) << first << ' ' << second << ' ' << b;
  }
}

TEST(Symbol, is_nowhere_larger_than_its_range)
{
  constexpr int n_points = 50; // on π: 13 or more on the shortest oscillation
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> radius(2, 5.4);
  for (int i = 0; i < 16; ++i)
  {
    const double m = radius(generator);
    const Symbol symbol(
        bonds_of_a_ball(generator, m, i % 2 + 1, i / 2 % 2 == 0, i / 4 % 2 == 0, i / 8 % 2 == 0));
    double sampled = 0;
    for (int k2 = -n_points; k2 < n_points; ++k2)
      for (int k1 = 0; k1 <= n_points; ++k1)
        if (k1 != 0 || k2 != 0)
          for (const PlaneWave &wave :
               symbol.waves(M_PI / n_points * std::hypot(k1, k2), in_plane(std::atan2(k2, k1))))
            sampled = std::max(sampled, wave.squared);
    const double largest = symbol.range().largest;
    EXPECT_GE(largest, sampled * (1 - 1e-13)) << i << ", m = " << m;
    EXPECT_LE(largest, sampled * (1 + 1e-2)) << i << ", m = " << m;
  }
}

namespace
{
  /// The seven-point Laplacian on a lattice of size h in space.
  WaveOperator seven_points()
  {
    Stencil a(1, {1, 1, 1});
    a(0, 0, 0, 0, 0) = 6 / (h * h);
    for (const int j : {-1, 1})
      a(0, 0, j, 0, 0) = a(0, 0, 0, j, 0) = a(0, 0, 0, 0, j) = -1 / (h * h);
    return {h, a, unit_mass(1), 1, {{}}};
  }

  /// Springs of three components to the 26 neighbours, along each bond.
  WaveOperator springs_in_space()
  {
    Stencil a(3, {1, 1, 1});
    for (int j3 = -1; j3 <= 1; ++j3)
      for (int j2 = -1; j2 <= 1; ++j2)
        for (int j1 = -1; j1 <= 1; ++j1)
          for (int s = 0; s < 3 && (j1 != 0 || j2 != 0 || j3 != 0); ++s)
            for (int t = 0; t < 3; ++t)
            {
              const double e[] = {double(j1), double(j2), double(j3)};
              const double entry = e[s] * e[t] / (j1 * j1 + j2 * j2 + j3 * j3);
              a(s, t, j1, j2, j3) -= entry;
              a(s, t, 0, 0, 0) += entry;
            }
    return {h, a, unit_mass(3), 3, {{}}};
  }
} // namespace

TEST(Symbol, of_the_seven_point_laplacian)
{
  const Symbol symbol(seven_points());
  for (const Vector3 n : {Vector3{1}, {0, 0, 1}, {.6, 0, .8}, {.48, .64, .6}})
  {
    for (const double k : {.1, 3., 20., 31.})
    {
      double squared = 0, slope = 0;
      for (const double cosine : n)
      {
        squared += 4 / (h * h) * std::pow(std::sin(.5 * k * h * cosine), 2);
        slope += 2 / h * cosine * std::sin(k * h * cosine);
      }
      EXPECT_NEAR(symbol.waves(k, n)[0].squared, squared, 1e-13 * 12 / (h * h)) << k;
      EXPECT_NEAR(symbol.waves(k, n)[0].slope, slope, 1e-12 / h) << k;
    }
    EXPECT_NEAR(symbol.long_waves(n).front(), 1, 1e-13);
  }
  EXPECT_NEAR(symbol.range().largest, 12 / (h * h), 1e-12 * 12 / (h * h));
  EXPECT_NEAR(symbol.range().least, 0, 1e-12 * 12 / (h * h));
}

TEST(Symbol, of_springs_in_space_has_one_wave_along_and_two_across_each_direction)
{
  const Symbol symbol(springs_in_space());
  const double edge = std::sqrt(.5), corner = std::sqrt(1. / 3);
  for (const double k : {.1, 5., 20.})
  {
    const auto expect = [&](const Vector3 &n, const std::array<double, 3> &squares)
    {
      const auto waves = symbol.waves(k, n);
      ASSERT_EQ(waves.size(), 3u);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(waves[i].squared, squares[i], 1e-12) << k << ", wave " << i;
    };
    const double c = 1 - std::cos(k * h), a = 1 - std::cos(k * h * edge),
                 b = 1 - std::cos(2 * k * h * edge);
    for (const Vector3 n : {Vector3{1}, {0, 1}, {0, 0, 1}})
      expect(n, {c * 26 / 3, c * 14 / 3, c * 14 / 3});
    // T1 across the third axis, T2 along it
    expect({edge, edge}, {4 * a + b * 14 / 3, 4 * a, 4 * a + b * 4 / 3});
  }
  // C11 = 26/3, C12 = C44 = 14/3 times h²/2 along the diagonal of the cube
  const auto squares = symbol.long_waves({corner, corner, corner});
  EXPECT_NEAR(squares[0], .5 * h * h * (26 + 6 * 14) / 9, 1e-14);
  EXPECT_NEAR(squares[1], .5 * h * h * 26 / 9, 1e-14);
  EXPECT_NEAR(squares[2], .5 * h * h * 26 / 9, 1e-14);
}

TEST(Symbol, finds_extrema_in_space_that_lie_between_points_of_a_grid)
{
  // Σ_d [1 - cos κ_d + a_d (1 - cos 2 κ_d)] is largest where cos κ_d = -1 / (4 a_d)
  constexpr double a[] = {.8, .5, .3};
  WaveOperator waves{1, Stencil(1, {2, 2, 2}), unit_mass(1), 1, {{}}};
  double largest = 0;
  for (int d = 0; d < 3; ++d)
  {
    for (const auto &[j, factor] : {std::pair{1, 1.}, {2, a[d]}})
    {
      waves.stiffness(0, 0, 0, 0, 0) += factor;
      for (const int k : {j, -j})
        waves.stiffness(0, 0, d == 0 ? k : 0, d == 1 ? k : 0, d == 2 ? k : 0) -= factor / 2;
    }
    const double c = -1 / (4 * a[d]);
    largest += 1 - c + a[d] * (2 - 2 * c * c);
  }
  EXPECT_NEAR(Symbol(waves).range().largest, largest, 1e-12);
}

TEST(Symbol, is_nowhere_larger_in_space_than_its_range)
{
  // rough bonds have extrema off all axes of symmetry
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> rough(0, 1);
  for (const unsigned int n : {1u, 3u})
  {
    WaveOperator waves{1, Stencil(n, {2, 2, 2}), unit_mass(n), n, {{}}};
    Stencil &a = waves.stiffness;
    for (int j3 = -2; j3 <= 2; ++j3)
      for (int j2 = -2; j2 <= 2; ++j2)
        for (int j1 = -2; j1 <= 2; ++j1)
          if (std::array{j3, j2, j1} > std::array{0, 0, 0})
          {
            const double weight = rough(generator), e[] = {double(j1), double(j2), double(j3)};
            for (unsigned int s = 0; s < n; ++s)
              for (unsigned int t = 0; t < n; ++t)
              {
                const double entry =
                    weight * (n == 1 ? 1 : e[s] * e[t] / (j1 * j1 + j2 * j2 + j3 * j3));
                a(s, t, j1, j2, j3) -= entry;
                a(s, t, -j1, -j2, -j3) -= entry;
                a(s, t, 0, 0, 0) += 2 * entry;
              }
          }
    const Symbol symbol(waves);
    double sampled = 0;
    constexpr int n_points = 14; // on π
    for (int k3 = -n_points; k3 < n_points; ++k3)
      for (int k2 = -n_points; k2 < n_points; ++k2)
        for (int k1 = 1; k1 <= n_points; ++k1)
        {
          const double size = std::hypot(k1, k2, k3);
          for (const PlaneWave &wave :
               symbol.waves(M_PI / n_points * size, {k1 / size, k2 / size, k3 / size}))
            sampled = std::max(sampled, wave.squared);
        }
    const double largest = symbol.range().largest;
    EXPECT_GE(largest, sampled * (1 - 1e-13)) << n;
    EXPECT_LE(largest, sampled * (1 + 3e-2)) << n;
  }
}

TEST(Symbol, sees_waves_that_grow)
{
  WaveOperator waves = five_points();
  waves.stiffness(0, 0, 0, 0) -= 1 / (h * h);
  EXPECT_NEAR(Symbol(waves).range().least, -1 / (h * h), 1e-9);
  EXPECT_LT(Symbol(waves).waves(1, in_plane(0))[0].squared, 0);
}

TEST(Symbol, refuses_what_has_no_waves)
{
  WaveOperator one_sided = five_points();
  one_sided.stiffness(0, 0, 1, 0) = 0;
  EXPECT_THROW(Symbol{one_sided}, NumericalError);
  WaveOperator massless = five_points();
  massless.mass(0, 0, 0, 0) = 0;
  EXPECT_THROW(Symbol(massless).waves(1, in_plane(0)), NumericalError);
}
