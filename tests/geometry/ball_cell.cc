#include "geometry/ball_cell.h"

#include "base/error.h"
#include "placements.h"

#include <gtest/gtest.h>

namespace plumbline::geometry
{
  TEST(BallCell, LatticeCellsAddUpToTheDisc)
  {
    RandomCases random(1);
    double worst = 0;
    for (double R : ratios)
      for (int placement = 0; placement < (R < 100 ? 20 : 1); ++placement)
      {
        const bool tie = placement == 0; // circle through lattice points, touching lattice lines
        const Ball ball{
            tie ? Point<2>() : Point<2>(random.uniform(-.5, .5), random.uniform(-.5, .5)), R};
        const int n = static_cast<int>(R) + 2;
        std::array<Sum, 6> sum{};
        int n_cut = 0;
        for (int i = -n; i < n; ++i)
          for (int j = -n; j < n; ++j)
          {
            const Moments m = moments({ball, box(Point<2>(i, j), 1)});
            const auto six = about(m, ball.centre);
            for (int k = 0; k < 6; ++k)
              sum[k] += six[k];
            n_cut += m.area > 0 && m.area < 1;
          }
        const Real a = pi * R * R, exact[] = {a, 0, 0, a * R * R / 4, 0, a * R * R / 4};
        const double cell = std::min(1., double(a));
        for (int k = 0; k < 6; ++k)
        {
          const double unit = cell * std::pow(R, k == 0 ? 0 : k < 3 ? 1 : 2);
          worst = std::max(worst, double(std::abs(sum[k] - exact[k])) / unit / (n_cut + 1));
        }
      }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
  }

  TEST(BallCell, HalvesOfAPolygonAddUpToIt)
  {
    RandomCases random(2);
    double worst = 0;
    int n_cut = 0;
    for (int trial = 0; trial < 20000; ++trial)
    {
      const Case c = random.next(ratios[trial % std::size(ratios)]);
      const std::size_t k = 2 + static_cast<std::size_t>(random.uniform(0, c.cell.size() - 3));
      const Case one{c.ball, Polygon(c.cell.begin(), c.cell.begin() + k + 1)};
      Case two{c.ball, Polygon(c.cell.begin() + k, c.cell.end())};
      two.cell.push_back(c.cell[0]);
      auto sum = about(moments(one), origin(c));
      const auto other = about(moments(two), origin(c)), whole = about(moments(c), origin(c));
      for (int i = 0; i < 6; ++i)
        sum[i] += other[i];
      n_cut += whole[0] > 0 && whole[0] < .999 * least_area(c);
      worst = std::max(worst, difference(sum, whole, c));
    }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, accuracy);
    EXPECT_GT(n_cut, 10000);
  }

  TEST(BallCell, BackendsAgreeAtRandom)
  {
    RandomCases random(3);
    std::vector<Case> cases;
    for (int trial = 0; trial < 390; ++trial)
      cases.push_back(random.next(ratios[trial % std::size(ratios)]));
    EXPECT_LE(worst_of(cases), accuracy);
  }

  TEST(BallCell, BackendsAgreeAtTangency)
  {
    EXPECT_LE(worst_of(against_a_side(0)), accuracy);
  }

  TEST(BallCell, BackendsAgreeNearTangency)
  {
    for (double gap : {1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15, 2.3e-16})
      for (double sign : {-1., 1.})
        EXPECT_LE(worst_of(against_a_side(sign * gap)), accuracy) << sign * gap;
  }

  TEST(BallCell, BackendsAgreeOnPythagoreanTies)
  {
    std::vector<Case> cases;
    for (double h : {1., .1, 1. / 3}) // exact ties, and ties spoilt by rounding
      for (double shift : {0., .5})
        for (int i = -1; i < 6; ++i)
          for (int j = -1; j < 6; ++j)
            cases.push_back(
                {{Point<2>(), 5 * h}, box(Point<2>((i - shift) * h, (j - shift) * h), h)});
    EXPECT_LE(worst_of(cases), accuracy);
  }

  TEST(BallCell, BackendsAgreeForCirclesThroughCorners)
  {
    EXPECT_LE(worst_of(through_corners(4)), accuracy);
  }

  TEST(BallCell, BackendsAgreeForCentresOnSidesAndCorners)
  {
    EXPECT_LE(worst_of(about_corners_and_sides(5)), accuracy);
  }

  TEST(BallCell, BackendsAgreeForTinyBallsOnSidesOfLargeCells)
  {
    RandomCases random(6);
    std::vector<Case> cases;
    for (double R : {1e-2, 1e-5, 1e-9})
      for (int trial = 0; trial < 20; ++trial)
      {
        const Polygon cell = random.polygon(Point<2>(.3, .2), 1);
        const double s = trial % 4 ? random.uniform(0, 1) : 0, off = random.uniform(-1.1, 1.1);
        cases.push_back({{cell[1] + s * (cell[2] - cell[1]) + Point<2>(0, off * R), R}, cell});
      }
    EXPECT_LE(worst_of(cases), accuracy);
  }

  TEST(BallCell, ClosedFormsHoldInDegeneratePositions)
  {
    const double h = 2, p = double(pi);
    struct
    {
      const char *position;
      Case c;
      double area;
      Point<2> centroid;
      double xx, yy;
    } const table[] = {
        {"inscribed", {{Point<2>(1, 1), 1}, box(0, h, 0, h)}, p, Point<2>(1, 1), p / 4, p / 4},
        {"circumscribed",
         {{Point<2>(1, 1), std::sqrt(2.)}, box(0, h, 0, h)},
         4,
         Point<2>(1, 1),
         4 / 3.,
         4 / 3.},
        {"touching from outside", {{Point<2>(1, 3), 1}, box(0, h, 0, h)}, 0, Point<2>(0, 0), 0, 0},
        {"touching a corner", {{Point<2>(5, 6), 5}, box(0, h, 0, h)}, 0, Point<2>(0, 0), 0, 0},
        {"apart", {{Point<2>(9, 9), 1}, box(0, h, 0, h)}, 0, Point<2>(0, 0), 0, 0},
        {"centre on an edge",
         {{Point<2>(1, 0), 1}, box(0, h, 0, h)},
         p / 2,
         Point<2>(1, 4 / (3 * p)),
         p / 8,
         p / 8 - 8 / (9 * p)},
        {"centre on a vertex",
         {{Point<2>(0, 0), 1}, box(0, h, 0, h)},
         p / 4,
         Point<2>(4 / (3 * p), 4 / (3 * p)),
         p / 16 - 4 / (9 * p),
         p / 16 - 4 / (9 * p)},
        {"tiny ball",
         {{Point<2>(.5, 1.25), 1e-9}, box(0, h, 0, h)},
         p * 1e-18,
         Point<2>(.5, 1.25),
         p / 4 * 1e-36,
         p / 4 * 1e-36},
        {"huge ball",
         {{Point<2>(1e8, 0), 1e9}, box(0, h, 0, h)},
         4,
         Point<2>(1, 1),
         4 / 3.,
         4 / 3.}};
    for (const auto &row : table)
      for (Backend backend : {Backend::fast, Backend::cgal})
      {
        SCOPED_TRACE(row.position);
        const Moments m = moments(row.c, backend);
        EXPECT_NEAR(m.area, row.area, accuracy * least_area(row.c));
        EXPECT_LE(m.centroid.distance(row.centroid), accuracy * least_length(row.c) + 4 * eps);
        const double unit = least_area(row.c) * least_length(row.c) * least_length(row.c);
        EXPECT_NEAR(m.second[0], row.xx, accuracy * unit);
        EXPECT_NEAR(m.second[2], row.yy, accuracy * unit);
      }
  }

  TEST(BallCell, CapsNearTangencyHaveTheAreaOfACircularSegment)
  {
    double worst = 0;
    for (double R : ratios)
      for (double gap : {-1e-2, -1e-6, -1e-8, -1e-11, -1e-15, 0., 1e-15, 1e-8})
      {
        const double d = R * (1 + gap);
        if (std::sqrt(std::max(0., R * R - d * d)) > .5)
          continue; // wider than the cell
        const Real half =
            2 * std::asin(std::sqrt(std::max(Real(0), (Real(R) - d) / (2 * Real(R)))));
        const Real cap = Real(R) * R * (half - std::sin(2 * half) / 2);
        const Case c{{Point<2>(), R}, box(-.5, .5, d, d + 1)};
        worst = std::max(worst, double(std::abs(moments(c).area - cap)) / least_area(c));
        if (R < .5) // and the rest of the disc, below the side
        {
          const Case rest{{Point<2>(), R}, box(-.5, .5, d - 1, d)};
          const double error = double(std::abs(moments(rest).area + cap - pi * R * R));
          worst = std::max(worst, error / least_area(rest));
        }
      }
    EXPECT_LE(worst, accuracy);
  }

  TEST(BallCell, AreaAndCentroidStayWithinBounds)
  {
    RandomCases random(7);
    for (int trial = 0; trial < 20000; ++trial)
    {
      Case c = random.next(ratios[trial % std::size(ratios)]);
      if (trial % 2) // slivers: the nearest vertex within rounding of the circle
      {
        c.ball.radius = c.ball.centre.distance(c.cell[0]) * (1 + random.uniform(-1, 1) * 4 * eps);
        for (const auto &v : c.cell)
          c.ball.radius = std::min(c.ball.radius, c.ball.centre.distance(v) * (1 + 2 * eps));
      }
      const Moments m = moments(c);
      ASSERT_GE(m.area, 0);
      ASSERT_LE(m.area, least_area(c) * (1 + 8 * eps));
      if (m.area > 0)
      {
        const double rounding = 2 * eps * (c.ball.radius + c.ball.centre.norm());
        ASSERT_LE(m.centroid.distance(c.ball.centre), c.ball.radius + rounding);
      }
      ASSERT_GE(m.second[0], 0);
      ASSERT_GE(m.second[2], 0);
    }
  }

  TEST(BallCell, MomentsDoNotDependOnTheFirstVertexOrARightAngleTurn)
  {
    RandomCases random(8);
    for (int trial = 0; trial < 2000; ++trial)
    {
      const Case c = random.next(ratios[trial % std::size(ratios)]);
      const auto expected = about(moments(c), origin(c));
      Case shifted = c, turned = c;
      std::rotate(shifted.cell.begin(), shifted.cell.begin() + 1, shifted.cell.end());
      EXPECT_LE(difference(about(moments(shifted), origin(c)), expected, c), accuracy);
      const auto turn = [](const Point<2> &p) { return Point<2>(-p[1], p[0]); };
      turned.ball.centre = turn(c.ball.centre);
      for (auto &v : turned.cell)
        v = turn(v);
      const auto six = about(moments(turned), turn(origin(c)));
      EXPECT_LE(difference({six[0], six[2], -six[1], six[5], -six[4], six[3]}, expected, c),
                accuracy);
    }
  }

  TEST(BallCell, RepeatedAndCollinearVerticesChangeNothing)
  {
    const Polygon plain = box(0, 1, 0, 1);
    const Polygon crowded = crowded_square();
    for (double R : {.2, .5, .9, 1.1, 3.})
      for (const Point<2> &centre :
           {Point<2>(.5, .5), Point<2>(.5, 0), Point<2>(0, 0), Point<2>(1, R)})
        for (Backend backend : {Backend::fast, Backend::cgal})
        {
          const Case c{{centre, R}, plain};
          EXPECT_LE(difference(about(moments({c.ball, crowded}, backend), origin(c)),
                               about(moments(c), origin(c)), c),
                    accuracy);
          double sum = 0;
          for (double weight : polar_rule(c.ball, view(crowded), 16, 10, backend).weights)
            sum += weight;
          EXPECT_NEAR(sum, moments(c).area, accuracy * least_area(c));
        }
  }

  // ---- boundary ---------------------------------------------------------------------------------

  TEST(BallCellBoundary, IsAClosedChainWhoseAreaIsTheIntersections)
  {
    RandomCases random(9);
    for (int trial = 0; trial < 300; ++trial)
    {
      Case c = random.next(ratios[trial % 8]);
      c.ball.radius *=
          1.01; // some were inscribed: there one corner more or less is a matter of rounding
      const auto pieces = boundary(c.ball, view(c.cell));
      EXPECT_EQ(pieces.size(), boundary(c.ball, view(c.cell), Backend::cgal).size());
      const double R = c.ball.radius;
      double sum = 0;
      for (std::size_t i = 0; i < pieces.size(); ++i)
      {
        const Piece &p = pieces[i];
        EXPECT_EQ(p.to, pieces[(i + 1) % pieces.size()].from);
        const auto a = p.from - c.cell[0], b = p.to - c.cell[0];
        sum += .5 * (a[0] * b[1] - a[1] * b[0]) + .5 * R * R * (p.angle - std::sin(p.angle));
        EXPECT_EQ(p.is_arc, p.angle > 0);
        if (p.is_arc)
        {
          EXPECT_NEAR(p.from.distance(c.ball.centre), R, 1e-14 * (R + 1));
        }
      }
      EXPECT_NEAR(sum, moments(c).area, 1e-12 * least_area(c));
    }
  }

  TEST(BallCellBoundary, OfABallInsideIsOneFullArcAndOfABallOutsideIsEmpty)
  {
    for (Backend backend : {Backend::fast, Backend::cgal})
    {
      const Polygon cell = box(0, 1, 0, 1);
      for (double R : {.1, .5}) // free, and inscribed
      {
        const auto pieces = boundary({Point<2>(.5, .5), R}, view(cell), backend);
        ASSERT_EQ(pieces.size(), 1u);
        EXPECT_TRUE(pieces[0].is_arc);
        EXPECT_EQ(pieces[0].from, pieces[0].to);
        EXPECT_DOUBLE_EQ(pieces[0].angle, double(2 * pi));
      }
      EXPECT_TRUE(boundary({Point<2>(.5, 3), 1}, view(cell), backend).empty());
      EXPECT_TRUE(boundary({Point<2>(.5, 2), 1}, view(cell), backend).empty()); // touching
    }
  }

  TEST(BallCellErrors, FindTheNonConvexCornerWhereverTheListStarts)
  {
    Polygon dart = {Point<2>(0, 0), Point<2>(1, .5), Point<2>(2, 0), Point<2>(1, 2)};
    Polygon hat = {Point<2>(0, 0), Point<2>(2, 0), Point<2>(2, 2), Point<2>(1, 1.9),
                   Point<2>(0, 2)};
    Polygon diamond = {Point<2>(1, 0), Point<2>(0, 1), Point<2>(-1, 0), Point<2>(0, -1)};
    for (int start = 0; start < 5; ++start)
    {
      EXPECT_THROW(moments({{Point<2>(), 1}, dart}), InputError);
      EXPECT_THROW(moments({{Point<2>(), 1}, hat}), InputError);
      EXPECT_NO_THROW(moments({{Point<2>(), 1}, diamond}));
      for (Polygon *cell : {&dart, &hat, &diamond})
        std::rotate(cell->begin(), cell->begin() + 1, cell->end());
    }
  }

  TEST(BallCellErrors, NameTheValueAndTheRemedy)
  {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    const Polygon good = box(0, 1, 0, 1);
    const Polygon star = {Point<2>(1, 0), Point<2>(-.809, .588), Point<2>(.309, -.951),
                          Point<2>(.309, .951), Point<2>(-.809, -.588)};
    const auto with = [&](const Point<2> &v) { return Polygon{good[0], good[1], v, good[3]}; };
    struct
    {
      Case c;
      const char *value, *remedy;
    } const table[] = {
        {{{Point<2>(), -.5}, good}, "radius -0.5 at (0, 0)", "must be a finite length > 0"},
        {{{Point<2>(), 0}, good}, "radius 0 ", "must be a finite length > 0"},
        {{{Point<2>(), nan}, good}, "radius nan", "must be a finite length > 0"},
        {{{Point<2>(), inf}, good}, "radius inf", "must be a finite length > 0"},
        {{{Point<2>(nan, 0), 1}, good}, "at (nan, 0)", "the centre finite"},
        {{{Point<2>(), 1}, {}}, "has 0 of them", "at least 3"},
        {{{Point<2>(), 1}, {good[0], good[1]}}, "(0, 0) (1, 0) has 2 of them", "at least 3"},
        {{{Point<2>(), 1}, with(Point<2>(nan, 1))}, "(nan, 1)", "give finite coordinates"},
        {{{Point<2>(), 1}, with(Point<2>(1, inf))}, "(1, inf)", "give finite coordinates"},
        {{{Point<2>(), 1}, {good[3], good[2], good[1], good[0]}},
         "clockwise, area -1",
         "reverse the order"},
        {{{Point<2>(), 1}, {good[0], good[1], Point<2>(3, 0)}}, "degenerate", "span an area"},
        {{{Point<2>(), 1}, {good[0], good[0], good[0]}}, "degenerate", "span an area"},
        {{{Point<2>(), 1}, with(Point<2>(.25, .25))},
         "(0.25, 0.25) (0, 1) is not convex",
         "split it"},
        {{{Point<2>(), 1}, {good[0], good[1], Point<2>(2, 0), good[1], good[2]}},
         "not convex",
         "split it"},
        {{{Point<2>(), 1}, star}, "not convex", "split it"}};
    for (const auto &row : table)
      for (Backend backend : {Backend::fast, Backend::cgal})
      {
        const auto fails = [&](const auto &call)
        {
          try
          {
            call();
            ADD_FAILURE() << "nothing was thrown: " << row.value;
          }
          catch (const InputError &error)
          {
            EXPECT_NE(std::string(error.what()).find(row.value), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(row.remedy), std::string::npos)
                << error.what();
          }
        };
        fails([&] { moments(row.c, backend); });
        fails([&] { boundary(row.c.ball, view(row.c.cell), backend); });
        fails([&] { polar_rule(row.c.ball, view(row.c.cell), 4, 4, backend); });
      }
    EXPECT_THROW(polar_rule({Point<2>(), 1}, view(good), 0, 4), InputError);
    EXPECT_THROW(polar_rule({Point<2>(), 1}, view(good), 4, 0), InputError);
  }
} // namespace plumbline::geometry
