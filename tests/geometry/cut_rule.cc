#include "geometry/ball_cell.h"

#include "base/error.h"
#include "monomials.h"

#include <gtest/gtest.h>

#include <thread>

namespace plumbline::geometry
{
  namespace
  {
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

    double worst_error(const std::vector<Case> &cases, unsigned int degree)
    {
      double worst = 0;
      for (const Case &c : cases)
        worst = std::max(worst, error(c, degree));
      return worst;
    }

    /// Relative to the region's own area and its monomials' largest values.
    double own_error(const Case &c, unsigned int degree)
    {
      const auto found = integrate(cut_rule(c.ball, view(c.cell), degree), frame(c), degree);
      const auto exact = around(c, frame(c), degree);
      const auto largest =
          largest_values(cut_rule(c.ball, view(c.cell), degree + 8), frame(c), degree);
      double worst = 0;
      for (std::size_t i = 0; i < exact.size(); ++i)
        worst = std::max(worst, double(std::abs(found[i] - exact[i]) / exact[0] / largest[i]));
      return worst;
    }

    /// Each polygon as it is, and its first 3, 4 and 5 vertices; all of them moved.
    std::vector<Case> with_fewer_vertices(const std::vector<Case> &all)
    {
      std::vector<Case> cases;
      for (const Case &c : all)
      {
        cases.push_back(moved(c));
        for (std::size_t n = 3; n < std::min<std::size_t>(6, c.cell.size()); ++n)
          cases.push_back(moved({c.ball, Polygon(c.cell.begin(), c.cell.begin() + n)}));
      }
      return cases;
    }

    /// Sides cut the unit circle at y = d, and one at x = -.8.
    std::vector<Case> arcs_of_all_lengths()
    {
      std::vector<Case> cases;
      for (double d : {-.999999, -.99, -.7, -1e-9, 0., 1e-9, .3, .9, .999999})
        for (const Polygon &cell :
             {box(-2, 2, d, d + 4), box(-2, 2, d, d + .3), box(-.8, 2, d, d + 4)})
          cases.push_back({{Point<2>(), 1}, cell});
      return cases;
    }

    /// Circles of radius 5 through corners (3, 4) of the lattice.
    std::vector<Case> pythagorean_ties()
    {
      std::vector<Case> cases;
      for (int i = -1; i < 6; ++i)
        for (int j = -1; j < 6; ++j)
          cases.push_back({{Point<2>(), 5}, box(Point<2>(i, j), 1)});
      return cases;
    }

    std::vector<Case> on_a_crowded_square()
    {
      std::vector<Case> cases;
      for (double R : {.2, .5, .9, 1.1, 3.})
        for (const Point<2> &centre : {Point<2>(.5, .5), Point<2>(.5, 0), Point<2>(0, 0),
                                       Point<2>(1, R), Point<2>(.5, R), Point<2>(.5, 1 - R)})
          cases.push_back({{centre, R}, crowded_square()});
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
      for (const Case &c : with_fewer_vertices({random.next(ratios[trial % std::size(ratios)])}))
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
        EXPECT_LE(worst_error(with_fewer_vertices({random.next(ratios[trial % std::size(ratios)])}),
                              degree),
                  accuracy);
  }

  TEST(CutRule, IsExactInDegeneratePositions)
  {
    std::vector<Case> tangent;
    for (double gap : {0., 1e-2, 1e-4, 1e-8, 1e-12, 1e-15})
      for (double sign : {-1., 1.})
        for (const Case &c : against_a_side(sign * gap))
          tangent.push_back(moved(c));
    struct
    {
      const char *position;
      std::vector<Case> cases;
      unsigned int degree;
    } const table[] = {
        {"at and near tangency", tangent, 8},
        {"circles through corners", with_fewer_vertices(through_corners(22)), 7},
        {"circles through corners of the lattice", pythagorean_ties(), 8},
        {"centres on sides and corners", with_fewer_vertices(about_corners_and_sides(23)), 6},
        {"repeated and collinear vertices", on_a_crowded_square(), 8}};
    for (const auto &row : table)
      EXPECT_LE(worst_error(row.cases, row.degree), accuracy) << row.position;
  }

  TEST(CutRule, IsExactForArcsOfAllLengths)
  {
    for (unsigned int degree = 0; degree <= largest; ++degree)
      EXPECT_LE(worst_error(arcs_of_all_lengths(), degree), accuracy) << degree;
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
