#include "geometry/ball_cell.h"

#include "base/error.h"
#include "placements.h"

#include <gtest/gtest.h>

#include <thread>

namespace plumbline::geometry
{
  namespace
  {
    using Integrals = std::vector<Real>; // of all monomials up to a degree, as in weighted_moments

    /// Calls f(i, x^a y^b) for all of them.
    template <class F>
    void for_monomials(unsigned int degree, Real x, Real y, F f)
    {
      std::vector<Real> xs(degree + 1, 1), ys(degree + 1, 1);
      for (unsigned int k = 0; k < degree; ++k)
      {
        xs[k + 1] = xs[k] * x;
        ys[k + 1] = ys[k] * y;
      }
      for (unsigned int total = 0, i = 0; total <= degree; ++total)
        for (unsigned int b = 0; b <= total; ++b, ++i)
          f(i, xs[total - b] * ys[b]);
    }

    std::size_t n_monomials(unsigned int degree)
    {
      return (degree + 1) * (degree + 2) / 2;
    }

    /// Coordinates in which the region is of size 1.
    struct Frame
    {
      Point<2> origin;
      Real unit;
    };

    /// About the cell's first vertex or the ball's centre, whichever is smaller.
    Frame frame(const Case &c)
    {
      if (diameter(c.cell) < 2 * c.ball.radius)
        return {c.cell[0], diameter(c.cell)};
      return {c.ball.centre, c.ball.radius};
    }

    /// Moved to where the coordinates of points in the region lose no digits.
    Case moved(Case c)
    {
      const Point<2> origin = frame(c).origin;
      c.ball.centre = Point<2>(c.ball.centre - origin);
      for (auto &v : c.cell)
        v = Point<2>(v - origin);
      return c;
    }

    /// Integrals, and the largest absolute values met.
    struct Result
    {
      Integrals integrals, largest;
    };

    Result evaluate(const CutRule &rule, const Frame &frame, unsigned int degree)
    {
      Result result{Integrals(n_monomials(degree), 0), Integrals(n_monomials(degree), 0)};
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        for_monomials(degree, (rule.points[q][0] - Real(frame.origin[0])) / frame.unit,
                      (rule.points[q][1] - Real(frame.origin[1])) / frame.unit,
                      [&](unsigned int i, Real value)
                      {
                        result.integrals[i] += rule.weights[q] * value;
                        result.largest[i] = std::max(result.largest[i], std::abs(value));
                      });
      return result;
    }

    Integrals integrate(const CutRule &rule, const Frame &frame, unsigned int degree)
    {
      return evaluate(rule, frame, degree).integrals;
    }

    /// Gauss's points on [-1, 1], in long double.
    std::vector<std::pair<Real, Real>> gauss(int n)
    {
      std::vector<std::pair<Real, Real>> rule;
      for (int i = 0; i < n; ++i)
      {
        Real x = std::cos(pi * (i + .75L) / (n + .5L)), slope = 1;
        for (int step = 0; step < 9; ++step)
        {
          Real last = 1, value = x;
          for (int k = 2; k <= n; ++k)
            last = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * last) / k);
          slope = n * (x * value - last) / (x * x - 1);
          x -= value / slope;
        }
        rule.push_back({x, 2 / ((1 - x * x) * slope * slope)});
      }
      return rule;
    }

    /// The oracle: Green's theorem on the boundary's pieces, ∫ x^a y^b = ∮ (x dy - y dx) x^a y^b /
    /// (a + b + 2).
    Integrals around(const Case &c, const Frame &frame, unsigned int degree)
    {
      static const auto rule = gauss(40);
      Integrals sum(n_monomials(degree), 0);
      for (const Piece &piece : boundary(c.ball, view(c.cell)))
      {
        const auto relative = [&](const Point<2> &p, int k)
        { return (p[k] - Real(frame.origin[k])) / frame.unit; };
        const Real x0 = relative(piece.from, 0), y0 = relative(piece.from, 1);
        const Real ex = relative(piece.to, 0) - x0, ey = relative(piece.to, 1) - y0;
        const auto add = [&](Real x, Real y, Real dx, Real dy)
        {
          for_monomials(degree, x, y,
                        [&](unsigned int i, Real value) { sum[i] += (x * dy - y * dx) * value; });
        };
        if (!piece.is_arc)
        {
          for (const auto &[t, w] : rule)
            add(x0 + .5L * (1 + t) * ex, y0 + .5L * (1 + t) * ey, .5L * w * ex, .5L * w * ey);
          continue;
        }
        const Real R = c.ball.radius / frame.unit, chord = std::hypot(ex, ey);
        if (piece.angle > 1.5 || chord == 0)
        {
          const Real from = std::atan2(Real(piece.from[1]) - c.ball.centre[1],
                                       Real(piece.from[0]) - c.ball.centre[0]);
          for (int part = 0; part < 8; ++part)
            for (const auto &[t, w] : rule)
            {
              const Real width = Real(piece.angle) / 8, s = from + (part + .5L * (1 + t)) * width;
              add(relative(c.ball.centre, 0) + R * std::cos(s),
                  relative(c.ball.centre, 1) + R * std::sin(s), -.5L * w * width * R * std::sin(s),
                  .5L * w * width * R * std::cos(s));
            }
          continue;
        }
        const Real half = std::asin(chord / (2 * R)), tx = ex / chord, ty = ey / chord;
        for (const auto &[t, w] : rule)
        {
          const Real along = R * std::sin(t * half);
          const Real out = 2 * R * std::sin(.5L * half * (1 + t)) * std::sin(.5L * half * (1 - t));
          const Real da = R * std::cos(t * half) * half * w, dn = -along * half * w;
          add(x0 + .5L * ex + along * tx + out * ty, y0 + .5L * ey + along * ty - out * tx,
              da * tx + dn * ty, da * ty - dn * tx);
        }
      }
      for (unsigned int total = 0, i = 0; total <= degree; ++total)
        for (unsigned int b = 0; b <= total; ++b)
          sum[i++] *= frame.unit * frame.unit / (total + 2);
      return sum;
    }

    double difference(const Integrals &a, const Integrals &b, const Case &c)
    {
      double worst = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, double(std::abs(a[i] - b[i])) / least_area(c));
      return worst;
    }

    double error(const Case &c, unsigned int degree)
    {
      const auto found = integrate(cut_rule(c.ball, view(c.cell), degree), frame(c), degree);
      return difference(found, around(c, frame(c), degree), c);
    }

    /// Relative to the region's own area and its monomials' largest values.
    double own_error(const Case &c, unsigned int degree)
    {
      const auto found = integrate(cut_rule(c.ball, view(c.cell), degree), frame(c), degree);
      const auto exact = around(c, frame(c), degree);
      const auto many = evaluate(cut_rule(c.ball, view(c.cell), degree + 8), frame(c), degree);
      double worst = 0;
      for (std::size_t i = 0; i < exact.size(); ++i)
        worst = std::max(worst, double(std::abs(found[i] - exact[i]) / exact[0] / many.largest[i]));
      return worst;
    }

    /// A polygon as it is, and its first 3, 4 and 5 vertices.
    std::vector<Case> with_fewer_vertices(const Case &c)
    {
      std::vector<Case> cases{moved(c)};
      for (std::size_t n = 3; n < std::min<std::size_t>(6, c.cell.size()); ++n)
        cases.push_back(moved({c.ball, Polygon(c.cell.begin(), c.cell.begin() + n)}));
      return cases;
    }

    void expect_same(const CutRule &a, const CutRule &b)
    {
      EXPECT_EQ(a.points, b.points);
      EXPECT_EQ(a.weights, b.weights);
    }

    constexpr unsigned int largest = 12; // degree
  }                                      // namespace

  // ---- exactness --------------------------------------------------------------------------------

  TEST(CutRule, IntegratesTheMonomialsOfItsDegree)
  {
    RandomCases random(20);
    double worst = 0, worst_own = 0;
    int n_cut = 0;
    for (int trial = 0; trial < 14 * 13 * 8; ++trial)
      for (const Case &c : with_fewer_vertices(random.next(ratios[trial % std::size(ratios)])))
      {
        const unsigned int degree = trial % 14; // there are 13 ratios
        worst = std::max(worst, error(c, degree));
        const double covered = moments(c).area / least_area(c);
        n_cut += covered > .01 && covered < .99;
        if (covered > .01) // else the region's own rounding is relative to the cell
          worst_own = std::max(worst_own, own_error(c, degree));
      }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    RecordProperty("worst_own", std::to_string(worst_own * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
    EXPECT_LE(worst_own, accuracy);
    EXPECT_GT(n_cut, 1000);
  }

  TEST(CutRule, LatticeCellsAddUpToTheDisc)
  {
    double worst = 0;
    for (double R : {.1, .5, std::sqrt(.5), 1., 1.3, 3., 5.})
      for (const Point<2> &centre : {Point<2>(0, 0), Point<2>(.5, .5), Point<2>(.5, 0),
                                     Point<2>(.37, .21), Point<2>(.4, 1e-9)})
        for (bool halved : {false, true}) // squares, and the triangles beside their diagonals
          for (unsigned int degree = R < 2 ? 0 : largest; degree <= largest; ++degree)
          {
            Integrals sum(n_monomials(degree), 0);
            const auto add = [&](const Polygon &cell)
            {
              const auto part = integrate(cut_rule({centre, R}, cell, degree), {centre, R}, degree);
              for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += part[i];
            };
            const int n = static_cast<int>(R) + 2;
            for (int i = -n; i < n; ++i)
              for (int j = -n; j < n; ++j)
              {
                const Polygon cell = box(Point<2>(i, j), 1);
                if (halved)
                {
                  add({cell[0], cell[1], cell[2]});
                  add({cell[0], cell[2], cell[3]});
                }
                else
                  add(cell);
              }
            for (unsigned int total = 0, i = 0; total <= degree; ++total)
              for (unsigned int b = 0; b <= total; ++b, ++i)
              {
                const unsigned int a = total - b;
                const double angular = 2 * std::tgamma(.5 * (a + 1)) * std::tgamma(.5 * (b + 1)) /
                                       std::tgamma(.5 * (total + 2));
                const double exact = a % 2 || b % 2 ? 0 : angular / (total + 2);
                worst = std::max(worst, double(std::abs(sum[i] / (R * R) - exact)));
              }
          }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
  }

  TEST(CutRule, IsExactForHighDegrees)
  {
    RandomCases random(21);
    for (unsigned int degree : {14u, 15u, 20u, 30u})
      for (int trial = 0; trial < 26; ++trial)
        for (const Case &c : with_fewer_vertices(random.next(ratios[trial % std::size(ratios)])))
          EXPECT_LE(error(c, degree), accuracy);
  }

  TEST(CutRule, IsExactAtAndNearTangency)
  {
    for (double gap : {0., 1e-2, 1e-4, 1e-8, 1e-12, 1e-15})
      for (double sign : {-1., 1.})
        for (const Case &c : against_a_side(sign * gap))
          EXPECT_LE(error(moved(c), 8), accuracy) << sign * gap;
  }

  TEST(CutRule, IsExactForCirclesThroughCorners)
  {
    RandomCases random(22);
    for (double ratio : ratios)
      for (int trial = 0; trial < 10; ++trial)
      {
        const Polygon cell = random.polygon(Point<2>(.3, .2), 1);
        const double t = random.uniform(0, 7);
        const Point<2> centre = cell[0] + ratio * Point<2>(std::cos(t), std::sin(t));
        for (double off : {0., 1e-15, -1e-15, 1e-12, -1e-12})
          for (const Case &c :
               with_fewer_vertices({{centre, centre.distance(cell[0]) * (1 + off)}, cell}))
            EXPECT_LE(error(c, 7), accuracy) << off;
      }
    for (int i = -1; i < 6; ++i) // (3, 4, 5)
      for (int j = -1; j < 6; ++j)
        EXPECT_LE(error({{Point<2>(), 5}, box(Point<2>(i, j), 1)}, 8), accuracy);
  }

  TEST(CutRule, IsExactForCentresOnSidesAndCorners)
  {
    RandomCases random(23);
    for (double ratio : ratios)
      for (int trial = 0; trial < 10; ++trial)
      {
        const Polygon cell = random.polygon(Point<2>(.3, .2), 1);
        const double s = random.uniform(0, 1);
        for (const Point<2> &centre : {cell[1], cell[1] + s * (cell[2] - cell[1])})
          for (const Case &c : with_fewer_vertices({{centre, ratio}, cell}))
            EXPECT_LE(error(c, 6), accuracy);
      }
  }

  TEST(CutRule, IsExactForArcsOfAllLengths)
  {
    for (double d : {-.999999, -.99, -.7, -1e-9, 0., 1e-9, .3, .9, .999999}) // a side cuts at y = d
      for (unsigned int degree = 0; degree <= largest; ++degree)
      {
        EXPECT_LE(error({{Point<2>(), 1}, box(-2, 2, d, d + 4)}, degree), accuracy) << d;
        EXPECT_LE(error({{Point<2>(), 1}, box(-2, 2, d, d + .3)}, degree), accuracy) << d;
        EXPECT_LE(error({{Point<2>(), 1}, box(-.8, 2, d, d + 4)}, degree), accuracy) << d;
      }
  }

  TEST(CutRule, OfRepeatedAndCollinearVerticesIsExact)
  {
    const Polygon crowded = {Point<2>(0, 0),  Point<2>(0, 0), Point<2>(.5, 0), Point<2>(1, 0),
                             Point<2>(1, .3), Point<2>(1, 1), Point<2>(1, 1),  Point<2>(0, 1),
                             Point<2>(0, .5), Point<2>(0, 0)};
    for (double R : {.2, .5, .9, 1.1, 3.})
      for (const Point<2> &centre : {Point<2>(.5, .5), Point<2>(.5, 0), Point<2>(0, 0),
                                     Point<2>(1, R), Point<2>(.5, R), Point<2>(.5, 1 - R)})
        EXPECT_LE(error({{centre, R}, crowded}, 8), accuracy) << R << ", " << centre;
  }

  TEST(CutRule, TheBackendsAgree)
  {
    RandomCases random(24);
    std::vector<Case> cases = against_a_side(0);
    for (int trial = 0; trial < 130; ++trial)
      cases.push_back(random.next(ratios[trial % std::size(ratios)]));
    for (const Case &c : cases)
    {
      const auto fast = integrate(cut_rule(c.ball, view(c.cell), 8), frame(c), 8);
      const auto exact = integrate(cut_rule(c.ball, view(c.cell), 8, Backend::cgal), frame(c), 8);
      EXPECT_LE(difference(fast, exact, c), accuracy);
    }
  }

  // ---- points and weights -----------------------------------------------------------------------

  TEST(CutRule, HasPositiveWeightsThatAddUpToTheAreaAndPointsInBallAndCell)
  {
    RandomCases random(25);
    std::vector<Case> cases;
    for (double gap : {0., 1e-8, -1e-8, 1e-15, -1e-15})
      for (const Case &c : against_a_side(gap))
        cases.push_back(c);
    for (int trial = 0; trial < 3000; ++trial)
    {
      cases.push_back(random.next(ratios[trial % std::size(ratios)]));
      if (trial % 3 == 0) // slivers: a vertex within rounding of the circle
        cases.back().ball.radius = cases.back().ball.centre.distance(cases.back().cell[0]) *
                                   (1 + random.uniform(-1, 1) * 4 * eps);
    }
    for (const Case &c : cases)
      for (unsigned int degree : {1u, 8u})
      {
        const CutRule rule = cut_rule(c.ball, view(c.cell), degree);
        Real sum = 0;
        for (double weight : rule.weights)
        {
          ASSERT_GT(weight, 0);
          sum += weight;
        }
        EXPECT_NEAR(double(sum), moments(c).area, accuracy * least_area(c));
        double far = c.ball.centre.norm() + c.ball.radius;
        for (const auto &v : c.cell)
          far = std::max(far, v.norm());
        const double slack = 8 * eps * far;
        for (const auto &point : rule.points)
        {
          EXPECT_LE(point.distance(c.ball.centre), c.ball.radius + slack);
          for (std::size_t i = 0; i < c.cell.size(); ++i)
          {
            const auto e = c.cell[(i + 1) % c.cell.size()] - c.cell[i], x = point - c.cell[i];
            EXPECT_GE(e[0] * x[1] - e[1] * x[0], -slack * e.norm());
          }
        }
      }
  }

  TEST(CutRule, IsEmptyWhereNothingIsCut)
  {
    for (const Ball &ball :
         {Ball{Point<2>(1, 3), 1}, Ball{Point<2>(5, 6), 5}, Ball{Point<2>(9, 9), 1}})
      for (Backend backend : {Backend::fast, Backend::cgal})
      {
        const CutRule rule = cut_rule(ball, box(0, 2, 0, 2), 4, backend);
        EXPECT_TRUE(rule.points.empty());
        EXPECT_TRUE(rule.weights.empty());
      }
  }

  TEST(CutRule, TakesFewPoints)
  {
    const auto n_points = [](const Ball &ball, const Polygon &cell, unsigned int degree)
    { return cut_rule(ball, cell, degree).points.size(); };
    const Ball large{Point<2>(), 9}, small{Point<2>(.4, .4), .1}, cuts{Point<2>(), 1.1};
    const Polygon triangle{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)},
        square = box(0, 1, 0, 1);
    EXPECT_EQ(n_points(large, triangle, 1), 1u);
    EXPECT_EQ(n_points(large, triangle, 2), 3u);
    EXPECT_EQ(n_points(large, triangle, 8), 16u);
    EXPECT_EQ(n_points(large, square, 1), 1u);
    EXPECT_EQ(n_points(large, square, 3), 4u);
    EXPECT_EQ(n_points(large, square, 8), 25u);
    EXPECT_EQ(n_points(small, square, 8), 27u);
    EXPECT_LE(n_points({Point<2>(-.1, -.1), .8}, triangle, 8), 50u); // one corner inside
    EXPECT_LE(n_points({Point<2>(.5, -.5), .8}, triangle, 8), 55u);  // two
    EXPECT_LE(n_points(cuts, square, 8), 71u);                       // three
    EXPECT_LE(n_points(cuts, square, 2), 13u);
  }

  // ---- cells and memory used again --------------------------------------------------------------

  TEST(ConvexCell, GivesWhatItsVerticesGive)
  {
    RandomCases random(26);
    CutRule cut, polar; // used again
    for (int trial = 0; trial < 500; ++trial)
    {
      const Case c = random.next(ratios[trial % std::size(ratios)]);
      const ConvexCell cell(view(c.cell));
      const Moments a = intersect(c.ball, cell), b = intersect(c.ball, view(c.cell));
      EXPECT_EQ(a.area, b.area);
      EXPECT_EQ(a.centroid, b.centroid);
      EXPECT_EQ(a.second, b.second);
      cut_rule(c.ball, cell, trial % 9, cut);
      expect_same(cut, cut_rule(c.ball, view(c.cell), trial % 9));
      polar_rule(c.ball, cell, 5, 3, polar);
      expect_same(polar, polar_rule(c.ball, view(c.cell), 5, 3));
    }
  }

  TEST(ConvexCell, HasTheMomentsAndTheBoxOfTheWholeCell)
  {
    const Polygon triangle{Point<2>(1, 1), Point<2>(4, 1), Point<2>(1, 3)};
    const ConvexCell cell(triangle);
    EXPECT_NEAR(cell.moments().area, 3, 1e-14);
    EXPECT_LE(cell.moments().centroid.distance(Point<2>(2, 5. / 3)), 1e-14);
    EXPECT_NEAR(cell.moments().second[0], 1.5, 1e-14);    // b³ h / 36
    EXPECT_NEAR(cell.moments().second[1], -.5, 1e-14);    // -b² h² / 72
    EXPECT_NEAR(cell.moments().second[2], 2. / 3, 1e-14); // b h³ / 36
    EXPECT_EQ(cell.box().lower, Point<2>(1, 1));
    EXPECT_EQ(cell.box().upper, Point<2>(4, 3));
  }

  TEST(CutRule, AllocatesNothingForARuleThatIsLargeEnough)
  {
    const Polygon cell = box(0, 1, 0, 1);
    CutRule rule = cut_rule({Point<2>(.5, .5), .6}, cell, 8); // four arcs
    const auto *points = rule.points.data();
    const auto *weights = rule.weights.data();
    for (double R : {.1, .5, .7, 1.1, 3.})
      cut_rule({Point<2>(.1, .2), R}, cell, 8, rule);
    EXPECT_EQ(rule.points.data(), points);
    EXPECT_EQ(rule.weights.data(), weights);
  }

  TEST(CutRule, MayBeCalledFromManyThreads)
  {
    const Polygon cell = box(0, 1, 0, 1);
    std::vector<CutRule> rules(4);
    std::vector<std::thread> threads;
    for (CutRule &rule : rules)
      threads.emplace_back([&] { cut_rule({Point<2>(), 1.1}, cell, 17, rule); });
    for (auto &thread : threads)
      thread.join();
    for (const CutRule &rule : rules)
      expect_same(rule, cut_rule({Point<2>(), 1.1}, cell, 17));
  }

  TEST(CutRule, RefusesABallOrACellThatIsNone)
  {
    const Polygon cell = box(0, 1, 0, 1), clockwise(cell.rbegin(), cell.rend());
    CutRule rule;
    EXPECT_THROW(cut_rule({Point<2>(), 0}, cell, 2), InputError);
    EXPECT_THROW(cut_rule({Point<2>(), -1}, ConvexCell(cell), 2, rule), InputError);
    EXPECT_THROW(cut_rule({Point<2>(), 1}, clockwise, 2), InputError);
    EXPECT_THROW(ConvexCell{clockwise}, InputError);
    EXPECT_THROW(polar_rule({Point<2>(), 1}, cell, 0, 1, rule), InputError);
  }
} // namespace plumbline::geometry
