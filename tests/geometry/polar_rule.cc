#include "geometry/ball_cell.h"

#include "placements.h"

#include <gtest/gtest.h>

namespace plumbline::geometry
{
  namespace
  {
    constexpr int degree = 8, n_monomials = (degree + 1) * (degree + 2) / 2;
    using Integrals = std::array<std::array<Real, n_monomials>, 3>; // kernels 1, 1-r/R, 1/r

    /// Adds ∫ kernel z^(a,b), or with `absolute` ∫ |kernel| |z|^(a+b).
    void integrate(const Case &c, Integrals &sum, bool absolute = false)
    {
      const CutRule rule = polar_rule(c.ball, view(c.cell));
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        const auto z = rule.points[q] - c.ball.centre;
        const double r = z.norm(), w = rule.weights[q];
        ASSERT_GT(w, 0);
        const double kernels[] = {w, w * (1 - r / c.ball.radius), w / r};
        double x[degree + 1] = {1}, y[degree + 1] = {1}; // powers
        for (int k = 0; k < degree; ++k)
        {
          x[k + 1] = x[k] * (absolute ? r : z[0]);
          y[k + 1] = y[k] * (absolute ? r : z[1]);
        }
        for (int total = 0, i = 0; total <= degree; ++total)
          for (int b = 0; b <= total; ++b, ++i)
            for (int k = 0; k < 3; ++k)
              sum[k][i] += kernels[k] * x[total - b] * y[b];
      }
    }

    /// ∫ |cos|^a |sin|^b over the circle.
    double angular(int a, int b)
    {
      return 2 * std::tgamma(.5 * (a + 1)) * std::tgamma(.5 * (b + 1)) /
             std::tgamma(.5 * (a + b + 2));
    }
  } // namespace

  TEST(PolarRule, LatticeCellsAddUpToTheDiscsMoments)
  {
    double worst = 0;
    for (double R : {.1, .4, 1., 2.5, 3., 5., 20.})
      for (const Point<2> &centre : {Point<2>(0, 0), Point<2>(.5, .5), Point<2>(.5, 0),
                                     Point<2>(.37, .21), Point<2>(.4, 1e-3), Point<2>(.4, 1e-9)})
      {
        if (R == 20 && centre[0] == .4)
          continue; // time
        Integrals sum{};
        const int n = static_cast<int>(R) + 2;
        for (int i = -n; i < n; ++i)
          for (int j = -n; j < n; ++j)
            integrate({{centre, R}, box(Point<2>(i, j), 1)}, sum);
        for (int total = 0, i = 0; total <= degree; ++total)
          for (int b = 0; b <= total; ++b, ++i)
          {
            const double power = std::pow(R, total + 2), even = total % 2 == 0 && b % 2 == 0;
            const double radial[] = {power / (total + 2), power / ((total + 2) * (total + 3)),
                                     power / R / (total + 1)};
            for (int k = 0; k < 3; ++k)
            {
              const Real error = sum[k][i] - even * radial[k] * angular(total - b, b);
              worst =
                  std::max(worst, double(std::abs(error)) / (radial[k] * angular(total - b, b)));
            }
          }
      }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
  }

  TEST(PolarRule, ReproducesTheMomentsOfTheRegion)
  {
    RandomCases random(10);
    double worst = 0;
    for (int trial = 0; trial < 2000; ++trial)
    {
      Case c = random.next(ratios[trial % std::size(ratios)]);
      if (trial % 4 == 1)
        c.ball.centre = c.cell[1];
      if (trial % 4 == 2)
        c.ball.centre = c.cell[1] + random.uniform(0, 1) * (c.cell[2] - c.cell[1]);
      const CutRule rule = polar_rule(c.ball, view(c.cell));
      std::array<Real, 6> sum{};
      const double slack = 1e-13 * (c.ball.radius + c.ball.centre.norm());
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        ASSERT_GT(rule.weights[q], 0);
        ASSERT_LE(rule.points[q].distance(c.ball.centre), c.ball.radius + slack);
        const auto z = rule.points[q] - origin(c);
        const Real six[] = {1, z[0], z[1], z[0] * z[0], z[0] * z[1], z[1] * z[1]};
        for (int i = 0; i < 6; ++i)
          sum[i] += rule.weights[q] * six[i];
      }
      worst = std::max(worst, difference(sum, about(moments(c), origin(c)), c));
    }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
  }

  /// A centre that is off a side's line by rounding alone sees the side edge-on: angles are known
  /// to rounding only, and an interval of that size was halved without end (2^44 times).
  TEST(PolarRule, ACentreOnTheLineOfASideNeedsNoMorePointsThanOthers)
  {
    // found on a plate with a hole: a triangle, and the point of another one beyond its corner
    const Polygon triangle{Point<2>(0.49999999999999861, 0.10996816064797654),
                           Point<2>(0.42107306090111529, 0.078981158525275541), Point<2>(0.5, 0)};
    const Ball ball{Point<2>(0.49999999999999861, 0.11009551527939163), 0.30000000000000004};
    constexpr std::size_t most = 64 * 8 * 4; // intervals of rays of points
    const CutRule found = polar_rule(ball, view(triangle), 8, 4);
    EXPECT_LE(found.points.size(), most);

    RandomCases random(13);
    std::size_t largest = 0;
    for (int trial = 0; trial < 20000; ++trial)
    {
      Case c = random.next(ratios[trial % std::size(ratios)]);
      const double size = c.cell[1].distance(c.cell[2]), beyond = random.uniform(0, 1);
      const double off = size * std::pow(10., -random.uniform(10, 17));
      c.ball.centre = c.cell[2] + beyond * (c.cell[2] - c.cell[1]) +
                      off * Point<2>(random.uniform(-1, 1), random.uniform(-1, 1));
      largest = std::max(largest, polar_rule(c.ball, view(c.cell), 8, 4).points.size());
    }
    RecordProperty("largest", std::to_string(largest));
    EXPECT_LE(largest, most);
  }

  TEST(PolarRule, HalvesOfAPolygonAddUpToItForEveryKernel)
  {
    RandomCases random(11);
    double worst = 0;
    int n_seen = 0;
    for (int trial = 0; trial < 450; ++trial)
    {
      Case c = random.next(ratios[trial % std::size(ratios)]);
      if (trial % 3 == 0)
        c.ball.centre = c.cell[1] + random.uniform(0, 1) * (c.cell[2] - c.cell[1]);
      for (auto &v :
           c.cell) // keep the rounding of the points' own coordinates out of the distances
        v = Point<2>(v - c.ball.centre);
      c.ball.centre = Point<2>();
      const std::size_t k = 2 + static_cast<std::size_t>(random.uniform(0, c.cell.size() - 3));
      const Case one{c.ball, Polygon(c.cell.begin(), c.cell.begin() + k + 1)};
      Case two{c.ball, Polygon(c.cell.begin() + k, c.cell.end())};
      two.cell.push_back(c.cell[0]);
      Integrals sum{}, whole{}, size{};
      integrate(one, sum);
      integrate(two, sum);
      integrate(c, whole);
      integrate(c, size, true);
      if (size[0][0] < 1e-2 * least_area(c))
        continue; // a sliver: its integrals are relative to the cell's, ReproducesTheMoments sees
                  // to it
      ++n_seen;
      for (int i = 0; i < n_monomials; ++i)
      {
        const Real units[] = {size[0][i], size[0][i], size[2][i]}; // 1-r/R relative to its maximum
        for (int k = 0; k < 3; ++k)
          worst = std::max(worst, double(std::abs(sum[k][i] - whole[k][i]) / units[k]));
      }
    }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
    EXPECT_GT(n_seen, 250);
  }

  TEST(PolarRule, TheBackendsGiveTheSameIntegrals)
  {
    RandomCases random(12);
    for (int trial = 0; trial < 100; ++trial)
    {
      const Case c = random.next(ratios[trial % std::size(ratios)]);
      const auto cone = [&](double r) { return 1 - r / c.ball.radius; };
      const auto a = weighted_moments(c.ball, view(c.cell), cone, 2);
      const auto b = weighted_moments(c.ball, view(c.cell), cone, 2, Backend::cgal);
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(a[i], b[i],
                    accuracy * least_area(c) *
                        std::pow(c.ball.radius, i < 1   ? 0
                                                : i < 3 ? 1
                                                        : 2));
    }
  }

  TEST(WeightedMoments, OfAHalfDiscAreInTheDocumentedOrder)
  {
    const auto m = weighted_moments(
        {Point<2>(1, 0), 1}, view(box(0, 2, 0, 2)), [](double r) { return 1 - r; }, 3);
    const double p = double(pi), angles[] = {p, 0, 2, p / 2, 0, p / 2, 0, 2. / 3, 0, 4. / 3};
    ASSERT_EQ(m.size(), 10u);
    for (int total = 0, i = 0; total <= 3; ++total)
      for (int b = 0; b <= total; ++b, ++i)
        EXPECT_NEAR(m[i], angles[i] / ((total + 2) * (total + 3)), 1e-15) << i;
  }

  TEST(WeightedMoments, OfHighDegreeAreStillExact)
  {
    const auto m = weighted_moments(
        {Point<2>(1, 1), .7}, view(box(0, 2, 0, 2)), [](double) { return 1.; }, 20);
    for (int b = 0; b <= 20; ++b)
    {
      const double size = angular(20 - b, b) * std::pow(.7, 22) / 22;
      EXPECT_NEAR(m[210 + b], b % 2 ? 0 : size, 1e-12 * size);
    }
  }
} // namespace plumbline::geometry
