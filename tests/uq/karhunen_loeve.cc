// Karhunen-Loève expansions against closed forms, dense matrices and products.
#include "uq/karhunen_loeve.h"
#include "base/error.h"
#include "base/symmetric_eigen.h"
#include "physics/gauss.h"
#include "refusal.h"
#include "uq/boolean_covariance.h"
#include "uq/spectrum.h"

#include <fftw3.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  /// The k-th eigenvalue, from 0, of exp(-|d|/ℓ) on an interval of length 1: ω is the root of
  /// 1 = ℓω tan(ω/2) for even k and of tan(ω/2) = -ℓω for odd k in (kπ, (k+1)π), λ = 2ℓ/(1 + ω²ℓ²).
  /// Derived by differentiating λφ = ∫ C φ twice: φ'' = -ω²φ, with ends φ' = ±φ/ℓ.
  double exponential_eigenvalue(double length, unsigned int k)
  {
    const auto residual = [&](double omega)
    {
      const double s = std::sin(omega / 2), c = std::cos(omega / 2);
      return k % 2 == 0 ? c - length * omega * s : s + length * omega * c;
    };
    double low = k * M_PI, high = (k + 1) * M_PI;
    for (int step = 0; step < 100; ++step)
    {
      const double middle = (low + high) / 2;
      ((residual(middle) > 0) == (residual(low + 1e-12) > 0) ? low : high) = middle;
    }
    return 2 * length / (1 + low * low * length * length);
  }

  LineModes exponential(double length, unsigned int n, unsigned int n_modes)
  {
    return karhunen_loeve([length](double d) { return std::exp(-std::abs(d) / length); }, 1, n,
                          n_modes);
  }

  LineModes gaussian(double length, unsigned int n, unsigned int n_modes)
  {
    return karhunen_loeve([length](double d) { return std::exp(-d * d / (2 * length * length)); },
                          1, n, n_modes);
  }

  double sum(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result += value;
    return result;
  }

  Covariance make(CovarianceShape shape, std::array<double, 2> length, double smoothness = 1.3)
  {
    Covariance covariance;
    covariance.shape = shape;
    covariance.length = length;
    covariance.variance = 1.7;
    covariance.smoothness = smoothness;
    return covariance;
  }

  /// The matrix cell_area · C(x_i - x_j) whole.
  Eigen::MatrixXd dense(const CovarianceFunction &covariance, const Grid &grid)
  {
    const auto n = static_cast<Eigen::Index>(grid.size());
    Eigen::MatrixXd matrix(n, n);
    const auto node = [&](Eigen::Index k)
    { return grid.node(static_cast<int>(k % grid.n[0]), static_cast<int>(k / grid.n[0])); };
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
      {
        const auto lag = node(i) - node(j);
        matrix(i, j) = grid.cell_area() * covariance(lag[0], lag[1]);
      }
    return matrix;
  }

  void expect_dense(const CovarianceFunction &covariance, const Grid &grid, unsigned int n_modes)
  {
    const Expansion e = karhunen_loeve(covariance, grid, n_modes);
    const Eigen::MatrixXd matrix = dense(covariance, grid);
    const Eigen::VectorXd values = base::symmetric_eigen(matrix).values;
    const double largest = e.eigenvalue[0];
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      const double expected = values[matrix.rows() - 1 - k];
      EXPECT_NEAR(e.eigenvalue[k], expected, 1e-10 * largest) << k;
      const Eigen::Map<const Eigen::VectorXd> mode(e.mode[k].data(), matrix.rows());
      EXPECT_LT((matrix * mode - expected * mode).norm() * std::sqrt(grid.cell_area()),
                1e-10 * largest)
          << k;
    }
    EXPECT_NEAR(e.total_variance(), matrix.trace(), 1e-12 * matrix.trace());
  }

  void expect_orthonormal(const Expansion &e)
  {
    for (unsigned int k = 0; k < e.n_modes(); ++k)
      for (unsigned int l = 0; l <= k; ++l)
      {
        double product = 0;
        for (std::size_t i = 0; i < e.grid.size(); ++i)
          product += e.mode[k][i] * e.mode[l][i];
        EXPECT_NEAR(product * e.grid.cell_area(), k == l ? 1 : 0, 1e-12) << k << ' ' << l;
      }
  }
} // namespace

TEST(KarhunenLoeve, of_the_exponential_tends_to_its_closed_form_at_second_order)
{
  for (const double length : {.2, 1.})
    for (const unsigned int k : {0u, 1u, 4u, 9u})
    {
      const double exact = exponential_eigenvalue(length, k);
      const auto error = [&](unsigned int n)
      { return std::abs(exponential(length, n, 10).eigenvalue[k] - exact); };
      const double coarse = error(100), fine = error(200);
      EXPECT_NEAR(std::log2(coarse / fine), 2, .03) << length << ' ' << k;
      // the error at 200 cells is no more than this of the eigenvalue
      EXPECT_LT(fine, 3e-3 * exact) << length << ' ' << k;
    }
}

TEST(KarhunenLoeve, of_the_exponential_has_the_values_of_a_prototype)
{
  // four of 1e-7 each, by extrapolation from 400 and 800 cells
  const auto coarse = exponential(.2, 400, 20), fine = exponential(.2, 800, 20);
  const double expected[5] = {.3309206, .2097761, .1239058, .0759654, .0496218};
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_NEAR((4 * fine.eigenvalue[k] - coarse.eigenvalue[k]) / 3, expected[k], 2e-7);
    EXPECT_NEAR(exponential_eigenvalue(.2, k), expected[k], 6e-8);
  }
  EXPECT_NEAR(exponential_eigenvalue(1, 0), .7388108, 6e-8);
  // the share of the variance in 10 and 20 modes
  const auto kept = [&](unsigned int n) {
    return sum({fine.eigenvalue.begin(), fine.eigenvalue.begin() + n});
  };
  EXPECT_NEAR(kept(10), .895, 6e-4);
  EXPECT_NEAR(kept(20), .948, 6e-4);
}

TEST(KarhunenLoeve, of_the_exponential_has_cosines_and_sines)
{
  // φ = cos ω(x - ½) for even k, sin for odd ones, normalised
  const unsigned int n = 800;
  const LineModes modes = exponential(.2, n, 4);
  for (unsigned int k = 0; k < 4; ++k)
  {
    const double lambda = exponential_eigenvalue(.2, k);
    const double omega = std::sqrt(2 / (.2 * lambda) - 1 / .04);
    const double even = k % 2 == 0 ? 1 : -1;
    const double norm = 1 / std::sqrt(.5 + even * std::sin(omega) / (2 * omega));
    double same = 0, opposite = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double s = omega * ((i + .5) / n - .5);
      const double expected = norm * (k % 2 == 0 ? std::cos(s) : std::sin(s));
      same = std::max(same, std::abs(modes.mode[k][i] - expected));
      opposite = std::max(opposite, std::abs(modes.mode[k][i] + expected));
    }
    EXPECT_LT(std::min(same, opposite), 2e-4) << k;
  }
}

TEST(KarhunenLoeve, of_the_Gaussian_has_the_values_of_a_prototype_and_few_modes_hold_all)
{
  const auto coarse = gaussian(.2, 200, 8), fine = gaussian(.2, 400, 8);
  const double expected[3] = {.440420, .299699, .159696};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR((4 * fine.eigenvalue[k] - coarse.eigenvalue[k]) / 3, expected[k], 6e-7);
  EXPECT_NEAR(sum(fine.eigenvalue), .99992, 6e-6);
}

TEST(KarhunenLoeve, separable_covariances_have_products_that_transforms_find_as_well)
{
  const Grid grid{{{0, 1}, {3, 2}}, {54, 41}};
  for (const auto shape : {CovarianceShape::separable_exponential, CovarianceShape::gaussian})
  {
    const Covariance covariance = make(shape, {.6, .25});
    const Expansion products = karhunen_loeve(covariance, grid, 30, 4.);
    const Expansion whole = karhunen_loeve(CovarianceFunction(covariance), grid, 30, 4.);
    for (unsigned int k = 0; k < 30; ++k)
    {
      EXPECT_NEAR(products.eigenvalue[k], whole.eigenvalue[k], 1e-12 * whole.eigenvalue[0]) << k;
      double product = 0; // simple eigenvalues here: the mode is the same, but for its sign
      for (std::size_t i = 0; i < grid.size(); ++i)
        product += products.mode[k][i] * whole.mode[k][i];
      EXPECT_NEAR(std::abs(product) * grid.cell_area(), 1, 1e-7) << k;
    }
    EXPECT_EQ(products.mean, std::vector<double>(grid.size(), 4.));
    EXPECT_DOUBLE_EQ(products.total_variance(), whole.total_variance());
    expect_orthonormal(products);
    expect_orthonormal(whole);
  }
}

TEST(KarhunenLoeve, separable_eigenvalues_are_products_of_those_of_lines)
{
  const Covariance covariance = make(CovarianceShape::separable_exponential, {.2, 1});
  const Expansion e = karhunen_loeve(covariance, Grid{{{0, 0}, {1, 1}}, {80, 80}}, 3);
  const auto x = exponential(.2, 80, 3), y = exponential(1, 80, 3);
  EXPECT_NEAR(e.eigenvalue[0], 1.7 * x.eigenvalue[0] * y.eigenvalue[0], 1e-14);
  EXPECT_NEAR(e.eigenvalue[1], 1.7 * x.eigenvalue[1] * y.eigenvalue[0], 1e-14);
  EXPECT_NEAR(e.eigenvalue[2], 1.7 * x.eigenvalue[2] * y.eigenvalue[0], 1e-14);
}

TEST(KarhunenLoeve, of_isotropic_covariances_is_that_of_the_dense_matrix)
{
  const Grid grid{{{-1, 0}, {1, 1}}, {32, 19}};
  expect_dense(make(CovarianceShape::exponential, {.4, .4}), grid, 25);
  expect_dense(make(CovarianceShape::matern, {.4, .7}), grid, 25);
  expect_dense(boolean_covariance({{.3, .2}, .4, true}), grid, 25);
  // one that is even, but under no reflection
  expect_dense([](double dx, double dy) { return std::exp(-std::hypot(2 * dx + dy, dy)); }, grid,
               25);
}

TEST(KarhunenLoeve, on_squares_finds_both_modes_of_a_pair)
{
  expect_dense(make(CovarianceShape::exponential, {.3, .3}), Grid{{{0, 0}, {1, 1}}, {24, 24}}, 20);
}

TEST(KarhunenLoeve, of_all_modes_gives_the_covariance_back)
{
  const Grid grid{{{0, 0}, {1, 2}}, {4, 5}};
  const Covariance covariance = make(CovarianceShape::matern, {.4, .4});
  const Expansion e = karhunen_loeve(covariance, grid, 20);
  EXPECT_NEAR(e.variance_kept(), 1, 1e-13);
  for (const double variance : e.variance_of_modes(20))
    EXPECT_NEAR(variance, 1.7, 1e-12);
  double at_two_nodes = 0; // nodes (0, 0) and (3, 2)
  for (unsigned int k = 0; k < 20; ++k)
    at_two_nodes += e.eigenvalue[k] * e.mode[k][0] * e.mode[k][11];
  EXPECT_NEAR(at_two_nodes, covariance(.75, .8), 1e-12);
}

TEST(KarhunenLoeve, has_modes_with_a_sign_of_their_own)
{
  const LineModes modes = exponential(.2, 100, 6), finer = exponential(.2, 120, 6);
  for (unsigned int k = 0; k < 6; ++k) // at the end, where none of them is small
    EXPECT_NEAR(modes.mode[k][0] / finer.mode[k][0], 1, .05) << k;
  for (const auto &mode : modes.mode)
  {
    double largest = 0;
    for (const double value : mode)
      largest = std::max(largest, std::abs(value));
    const auto first = std::find_if(mode.begin(), mode.end(),
                                    [&](double v) { return std::abs(v) >= largest / 2; });
    EXPECT_GT(*first, 0);
  }
}

TEST(KarhunenLoeve, of_twenty_modes_holds_next_to_nothing_of_a_microstructure)
{
  // Fan et al. 2022, doi:10.1016/j.cma.2022.115340, sec. 5 keep 20 principal components of grains
  // of 12 × 7.5 on 800 × 400 µm²: no eigenvalue is above ∫C, so that no 20 modes hold more than
  const double expected[4] = {.0166, .0152, .0134, .0106};
  const auto &rule = physics::gauss(100);
  for (int i = 0; i < 4; ++i)
  {
    const double f = .2 * (i + 1), variance = f * (1 - f), area = 800 * 400;
    const auto covariance = boolean_covariance({{12, 7.5}, f, true});
    double integral = 0; // C ends at r = 24
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double r = 24 * rule.point(q)[0];
      integral += 24 * rule.weight(q) * 2 * M_PI * r * covariance(r, 0);
    }
    const double bound = 20 * integral / (variance * area);
    EXPECT_NEAR(bound, expected[i], 5e-5);
    if (i != 3)
      continue; // one tells enough
    constexpr double h = 4;
    double sum = 0; // on the lattice the same holds for the sum in place of the integral
    for (int k = -6; k <= 6; ++k)
      for (int l = -6; l <= 6; ++l)
        sum += h * h * covariance(h * k, h * l);
    EXPECT_NEAR(sum / integral, 1, .02);
    const Expansion e = karhunen_loeve(covariance, make_grid({{0, 0}, {800, 400}}, h), 20);
    EXPECT_LT(e.variance_kept(), bound * sum / integral);
    EXPECT_GT(e.variance_kept(), .98 * bound * sum / integral); // it is nearly reached
    EXPECT_NEAR(e.total_variance(), variance * area, 1e-9 * area);
  }
}

TEST(KarhunenLoeve, has_the_same_bits_whatever_threads_others_ask_transforms_for)
{
  const Covariance covariance = make(CovarianceShape::exponential, {.3, .3});
  const Grid grid{{{0, 0}, {2, 1}}, {200, 100}};
  const Expansion one = karhunen_loeve(covariance, grid, 4);
  fftw_plan_with_nthreads(2);
  const Expansion two = karhunen_loeve(covariance, grid, 4);
  EXPECT_EQ(one.eigenvalue, two.eigenvalue);
  EXPECT_EQ(one.mode, two.mode);
}

TEST(KarhunenLoeve, refuses_what_it_cannot_do_with_numbers_and_remedy)
{
  const Grid grid{{{0, 0}, {1, 1}}, {3, 2}};
  for (const auto shape : {CovarianceShape::exponential, CovarianceShape::gaussian})
  {
    EXPECT_EQ(refusal(
                  [&] {
                    karhunen_loeve(make(shape, {1, 1}), grid, 7);
                  }),
              "a random field on a grid of 3 x 2 nodes has 1 to 6 modes, not 7; ask for fewer, or "
              "refine the grid");
    EXPECT_THROW(karhunen_loeve(make(shape, {1, -1}), grid, 2), InputError);
    EXPECT_THROW(karhunen_loeve(make(shape, {1, 1}), grid, 0), InputError);
  }
  // a disk is no covariance
  const auto disk = [](double dx, double dy) { return std::hypot(dx, dy) < .8 ? 1. : 0.; };
  EXPECT_NE(refusal([&] { karhunen_loeve(disk, grid, 6); }).find("it is no covariance"),
            std::string::npos);
  EXPECT_NE(refusal([&] { karhunen_loeve([](double d, double) { return 1 / d; }, grid, 1); })
                .find("is inf at distance (0, 0)"),
            std::string::npos);
}

TEST(Spectrum, tells_what_modes_hold)
{
  Expansion expansion;
  expansion.grid = {{{0, 0}, {2, 1}}, {2, 1}};
  expansion.variance = {3, 1}; // 4 in all
  expansion.eigenvalue = {2, 1};
  const Spectrum spectrum = spectrum_of(expansion);
  EXPECT_EQ(spectrum.share, (std::vector<double>{.5, .25}));
  EXPECT_EQ(spectrum.kept, (std::vector<double>{.5, .75}));
  EXPECT_NEAR(spectrum.deviation, std::sqrt(1.5), 1e-15);
  EXPECT_NEAR(spectrum.whole_deviation, std::sqrt(2.), 1e-15);
  EXPECT_FALSE(spectrum.is_grey());
  EXPECT_EQ(words_of(spectrum), "2 modes hold 75 % of the variance: the standard deviation of the "
                                "field is 1.22 instead of 1.41");
  expansion.variance = {0, 0}; // nothing to hold
  expansion.eigenvalue = {0, 0};
  EXPECT_EQ(spectrum_of(expansion).variance_kept(), 1);
}
