// Interpolants of rules: what they reproduce, and their Lebesgue constants against brute force.

#include "uq/interpolation.h"
#include "uq/smolyak_terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{
  using namespace plumbline::uq;
  using Point = std::vector<double>;

  double value(const Interpolant &of, const std::function<double(const Point &)> &v,
               const Point &at)
  {
    const std::vector<double> J = of.coefficients(at);
    double sum = 0;
    for (std::size_t k = 0; k < J.size(); ++k)
      sum += J[k] * v(of.points()[k]);
    return sum;
  }

  /// The bound (3.16) of Fan et al. on Λ for Smolyak's rule of Chebyshev points, of which variable
  /// j has ϖ_j = 1, 2, ... at its levels.
  double chebyshev_lebesgue_bound(std::size_t n_variables, unsigned int level)
  {
    double sum = 0;
    for_each_smolyak_term(n_variables, level,
                          [&](double factor, const std::vector<unsigned int> &excess)
                          {
                            double product = std::abs(factor);
                            for (const unsigned int e : excess)
                              product *= 2 / M_PI * std::log(e + 2.) + 1; // ϖ = e + 1
                            sum += product;
                          });
    return sum;
  }

  double sum_of_sizes(const Interpolant &of, const Point &at)
  {
    double sum = 0;
    for (const double J : of.coefficients(at))
      sum += std::abs(J);
    return sum;
  }

  /// On a grid of n points a side of [-1, 1]².
  double brute_force(const Interpolant &of, int n)
  {
    double largest = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        largest = std::max(largest, sum_of_sizes(of, {2. * i / (n - 1) - 1, 2. * j / (n - 1) - 1}));
    return largest;
  }

  constexpr Law uniform = Law::uniform;
} // namespace

TEST(LineRule, FejerIsOfChebyshevsPointsExactToItsDegreeAndPositive)
{
  for (unsigned int n = 1; n <= 9; ++n)
  {
    const LineRule rule = fejer_rule(n);
    for (unsigned int p = 0; p < n; ++p)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        sum += rule.weights[i] * std::pow(rule.nodes[i], p);
      EXPECT_NEAR(sum, p % 2 == 0 ? 1. / (p + 1) : 0, 1e-14) << n << ", degree " << p;
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_GT(rule.weights[i], 0);
      EXPECT_NEAR(std::cos(n * std::acos(rule.nodes[i])), 0, 1e-13);
    }
  }
  EXPECT_EQ(chebyshev_points(2, 3).points.size(), 9u);
}

TEST(Interpolant, ReproducesPolynomialsAndItsPoints)
{
  const Point at = {.37, -.81};
  const auto product = [](const Point &x) { return std::pow(x[0], 4) * std::pow(x[1], 3); };
  for (const Interpolant &of :
       {Interpolant::tensor({uniform, Law::normal}, 5), Interpolant::chebyshev(2, 5)})
  {
    EXPECT_EQ(of.points().size(), 25u);
    EXPECT_NEAR(value(of, product, at), product(at), 1e-13);
    const std::vector<double> J = of.coefficients(of.points()[7]);
    for (std::size_t k = 0; k < J.size(); ++k)
      EXPECT_NEAR(J[k], k == 7 ? 1 : 0, 1e-13);
  }
  // (3.8) is exact for polynomials of total degree ζ - N, the level
  for (const Growth growth : {Growth::linear, Growth::odd, Growth::nested})
  {
    const Interpolant of = Interpolant::smolyak({uniform, uniform, uniform}, 3, growth);
    const Point x = {.3, -.9, .64};
    for (const auto &v :
         std::vector<std::function<double(const Point &)>>{
             [](const Point &p) { return p[0] * p[1] * p[2]; },
             [](const Point &p) { return p[0] * p[0] * p[2] - p[1] + 2; },
             [](const Point &p) { return p[1] * p[1] * p[1]; }})
      EXPECT_NEAR(value(of, v, x), v(x), 1e-12);
  }
}

// Fan et al., theorem 4: of an analytic function errors fall like e^-(C Q^β).
TEST(Interpolant, ConvergesGeometrically)
{
  const auto v = [](const Point &x) { return 1 / (2 + x[0] * x[1]); };
  std::vector<double> errors;
  for (const unsigned int n : {2u, 4u, 6u, 8u})
  {
    const Interpolant of = Interpolant::chebyshev(2, n);
    double largest = 0;
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 41; ++i)
      {
        const Point at = {i / 20. - 1, j / 20. - 1};
        largest = std::max(largest, std::abs(value(of, v, at) - v(at)));
      }
    errors.push_back(largest);
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_LT(errors[i], errors[i - 1] / 8) << i;
}

TEST(Lebesgue, OfTensorProductsIsThatOfTheGrid)
{
  // three points of Clenshaw and Curtis: -1, 0, 1, with 1 + x - x² at most 5/4
  EXPECT_NEAR(Interpolant::smolyak({uniform}, 1, Growth::nested).lebesgue()->found, 1.25, 1e-9);
  const Interpolant three = Interpolant::chebyshev(2, 3),
                    gauss = Interpolant::tensor({uniform, uniform}, 4);
  // the roots of T_3 have Λ = 5/3, at the ends
  EXPECT_NEAR(three.lebesgue()->found, 25. / 9, 1e-8);
  EXPECT_NEAR(three.lebesgue()->found, brute_force(three, 201), 1e-8);
  EXPECT_NEAR(gauss.lebesgue()->found, brute_force(gauss, 201), 1e-8);
  EXPECT_EQ(gauss.lebesgue()->found, gauss.lebesgue()->bound);
  EXPECT_FALSE(Interpolant::tensor({uniform, Law::normal}, 3).lebesgue());
}

TEST(Lebesgue, OfSparseGridsLiesBetweenBruteForceAndItsBound)
{
  for (const Growth growth : {Growth::nested, Growth::odd})
    for (const unsigned int level : {1u, 2u, 3u})
    {
      const Interpolant of = Interpolant::smolyak({uniform, uniform}, level, growth);
      const auto found = of.lebesgue();
      const double on_grid = brute_force(of, 65);
      ASSERT_TRUE(found);
      EXPECT_GT(found->found, on_grid * (1 - 1e-9)) << level;
      EXPECT_LT(found->found, 1.05 * on_grid) << level; // the grid nearly has the maximum
      EXPECT_LE(found->found, found->bound) << level;
    }
}

// (3.16): of one variable 2/π log(ϖ + 1) + 1, which Chebyshev's points keep and equidistant ones
// would not.
TEST(Lebesgue, OfChebyshevsPointsIsAtMostThePublishedBound)
{
  for (const unsigned int n : {1u, 2u, 5u, 20u, 60u})
  {
    const double found = Interpolant::chebyshev(1, n).lebesgue()->found;
    double cotangents = 0; // at the ends, where it is largest (Ehlich & Zeller 1966)
    for (unsigned int k = 1; k <= n; ++k)
      cotangents += 1 / std::tan((2 * k - 1) * M_PI / (4 * n)) / n;
    EXPECT_NEAR(found, cotangents, 1e-10) << n;
    EXPECT_LE(found, chebyshev_lebesgue_bound(1, n - 1)) << n;
    EXPECT_GT(found, .9 * chebyshev_lebesgue_bound(1, n - 1) - .45) << n;
  }
  // two variables, level 1: 1·(1, 1) + 1·[(1, 2) + (2, 1)]
  const double one = 2 / M_PI * std::log(2) + 1, two = 2 / M_PI * std::log(3) + 1;
  EXPECT_NEAR(chebyshev_lebesgue_bound(2, 1), one * one + 2 * one * two, 1e-13);
}
