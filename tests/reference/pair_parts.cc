// The parts of exact integrals over pairs of faces: numbers of two parts, whether faces see
// each other, edges made parallel to all digits, polygons in planes, and many pairs at a time
// against one at a time with all digits, also where vertices are in line. And that entries do not
// depend on the number of threads.
#include "physics/gauss.h"
#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/exact_pairs.h"
#include "reference/tetrahedra/pair_form.h"
#include "reference/tetrahedra/two_part_number.h"

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using Kind = FacePotential::Kind;
  using Triangle = PairFace::Vertices;
  using Two = TwoPartNumber<double>;
  using Quad = TwoPartNumber<long double>;

  double uniform(std::mt19937 &random)
  {
    return 2 * (random() / 4294967296.) - 1;
  }

  Triangle random_triangle(std::mt19937 &random, const Point<3> &centre, double size)
  {
    Triangle result;
    for (Point<3> &x : result)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = centre[d] + size * uniform(random);
    return result;
  }

  FormFace<Quad> quad_face(const Triangle &x, const std::array<unsigned int, 3> &names)
  {
    FormFace<Quad> face;
    for (unsigned int k = 0; k < 3; ++k)
      face.x[k] = {Quad(x[k][0]), Quad(x[k][1]), Quad(x[k][2])};
    face.names = names;
    return face;
  }

  /// The face with its sides renumbered.
  NumberedFace numbered(const PairFace &face, unsigned int number)
  {
    NumberedFace result;
    result.face = &face;
    result.number = number;
    for (unsigned int k = 0; k < 3; ++k)
      result.edges[k] = 3 * number + k;
    return result;
  }

  /// A face, and others of all sorts: far and near, with shared vertices and sides, parallel or
  /// nearly so, and itself.
  std::vector<PairFace> some_faces(unsigned int n)
  {
    std::mt19937 random(3);
    const Triangle x = {Point<3>(0, 0, 0), Point<3>(.3, .02, .1), Point<3>(.1, .3, 0)};
    std::vector<PairFace> faces = {PairFace(x, {0, 1, 2})};
    for (unsigned int k = 0; k < n; ++k)
    {
      const Point<3> centre(.9 * uniform(random), .9 * uniform(random), .9 * uniform(random));
      Triangle y = random_triangle(random, centre, .2);
      std::array<unsigned int, 3> names = {3 * k + 3, 3 * k + 4, 3 * k + 5};
      const unsigned int sort = k % 5, n_shared = sort < 2 ? sort + 1 : 0;
      for (unsigned int j = 0; j < n_shared; ++j)
      {
        y[j] = x[j];
        names[j] = j;
      }
      if (sort == 2)
        for (unsigned int j = 0; j < 3; ++j)
          y[j] = Point<3>(x[j] + centre + (k % 2) * 1e-3 * Point<3>(0, uniform(random), 0));
      faces.emplace_back(y, names);
    }
    return faces;
  }

  bool has(const SpaceFace &face, unsigned int dof)
  {
    return std::any_of(face.jumps.begin(), face.jumps.end(),
                       [dof](const SpaceFace::Jump &jump) { return jump.dof == dof; });
  }

  /// Those on which an unknown has a jump [horizons].
  std::vector<PairFace> faces_at(const TetrahedralMesh &mesh, const std::vector<SpaceFace> &all,
                                 unsigned int dof, double horizon)
  {
    std::vector<PairFace> faces;
    for (const SpaceFace &face : all)
      if (has(face, dof))
      {
        Triangle x;
        for (unsigned int k = 0; k < 3; ++k)
          x[k] = Point<3>((mesh.vertices[face.vertices[k]] - mesh.vertices.front()) / horizon);
        faces.emplace_back(x, face.vertices);
      }
    return faces;
  }

  std::vector<double> jumps_of(const std::vector<SpaceFace> &all, unsigned int dof)
  {
    std::vector<double> jumps;
    for (const SpaceFace &face : all)
      for (const SpaceFace::Jump &jump : face.jumps)
        if (jump.dof == dof)
          jumps.push_back(jump.value);
    return jumps;
  }

  /// Whether a vertex of one is in line with an edge of the other.
  bool have_line(const PairFace &f, const PairFace &g)
  {
    for (const auto &[one, other] : {std::pair(&f, &g), std::pair(&g, &f)})
      for (const Point<3> &x : one->vertices())
        for (unsigned int k = 0; k < 3; ++k)
        {
          const Point<3> &start = other->vertices()[k], &end = other->vertices()[(k + 1) % 3];
          if (cross_product_3d(end - start, x - start).norm() == 0)
            return true;
        }
    return false;
  }
} // namespace

TEST(TwoPartNumbers, keep_twice_the_digits)
{
  const double tiny = 1e-25;
  EXPECT_EQ(static_cast<double>(Two(1) + Two(tiny) - Two(1)), tiny);
  const double small = std::ldexp(1., -45);
  EXPECT_EQ(static_cast<double>((Two(1) + Two(small)) * (Two(1) - Two(small)) - Two(1)),
            -small * small);
  std::mt19937 random(1);
  const double unit = std::ldexp(1., -Two::digits);
  for (unsigned int n = 0; n < 1000; ++n)
  {
    const Two a = Two(2 + uniform(random)) + Two(1e-17 * uniform(random)),
              b = Two(2 + uniform(random)) + Two(1e-17 * uniform(random));
    const double size = static_cast<double>(a * b);
    EXPECT_LE(std::abs(static_cast<double>(a / b * b - a)), unit * size);
    EXPECT_LE(std::abs(static_cast<double>(sqrt(a) * sqrt(a) - a)), unit * size);
    EXPECT_LE(std::abs(static_cast<double>((a + b) * (a - b) - (a * a - b * b))), 4 * unit * size);
    EXPECT_LE(std::abs(static_cast<double>(log(a * b) - log(a) - log(b))), unit * size);
    EXPECT_EQ(a < b, static_cast<double>(a - b) < 0);
  }
}

TEST(TwoPartNumbers, know_logarithms_and_angles)
{
  const double pi = 3.141592653589793116, rest_of_pi = 1.2246467991473531772e-16;
  EXPECT_NEAR(static_cast<double>(Two(4) * atan2(Two(1), Two(1)) - Two(pi)), rest_of_pi, 1e-30);
  const double log_of_2 = .6931471805599453094, rest = 2.3190468138462995584e-17;
  EXPECT_NEAR(static_cast<double>(log(Two(2)) - Two(log_of_2)), rest, 1e-31);
  EXPECT_EQ(static_cast<double>(abs(Two(-1) - Two(1e-20)) - Two(1)), 1e-20);
}

TEST(FacesOutOfReach, are_those_whose_projections_are_a_horizon_apart)
{
  std::mt19937 random(2);
  unsigned int n_apart = 0, n_near = 0;
  for (unsigned int n = 0; n < 2000; ++n)
  {
    const Triangle x = random_triangle(random, {}, .3),
                   y = random_triangle(random, {1.3 + .3 * uniform(random), .2, .1}, .3);
    const bool is_apart = are_out_of_reach(PairFace(x, {0, 1, 2}), PairFace(y, {3, 4, 5}));
    EXPECT_EQ(is_apart, are_out_of_reach(PairFace(y, {3, 4, 5}), PairFace(x, {0, 1, 2})));
    double least = 10;
    for (unsigned int j = 0; j < 64; ++j) // points of both
    {
      const double a = (j % 4) / 3., b = (1 - a) * (j / 16) / 3., c = (j / 4 % 4) / 3.;
      const Point<3> p(x[0] + a * (x[1] - x[0]) + b * (x[2] - x[0])),
          q(y[0] + c * (y[1] - y[0]) + (1 - c) * b * (y[2] - y[0]));
      least = std::min(least, p.distance(q));
    }
    ++(is_apart ? n_apart : n_near);
    if (is_apart)
    {
      EXPECT_GE(least, 1);
    }
  }
  EXPECT_GT(n_apart, 100u);
  EXPECT_GT(n_near, 100u);
  const Triangle x = {Point<3>(0, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
  for (const double gap : {.999, 1.001})
  {
    Triangle y = x;
    for (Point<3> &p : y)
      p[0] += gap;
    EXPECT_EQ(are_out_of_reach(PairFace(x, {0, 1, 2}), PairFace(y, {3, 4, 5})), gap > 1);
  }
}

TEST(ParallelEdges, become_so_to_all_digits)
{
  const Triangle x = {Point<3>(.1, .2, .3), Point<3>(.4, .5, .7), Point<3>(.2, .9, .1)};
  Triangle y = {Point<3>(.7, .1, .3), Point<3>(.2, .3, .8), Point<3>(0, 0, 0)};
  y[2] = Point<3>(y[1] + (x[1] - x[0]) / 3.); // rounded
  for (const bool is_shared : {false, true})
  {
    const FormFace<Quad> f = quad_face(x, {0, 1, 2});
    const FormFace<Quad> before = quad_face(y, {3, 4, is_shared ? 2u : 5u});
    FormFace<Quad> g = before;
    ASSERT_TRUE(align(f, g));
    EXPECT_LT(static_cast<double>(f.edge(0).cross(g.edge(1)).norm()), 1e-36);
    EXPECT_GT(static_cast<double>(f.edge(0).cross(before.edge(1)).norm()), 1e-20);
    // one vertex moves by a rounding; it is not a shared one
    double change = 0;
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto moved = static_cast<double>((g.x[k] - before.x[k]).norm());
      EXPECT_TRUE(moved == 0 || k == (is_shared ? 1 : 2));
      change += moved;
    }
    EXPECT_GT(change, 0);
    EXPECT_LT(change, 1e-15);
  }
  y[2] = Point<3>(y[2] + Point<3>(0, 1e-12, 0));
  FormFace<Quad> g = quad_face(y, {3, 4, 5});
  EXPECT_FALSE(align(quad_face(x, {0, 1, 2}), g));
}

namespace
{
  struct NumberedFaces
  {
    std::vector<NumberedFace> all;
    std::vector<const NumberedFace *> others; ///< the same ones

    explicit NumberedFaces(const std::vector<PairFace> &faces)
    {
      for (std::size_t k = 0; k < faces.size(); ++k)
        all.push_back(numbered(faces[k], static_cast<unsigned int>(k)));
      for (const NumberedFace &face : all)
        others.push_back(&face);
    }
    NumberedFaces(const NumberedFaces &) = delete;
    NumberedFaces &operator=(const NumberedFaces &) = delete;
  };
} // namespace

TEST(ManyPairs, are_those_with_all_digits_up_to_their_bounds)
{
  const std::vector<PairFace> faces = some_faces(30);
  const NumberedFaces numbers(faces);
  const auto &[all, others] = numbers;
  constexpr double tolerance = 1e-17;
  for (const std::string type : {"constant", "1/r"})
    for (const Kind kind : {Kind::biharmonic, Kind::harmonic})
    {
      const auto kernel =
          physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, 1, 1);
      const ExactPairs exact(kernel, kind, tolerance);
      ExactPairs::Shared shared;
      shared.start({others.front()}, others);
      std::vector<ExactPairs::Integral> integrals;
      exact(all.front(), others, shared, integrals);
      std::array<unsigned int, 4> n_level{};
      for (std::size_t k = 0; k < faces.size(); ++k)
      {
        EXPECT_LE(integrals[k].error, tolerance);
        // the bound is that of sums; values are rounded, and small ones are of faces about a
        // horizon apart, whose round-off is another
        const double value = exact.precise(faces.front(), faces[k]);
        EXPECT_NEAR(integrals[k].value, value,
                    integrals[k].error + 4e-16 * std::abs(value) + 1e-3 * tolerance)
            << type << " " << k;
        ++n_level[integrals[k].level];
      }
      EXPECT_GT(n_level[0], 5u);
      EXPECT_GT(n_level[1], 3u);
    }
}

TEST(FacePotentials, of_series_are_integrals_of_the_profile)
{
  const auto &gauss = physics::gauss(64);
  for (const auto &[type, width] :
       {std::pair<std::string, double>("gaussian", .5), {"gaussian", .05}, {"exponential", .3}})
  {
    const auto profile = physics::kernel_type(type).make({{}, 0, width});
    const physics::Kernel<3> kernel(physics::Structure::scalar, profile, 1, 1);
    EXPECT_EQ(FacePotential::refuse(kernel), "");
    EXPECT_NE(FacePotential::note(kernel).find("Chebyshev series"), std::string::npos);
    const double error = ProfileSeries(profile).error;
    EXPECT_LT(error, width > .1 ? 1e-14 : 1e-12) << type << " " << width;
    for (const Kind kind : {Kind::harmonic, Kind::biharmonic})
      for (const double r : {.01, .1, .4, .9})
      {
        const auto integral = [&](const std::function<double(double)> &f, double from, double to)
        {
          double sum = 0;
          constexpr unsigned int n_parts = 8;
          for (unsigned int part = 0; part < n_parts; ++part)
            for (unsigned int q = 0; q < gauss.size(); ++q)
              sum += (to - from) / n_parts * gauss.weight(q) *
                     f(from + (to - from) * (part + gauss.point(q)[0]) / n_parts);
          return sum;
        };
        const auto potential = [&](double s)
        {
          return integral(
                     [&](double t) {
                       return t * profile(t) *
                              (kind == Kind::harmonic ? t - s : std::pow(t - s, 3) / 6);
                     },
                     s, 1) /
                 s;
        };
        // what the error makes of t - r <= 1, and round-off
        const double square = r * r, weight = 1,
                     allowed = (error * profile.moment(2) + 1e-15 * .01 * potential(.01)) / r;
        const FacePotential f(kernel, kind);
        EXPECT_NEAR(f.sum(&square, &weight, 1), potential(r), allowed);
        const double rays =
            integral([&](double s) { return std::pow(s, 3) * potential(s * r); }, 0, 1);
        EXPECT_NEAR(f.sum_of_rays(&square, &weight, 1), rays, allowed);
      }
  }
}

TEST(FacePotentials, of_high_powers_are_those_of_a_series)
{
  const auto kernel = [](int highest)
  {
    const physics::RadialProfile::Powers powers = {{1, 0}, {.01, highest}};
    return physics::Kernel<3>::with_diffusion(powers, 1, 1);
  };
  EXPECT_EQ(FacePotential::note(kernel(50)), "");
  EXPECT_NE(FacePotential::note(kernel(60)), "");
  EXPECT_EQ(FacePotential::refuse(kernel(60)), "");
  EXPECT_NE(FacePotential::refuse(kernel(2000)).find("give fewer coefficients"), std::string::npos);
}

// The same kernels by their powers, and by one table of t ρ.
TEST(ManyPairs, of_a_series_are_those_of_powers_and_those_with_all_digits)
{
  const std::vector<PairFace> faces = some_faces(25);
  const NumberedFaces numbers(faces);
  const auto &[all, others] = numbers;
  using physics::RadialProfile;
  const auto one = RadialProfile::smooth([](double) { return 1; }, true);
  const auto quartic = RadialProfile::smooth([](double t) { return std::pow(1 - t, 4); }, false);
  struct Case
  {
    std::string name;
    Kind kind = Kind::biharmonic;
    RadialProfile series, powers; ///< powers: may be empty
  };
  const std::vector<Case> cases = {
      {"constant", Kind::harmonic, one, {{1, 0}}},
      {"1/r", Kind::biharmonic, one.over_t(), {{1, -1}}},
      {"quartic", Kind::biharmonic, quartic, {{1, 0}, {-4, 1}, {6, 2}, {-4, 3}, {1, 4}}},
      {"gaussian", Kind::biharmonic, physics::kernel_type("gaussian").make({{}, 0, .4}), {}},
      {"narrow", Kind::harmonic, physics::kernel_type("gaussian").make({{}, 0, .1}), {}},
      {"exponential", Kind::harmonic, physics::kernel_type("exponential").make({{}, 0, .3}), {}}};
  for (const auto &[name, kind, series, powers] : cases)
  {
    const physics::Kernel<3> kernel(physics::Structure::scalar, series, 1, 1);
    const double tolerance = 3e-17 * series.moment(2);
    const ExactPairs exact(kernel, kind, tolerance);
    ExactPairs::Shared shared;
    shared.start({others.front()}, others);
    std::vector<ExactPairs::Integral> integrals;
    exact(all.front(), others, shared, integrals);
    double largest = 0;
    for (const ExactPairs::Integral &integral : integrals)
      largest = std::max(largest, std::abs(integral.value));
    for (std::size_t k = 0; k < faces.size(); ++k)
    {
      const double value = integrals[k].value;
      EXPECT_LE(integrals[k].error, tolerance);
      if (k % 3 == 0)
      {
        EXPECT_NEAR(value, exact.precise(faces.front(), faces[k]),
                    integrals[k].error + 4e-16 * std::abs(value) + 1e-2 * tolerance)
            << name << " " << k;
      }
      if (powers.is_empty())
        continue;
      const ExactPairs by_powers(physics::Kernel<3>(physics::Structure::scalar, powers, 1, 1), kind,
                                 tolerance);
      EXPECT_NEAR(value, by_powers(faces.front(), faces[k]).value, tolerance + 1e-15 * largest)
          << name << " " << k;
    }
  }
}

TEST(PlaneIntegrals, see_no_foot_that_is_on_the_line_of_a_side_but_beyond_it)
{
  const auto kernel =
      physics::Kernel<3>::with_diffusion(physics::kernel_type("constant").profile, 1, 1);
  std::vector<PotentialPart<double>> parts;
  for (const PotentialTerms &part : FacePotential::terms(kernel))
    parts.emplace_back(part, 3);
  using Corner = Vector<double>;
  const auto integral = [&](double start, double distance, double off)
  {
    const std::array<Corner, 3> corners = {
        {{start, off, distance}, {start + .3, off, distance}, {start + .17, .23 + off, distance}}};
    return PlaneIntegral<double>(corners.data(), 3, {0, 0, 1}).compact(parts).value;
  };
  for (const double start : {.2, .37, -.6, -.9})
    for (const double distance : {1e-17, 1e-20, 1e-9})
      EXPECT_NEAR(integral(start, distance, 0), integral(start, 0, 0),
                  1e-13 * std::abs(integral(start, 0, 0)))
          << start << " " << distance;
  // on the side, or at its ends
  constexpr double unit = 1e-17;
  for (const double start : {-.4, -.3 - unit, -.3, -.3 + unit, -.1, -unit, 0., unit, .1, .3, .5})
    for (const double off : {-1e-13, 1e-13})
      EXPECT_NEAR(integral(start, .3, 0), integral(start, .3, off), 1e-11) << start << " " << off;
}

/// Edges of surfaces, which stay, are in line with vertices of others. The entry's pairs are all
/// taken alone, and those in line with all digits, too.
TEST(ManyPairs, have_all_digits_where_vertices_are_in_line)
{
  const auto moved = geometry::with_moved_vertices(
      geometry::six_per_cube({{{{Point<3>(), Point<3>(6, 6, 6)}}, {}}, 1}, 1), .2, 1);
  const TetrahedralSpace space(std::make_shared<const TetrahedralMesh>(moved), true);
  constexpr double horizon = 2, tolerance = 1e-15;
  const auto kernel =
      physics::Kernel<3>::with_diffusion(physics::kernel_type("constant").profile, horizon, 1);
  constexpr unsigned int row = 0, column = 318; // more than a horizon apart
  const std::vector<SpaceFace> all = make_faces(space);
  const std::vector<PairFace> first = faces_at(moved, all, row, horizon),
                              second = faces_at(moved, all, column, horizon);
  std::vector<NumberedFace> numbers;
  for (const std::vector<PairFace> *faces : {&first, &second})
    for (const PairFace &face : *faces)
      numbers.push_back(numbered(face, static_cast<unsigned int>(numbers.size())));
  std::vector<const NumberedFace *> others;
  for (std::size_t k = first.size(); k < numbers.size(); ++k)
    others.push_back(&numbers[k]);
  const std::vector<double> jumps = jumps_of(all, row), jumps_of_others = jumps_of(all, column);
  const ExactPairs exact(kernel, Kind::biharmonic, tolerance);
  double expected = 0;
  unsigned int n_in_line = 0;
  for (std::size_t j = 0; j < first.size(); ++j)
  {
    ExactPairs::Shared shared;
    shared.start({&numbers[j]}, others);
    std::vector<ExactPairs::Integral> integrals;
    exact(numbers[j], others, shared, integrals);
    for (std::size_t k = 0; k < second.size(); ++k)
    {
      double value = exact(first[j], second[k]).value;
      expected -= jumps[j] * jumps_of_others[k] * value;
      EXPECT_NEAR(integrals[k].value, value, tolerance) << j << " " << k;
      if (are_out_of_reach(first[j], second[k]) || !have_line(first[j], second[k]))
        continue;
      value = exact.precise(first[j], second[k]);
      EXPECT_NEAR(integrals[k].value, value, tolerance) << j << " " << k;
      ++n_in_line;
    }
  }
  EXPECT_GT(n_in_line, 20u);
  expected *= kernel.constant() * std::pow(horizon, 8);
  const algebra::CsrMatrix matrix = assemble_by_faces(space, kernel, 1, FaceRule::exact());
  double entry = 0, largest = 0;
  for (std::size_t k = 0; k < matrix.value.size(); ++k)
  {
    largest = std::max(largest, std::abs(matrix.value[k]));
    if (matrix.column[k] == column)
      entry = matrix.value[k];
  }
  EXPECT_GT(std::abs(expected), 1e-6 * largest);
  EXPECT_NEAR(entry, expected, 1e-13 * largest);
}

/// Nearby faces of a mesh, whose values in double of regular functions cancel.
TEST(ManyPairs, with_more_digits_take_values_in_double_that_are_exact_enough)
{
  constexpr double third = 1. / 3, tolerance = 2e-16;
  const PairFace f({Point<3>(5 * third, third, 2 * third),
                    Point<3>(1.6314785301685331, .61231181273857749, .65287743015214794),
                    Point<3>(1.9629499397861461, .61376346827795103, .94311522323017316)},
                   {0, 1, 2}),
      g({Point<3>(1.0333525749854742, .68320399777342866, 1.0651814783302447),
         Point<3>(1.3547514299551644, .69975542041162653, .97313270646457861),
         Point<3>(1.3670384466958541, .99041215870529409, 1.38417891052862)},
        {3, 4, 5});
  const std::array<NumberedFace, 2> both = {numbered(f, 0), numbered(g, 1)};
  const auto kernel = physics::Kernel<3>::with_diffusion(physics::kernel_type("1/r").profile, 1, 1);
  const ExactPairs exact(kernel, Kind::biharmonic, tolerance);
  ExactPairs::Shared shared;
  shared.start({&both[0]}, {&both[1]});
  std::vector<ExactPairs::Integral> integrals;
  exact(both[0], {&both[1]}, shared, integrals);
  EXPECT_EQ(integrals.front().level, 1u);
  EXPECT_NEAR(integrals.front().value, exact.precise(f, g),
              integrals.front().error + 1e-3 * tolerance);
}

TEST(ManyPairs, are_the_same_on_any_number_of_threads)
{
  const auto moved = geometry::with_moved_vertices(
      geometry::six_per_cube({{{{Point<3>(), Point<3>(2, 2, 2)}}, {}}, 1}, 1), .2, 1);
  const TetrahedralSpace space(std::make_shared<const TetrahedralMesh>(moved), true);
  const auto kernel =
      physics::Kernel<3>::with_diffusion(physics::kernel_type("constant").profile, .6, 1);
  const unsigned int before = dealii::MultithreadInfo::n_threads();
  std::vector<std::vector<double>> values;
  std::vector<FaceRuleUse> uses;
  for (const unsigned int n_threads : {1, 2, 5})
  {
    dealii::MultithreadInfo::set_thread_limit(n_threads);
    uses.emplace_back();
    values.push_back(
        assemble_by_faces(space, kernel, space.n_free(), FaceRule::exact(), &uses.back()).value);
  }
  dealii::MultithreadInfo::set_thread_limit(before);
  ASSERT_FALSE(values.front().empty());
  for (std::size_t k = 1; k < values.size(); ++k)
  {
    EXPECT_EQ(values[k], values.front());
    EXPECT_EQ(uses[k].n_pairs, uses.front().n_pairs);
    EXPECT_EQ(uses[k].error, uses.front().error);
  }
}
