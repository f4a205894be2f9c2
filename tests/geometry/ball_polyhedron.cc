#include "geometry/ball_polyhedron.h"

#include "ball_box_slices.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Vector = Tensor<1, 3>;

    constexpr double radii[] = {.1, .3, .5, .7, 1, 1.5, 2, 3, 5, 10, 33.3, 100, 1000}; // R/h
    constexpr double accuracy = 1e-14, of_moments = 1e-13; // as the header claims

    double ball(double radius)
    {
      return 4 * M_PI / 3 * radius * radius * radius;
    }

    const ConvexPolyhedron &unit_cube()
    {
      static const ConvexPolyhedron cube = ConvexPolyhedron::box({0, 0, 0}, {1, 1, 1});
      return cube;
    }

    /// Of boxes, degree 1 and 2 go two ways. Differences of both to the slices, relative to
    /// min(|ball|, |cell|) and its diameter.
    std::array<double, 2> errors(const Point<3> &centre, double radius, const Point<3> &upper)
    {
      const ConvexPolyhedron box = ConvexPolyhedron::box({0, 0, 0}, upper);
      const double whole = std::min(ball(radius), box.moments().volume),
                   length = std::min(2 * radius, upper.norm());
      std::array<double, 2> worst{};
      for (unsigned int axis = 0; axis < 3; ++axis) // each once the axis of the slices
      {
        std::array<Quad, 3> from{}, to{};
        for (unsigned int k = 0; k < 3; ++k)
        {
          const unsigned int of = (axis + 1 + k) % 3;
          from[k] = -Quad(centre[of]);
          to[k] = Quad(upper[of]) - Quad(centre[of]);
        }
        const auto [volume, first] = ball_box(from, to, radius);
        const Quad about_corner = first + volume * Quad(centre[axis]);
        for (const unsigned int degree : {1u, 2u})
        {
          const SolidMoments found = intersect({centre, radius}, box, degree);
          worst[0] =
              std::max(worst[0], std::abs(static_cast<double>(found.volume - volume)) / whole);
          worst[1] =
              std::max(worst[1], std::abs(static_cast<double>(
                                     Quad(found.volume) * found.centroid[axis] - about_corner)) /
                                     whole / length);
        }
      }
      return worst;
    }

    /// Second moments about a common point.
    dealii::SymmetricTensor<2, 3> about(const SolidMoments &m, const Point<3> &x)
    {
      const Vector d = m.centroid - x;
      return m.second + m.volume * symmetrize(outer_product(d, d));
    }

    class Placements
    {
    public:
      explicit Placements(unsigned int seed) : random_(seed) {}
      double uniform(double from, double to)
      {
        return std::uniform_real_distribution<double>(from, to)(random_);
      }
      Vector direction()
      {
        Vector d;
        do
          d = Vector({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        while (d.norm() > 1 || d.norm() < .1);
        return d / d.norm();
      }
      /// A centre whose sphere passes through the cell.
      Point<3> centre(double radius)
      {
        return Point<3>(uniform(0, 1), uniform(0, 1), uniform(0, 1)) + radius * direction();
      }

    private:
      std::mt19937 random_;
    };
  } // namespace

  TEST(BallPolyhedron, AgreesWithSlicesInQuadruplePrecision)
  {
    Placements random(1);
    std::array<double, 2> worst{};
    for (const double radius : radii)
      for (int trial = 0; trial < 8; ++trial)
      {
        const Point<3> upper = trial % 2 == 0
                                   ? Point<3>(1, 1, 1)
                                   : Point<3>(1, random.uniform(.3, 1), random.uniform(.3, 1));
        const auto error = errors(random.centre(radius), radius, upper);
        for (unsigned int k = 0; k < 2; ++k)
          worst[k] = std::max(worst[k], error[k]);
      }
    RecordProperty("worst", std::to_string(worst[0] * 1e15) + "e-15");
    EXPECT_LE(worst[0], accuracy);
    EXPECT_LE(worst[1], of_moments);
  }

  // spheres through corners, tangent to faces and to edges, centres on corners, edges and faces
  TEST(BallPolyhedron, AgreesWithSlicesInDegeneratePlacements)
  {
    std::array<double, 2> worst{};
    const double places[] = {-2, -1, -.5, 0, .5, 1};
    const double roots[] = {
        .5,           1, 1.5, 2, M_SQRT1_2, M_SQRT2, std::sqrt(.75), std::sqrt(3.), std::sqrt(1.25),
        std::sqrt(5.)};
    int n = 0;
    for (const double x : places)
      for (const double y : places)
        for (const double z : places)
          if (x <= y && y <= z && ++n > 0)
          {
            const double radius = roots[n % std::size(roots)];
            for (const double ulps : {-1., 0., 1.})
            {
              const auto error =
                  errors({x, y, z}, radius * (1 + ulps * std::numeric_limits<double>::epsilon()),
                         {1, 1, 1});
              for (unsigned int k = 0; k < 2; ++k)
                worst[k] = std::max(worst[k], error[k]);
            }
          }
    EXPECT_EQ(n, 56);
    EXPECT_LE(worst[0], accuracy);
    EXPECT_LE(worst[1], of_moments);
  }

  // all of 3:4:5, so that coordinates are exact where the sphere meets vertices, edges and faces
  TEST(BallPolyhedron, AgreesWithSlicesWhereBoxesAreTangent)
  {
    Placements random(3);
    const double places[] = {-1, -.75, -.625, -.5, 0, .375, .5, .75, 1, 1.25, 1.5};
    const double sizes[] = {.375, .5, .75, 1};
    const auto one_of = [&](const auto &values)
    { return values[static_cast<std::size_t>(random.uniform(0, std::size(values)))]; };
    std::array<double, 2> worst{};
    for (const double radius : {.125, .375, .5, .625, .75, 1., 1.25, 1.5, 2.5})
      for (int trial = 0; trial < 16; ++trial)
      {
        const Point<3> centre(one_of(places), one_of(places), one_of(places));
        const auto error = errors(centre, radius, {1, one_of(sizes), one_of(sizes)});
        for (unsigned int k = 0; k < 2; ++k)
          worst[k] = std::max(worst[k], error[k]);
      }
    EXPECT_LE(worst[0], accuracy);
    EXPECT_LE(worst[1], of_moments);
  }

  // at random, and on half-integer coordinates, where spheres touch faces, edges and vertices
  TEST(BallPolyhedron, BoxesAreTheSameAsAnyPolyhedra)
  {
    Placements random(4);
    std::array<double, 2> worst{};
    for (const double radius : radii)
      for (int trial = 0; trial < 8000; ++trial)
      {
        Point<3> centre = random.centre(radius);
        if (trial % 5 == 4)
          for (unsigned int k = 0; k < 3; ++k)
            centre[k] = std::round(2 * centre[k]) / 2;
        const Vector lower = trial % 3 == 0 ? Vector() : Vector({-.5, .25, 4}); // exact
        centre += lower;
        const ConvexPolyhedron box = ConvexPolyhedron::box(
            Point<3>(lower),
            (trial % 2 == 0 ? Point<3>(1, 1, 1)
                            : Point<3>(1, random.uniform(.3, 1), random.uniform(.3, 1))) +
                lower);
        const SolidMoments fast = intersect({centre, radius}, box, 1),
                           general = intersect({centre, radius}, box, 2);
        const double whole = std::min(ball(radius), box.moments().volume),
                     length = std::min(2 * radius, box.upper().norm());
        const Vector difference =
            fast.volume * Vector(fast.centroid) - general.volume * Vector(general.centroid);
        worst[0] = std::max(worst[0], std::abs(fast.volume - general.volume) / whole);
        worst[1] = std::max(worst[1], difference.norm() / whole / length);
      }
    RecordProperty("worst", std::to_string(worst[0] * 1e15) + "e-15");
    EXPECT_LE(worst[0], accuracy);
    EXPECT_LE(worst[1], of_moments);
  }

  TEST(BallPolyhedron, CellsOfALatticeAddUpToTheBall)
  {
    for (const double radius : {.4, 1., 1.7, 3., 6.})
    {
      const Point<3> centre = radius == 3 ? Point<3>() : Point<3>(.1, .27, .03);
      const int n = static_cast<int>(radius) + 2;
      double volume = 0;
      Vector first;
      dealii::SymmetricTensor<2, 3> second;
      for (int i = -n; i < n; ++i)
        for (int j = -n; j < n; ++j)
          for (int k = -n; k < n; ++k)
          {
            const Point<3> lower(i, j, k);
            const SolidMoments m = intersect(
                {centre, radius}, ConvexPolyhedron::box(lower, lower + Vector({1., 1., 1.})));
            volume += m.volume;
            first += m.volume * (m.centroid - centre);
            second += about(m, centre);
          }
      const double exact = ball(radius);
      EXPECT_NEAR(volume / exact, 1, of_moments);
      EXPECT_LE(first.norm() / (exact * radius), of_moments);
      second -= exact * radius * radius / 5 * dealii::unit_symmetric_tensor<3>();
      EXPECT_LE(second.norm() / (exact * radius * radius), of_moments);
    }
  }

  // six tetrahedra around the diagonal, whose faces are oblique to the axes
  TEST(BallPolyhedron, TetrahedraAddUpToTheCube)
  {
    Placements random(2);
    double worst = 0, of_second = 0;
    for (const double radius : radii)
      for (int trial = 0; trial < 200; ++trial)
      {
        const Point<3> centre = random.centre(radius), upper(1, 1, 1);
        const SolidMoments cube = intersect({centre, radius}, unit_cube());
        double volume = 0;
        dealii::SymmetricTensor<2, 3> second;
        std::array<unsigned int, 3> order{0, 1, 2};
        do
        {
          Point<3> a, b;
          a[order[0]] = 1;
          b[order[0]] = b[order[1]] = 1;
          const SolidMoments part =
              intersect({centre, radius}, ConvexPolyhedron::tetrahedron({Point<3>(), a, b, upper}));
          volume += part.volume;
          second += about(part, cube.centroid);
        } while (std::next_permutation(order.begin(), order.end()));
        const double whole = std::min(1., ball(radius)), length = std::min(1., radius);
        worst = std::max(worst, std::abs(volume - cube.volume) / whole);
        of_second = std::max(of_second, (second - cube.second).norm() / (whole * length * length));
      }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    EXPECT_LE(worst, 5 * accuracy); // of six
    EXPECT_LE(of_second, 5 * of_moments);
  }

  TEST(BallPolyhedron, KnowsTheWholeCellAndTheWholeBall)
  {
    const SolidMoments cube = intersect({{.5, .5, .5}, .87}, unit_cube());
    EXPECT_DOUBLE_EQ(cube.volume, 1);
    EXPECT_DOUBLE_EQ((cube.second[{0, 0}]), 1. / 12);
    EXPECT_NEAR((cube.second[{0, 1}]), 0, 1e-16);
    const SolidMoments inside = intersect({{.4, .5, .6}, .4}, unit_cube());
    EXPECT_NEAR(inside.volume, ball(.4), 1e-16);
    EXPECT_NEAR(inside.centroid.distance({.4, .5, .6}), 0, 1e-15);
    EXPECT_NEAR((inside.second[{2, 2}]), ball(.4) * .4 * .4 / 5, 1e-17);
    const SolidMoments apart = intersect({{3, .5, 2}, .5}, unit_cube());
    EXPECT_EQ(apart.volume, 0);
    EXPECT_NEAR(apart.centroid.distance({1, .5, 1}), 0, 1e-15);
  }

  // the same after a shift and in another unit
  TEST(BallPolyhedron, IsInvariant)
  {
    const Point<3> centre(1.3, .4, -.2);
    const double radius = 1.1;
    const SolidMoments plain = intersect({centre, radius}, unit_cube());
    ASSERT_GT(plain.volume, 0);
    for (const double unit : {1e-9, 1e6})
    {
      const Vector shift({7, -3, 5});
      const auto moved = [&](const Point<3> &x) { return Point<3>(unit * (x + shift)); };
      const SolidMoments other =
          intersect({moved(centre), unit * radius},
                    ConvexPolyhedron::box(moved({0, 0, 0}), moved({1, 1, 1})));
      EXPECT_NEAR(other.volume / (unit * unit * unit), plain.volume, 1e-13);
      EXPECT_NEAR((other.centroid / unit - shift).distance(plain.centroid), 0, 1e-13);
      EXPECT_NEAR((other.second[{0, 0}]) / std::pow(unit, 5), (plain.second[{0, 0}]), 1e-13);
    }
  }

  TEST(BallPolyhedron, RefusesWhatIsNoBall)
  {
    for (const double radius : {0., -1., std::nan("")})
      EXPECT_THROW(intersect({{0, 0, 0}, radius}, unit_cube()), InputError);
  }
} // namespace plumbline::geometry
