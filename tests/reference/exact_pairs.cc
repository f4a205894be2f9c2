// Exact integrals over pairs of faces: against products of Gauss rules, against quadrature with the
// coordinates of Sauter & Schwab, by additivity; and the entries of matrices made of them: against
// exact ones of cubes, against masses, and by additivity under refinement.
#include "reference/tetrahedra/exact_pairs.h"

#include "physics/gauss.h"
#include "reference/lattice/solid_stencil.h"
#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/repeated_rows.h"
#include "tests/reference/cube_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using Kind = FacePotential::Kind;
  using Triangle = PairFace::Vertices;

  constexpr double any_error = 1e300; // as a tolerance: in double only

  physics::Kernel<3> kernel_of(const std::string &type, double horizon = 1)
  {
    return physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, horizon, 1);
  }

  Triangle random_triangle(std::mt19937 &random, const Point<3> &centre, double size)
  {
    Triangle result;
    for (Point<3> &x : result)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = centre[d] + size * (2 * (random() / 4294967296.) - 1);
    return result;
  }

  /// ∬ f by products of Gauss rules on collapsed squares.
  double by_products(const FacePotential &potential, const Triangle &x, const Triangle &y)
  {
    const auto &gauss = physics::gauss(16);
    const auto at = [&](const Triangle &t, unsigned int j, unsigned int k)
    {
      const double a = gauss.point(j)[0], b = a * gauss.point(k)[0];
      return Point<3>(t[0] + (a - b) * (t[1] - t[0]) + b * (t[2] - t[0]));
    };
    const auto weight = [&](unsigned int j, unsigned int k)
    { return gauss.weight(j) * gauss.weight(k) * gauss.point(j)[0]; };
    const auto twice_area = [](const Triangle &t)
    { return cross_product_3d(t[1] - t[0], t[2] - t[0]).norm(); };
    double sum = 0;
    std::array<double, 16> squares, weights;
    for (unsigned int j = 0; j < 16; ++j)
      for (unsigned int k = 0; k < 16; ++k)
        for (unsigned int l = 0; l < 16; ++l)
        {
          for (unsigned int m = 0; m < 16; ++m)
          {
            squares[m] = at(x, j, k).distance_square(at(y, l, m));
            weights[m] = weight(l, m);
          }
          sum += weight(j, k) * potential.sum(squares.data(), weights.data(), 16);
        }
    return sum * twice_area(x) * twice_area(y);
  }

  void expect_products(const Triangle &x, const Triangle &y, const std::string &what)
  {
    for (const std::string type : {"constant", "linear-decay", "1/r"})
      for (const Kind kind : {Kind::biharmonic, Kind::harmonic})
      {
        const auto kernel = kernel_of(type);
        const FacePotential potential(kernel, kind);
        const ExactPairs exact(kernel, kind, any_error);
        const double expected = by_products(potential, x, y);
        EXPECT_NEAR(exact(PairFace(x, {0, 1, 2}), PairFace(y, {3, 4, 5})).value, expected,
                    1e-17 + 1e-11 * std::abs(expected))
            << type << " " << what;
      }
  }

  /// Four of half the size.
  std::vector<Triangle> quarters(const Triangle &t)
  {
    const Point<3> a(.5 * (t[0] + t[1])), b(.5 * (t[1] + t[2])), c(.5 * (t[2] + t[0]));
    return {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {b, c, a}};
  }

  /// Six tetrahedra per cube of side 1, two cubes a side, all vertices moved at random.
  TetrahedralMesh moved_mesh(int n_layers, double move)
  {
    TetrahedralMesh mesh =
        geometry::six_per_cube({{{{Point<3>(), Point<3>(2, 2, 2)}}, {}}, 1}, n_layers);
    std::mt19937 random(7);
    for (Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += move * (2 * (random() / 4294967296.) - 1);
    return mesh;
  }

  TetrahedralSpace space_on(TetrahedralMesh mesh, bool is_continuous)
  {
    return {std::make_shared<const TetrahedralMesh>(std::move(mesh)), is_continuous};
  }

  /// Eight tetrahedra for each, by the middles of edges.
  TetrahedralMesh refined(const TetrahedralMesh &coarse)
  {
    TetrahedralMesh fine;
    fine.vertices = coarse.vertices;
    std::map<std::array<unsigned int, 2>, unsigned int> middles;
    for (std::size_t cell = 0; cell < coarse.cells.size(); ++cell)
    {
      const auto &v = coarse.cells[cell];
      const auto middle = [&](unsigned int i, unsigned int j)
      {
        const auto [found, is_new] =
            middles.try_emplace({std::min(v[i], v[j]), std::max(v[i], v[j])}, fine.vertices.size());
        if (is_new)
          fine.vertices.emplace_back(.5 * (coarse.vertices[v[i]] + coarse.vertices[v[j]]));
        return found->second;
      };
      const unsigned int a = middle(0, 1), b = middle(0, 2), c = middle(0, 3), d = middle(1, 2),
                         e = middle(1, 3), f = middle(2, 3);
      for (const std::array<unsigned int, 4> &part : {std::array{v[0], a, b, c},
                                                      {a, v[1], d, e},
                                                      {b, d, v[2], f},
                                                      {c, e, f, v[3]},
                                                      {a, f, b, c},
                                                      {a, f, c, e},
                                                      {a, f, e, d},
                                                      {a, f, d, b}})
      {
        fine.cells.push_back(part);
        fine.is_inside.push_back(coarse.is_inside[cell]);
        if (determinant(fine, fine.cells.size() - 1) < 0)
          std::swap(fine.cells.back()[0], fine.cells.back()[1]);
      }
    }
    return fine;
  }

  /// That of a cell at a place.
  unsigned int corner_of(const TetrahedralSpace &space, std::size_t cell, const Point<3> &place)
  {
    const auto &vertices = space.mesh().cells[cell];
    for (unsigned int k = 0; k < 3; ++k)
      if (space.mesh().vertices[vertices[k]].distance(place) < 1e-12)
        return k;
    return 3;
  }

  std::map<unsigned int, double> row_of(const algebra::CsrMatrix &matrix, std::size_t row)
  {
    std::map<unsigned int, double> result;
    for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
      result[matrix.column[k]] = matrix.value[k];
    return result;
  }
} // namespace

TEST(ExactPairs, are_integrals_over_both_faces)
{
  std::mt19937 random(5);
  for (unsigned int n = 0; n < 3; ++n)
    expect_products(random_triangle(random, {}, .12), random_triangle(random, {.1, .5, 0}, .12),
                    "in general position");
}

TEST(ExactPairs, of_parallel_edges_and_faces_are_limits)
{
  const Triangle flat = {Point<3>(0, 0, 0), Point<3>(.2, 0, 0), Point<3>(.05, .2, 0)};
  expect_products(flat, {Point<3>(.3, .3, .2), Point<3>(.45, .35, .2), Point<3>(.3, .5, .2)},
                  "parallel faces");
  expect_products(flat, {Point<3>(0, 0, .35), Point<3>(.2, 0, .35), Point<3>(.05, .2, .35)},
                  "faces above each other, with parallel edges");
  expect_products(flat, {Point<3>(.4, .3, 0), Point<3>(.55, .35, 0), Point<3>(.4, .5, 0)},
                  "faces in one plane");
  expect_products(flat, {Point<3>(.5, 0, 0), Point<3>(.7, 0, 0), Point<3>(.55, .2, 0)},
                  "faces in one plane, with parallel edges");
  expect_products(flat, {Point<3>(.3, .3, .1), Point<3>(.4, .2, .1), Point<3>(.35, .4, .3)},
                  "an edge parallel to a face");
  expect_products(flat, {Point<3>(.4, .3, .1), Point<3>(.55, .3, .1), Point<3>(.45, .35, .27)},
                  "parallel edges of faces that are not");
  expect_products(flat, {Point<3>(.4, -.2, 0), Point<3>(.7, -.2, 0), Point<3>(.5, 0, .2)},
                  "an edge in the plane of a face");
}

TEST(ExactPairs, of_faces_that_touch_are_those_of_quadrature)
{
  const Triangle x = {Point<3>(0, 0, 0), Point<3>(.3, .02, .1), Point<3>(.1, .3, 0)},
                 y = {Point<3>(-.02, -.1, .3), Point<3>(.25, -.1, .2), Point<3>(.2, .2, .35)};
  for (const std::string type : {"constant", "1/r"})
    for (const Kind kind : {Kind::biharmonic, Kind::harmonic})
      for (unsigned int n_shared = 1; n_shared <= 3; ++n_shared)
      {
        Triangle z = y;
        std::array<unsigned int, 3> names = {3, 4, 5};
        for (unsigned int k = 0; k < n_shared; ++k)
        {
          z[k] = x[k];
          names[k] = k;
        }
        const auto kernel = kernel_of(type);
        const FacePotential potential(kernel, kind);
        const double expected =
            FacePairs(potential, 12)(PairFace(x, {0, 1, 2}), PairFace(z, names));
        EXPECT_NEAR(
            ExactPairs(kernel, kind, any_error)(PairFace(x, {0, 1, 2}), PairFace(z, names)).value,
            expected, 1e-12 * expected)
            << type << " " << n_shared;
      }
}

TEST(ExactPairs, across_the_horizon_add_up_over_parts_of_faces)
{
  std::mt19937 random(9);
  for (const std::string type : {"constant", "1/r"})
    for (const Kind kind : {Kind::biharmonic, Kind::harmonic})
      for (const double distance : {0., .7, 1.})
      {
        // those far away take compact functions, others regular ones, and their parts the same or
        // not
        const Triangle x = random_triangle(random, {}, .25),
                       y = random_triangle(random, {distance, .1, distance == 0 ? .7 : 0}, .4);
        const ExactPairs exact(kernel_of(type), kind, any_error);
        double sum = 0;
        for (const Triangle &s : quarters(x))
          for (const Triangle &t : quarters(y))
            sum += exact(PairFace(s, {0, 1, 2}), PairFace(t, {3, 4, 5})).value;
        const double whole = exact(PairFace(x, {0, 1, 2}), PairFace(y, {3, 4, 5})).value;
        EXPECT_GT(whole, 1e-14);
        EXPECT_NEAR(sum, whole, 2e-16) << type << " " << distance;
      }
}

// A vertex is straight above one of the other face, or a side, as in lattices, to a rounding.
TEST(ExactPairs, across_the_horizon_may_have_feet_on_vertices_and_sides)
{
  const double third = 1. / 3;
  const Triangle x = {Point<3>(5 * third, 7 * third, 1), Point<3>(5 * third, 7 * third, 4 * third),
                      Point<3>(2, 7 * third, 4 * third)};
  for (const Kind kind : {Kind::biharmonic, Kind::harmonic})
    for (const double slide : {0., .5 * third})
    {
      const auto kernel = kernel_of("constant");
      const PairFace f(x, {0, 1, 2}),
          g({Point<3>(1.339940, 1.326934, .723491), Point<3>(1.617466, 1.718092, .707932),
             Point<3>(5 * third, 5 * third, 1 + slide)},
            {3, 4, 5});
      const FacePotential potential(kernel, kind);
      const double expected = FacePairs(potential, 4)(f, g);
      EXPECT_NEAR(ExactPairs(kernel, kind, any_error)(f, g).value, expected, .1 * expected);
    }
}

TEST(ExactPairs, of_nearly_parallel_faces_take_the_digits_that_they_need)
{
  // a triangle about an axis in its plane, above another; and turned so that an edge stays parallel
  const Triangle y = {Point<3>(.2, .3, .3), Point<3>(.4, .35, .3), Point<3>(.25, .5, .3)};
  const auto kernel = kernel_of("constant");
  constexpr double tolerance = 2e-18;
  const ExactPairs exact(kernel, Kind::biharmonic, tolerance);
  const auto turned = [](double angle, double slope) {
    return Triangle{Point<3>(0, 0, 0), Point<3>(.3, 0, slope), Point<3>(.1, .2, .2 * angle)};
  };
  const PairFace g(y, {3, 4, 5});
  const double limit = exact(PairFace(turned(0, 0), {0, 1, 2}), g).value;
  std::array<unsigned int, 4> n_level{};
  for (const double angle : {.3, 1e-2, 1e-5, 1e-9, 1e-12, 1e-13})
    for (const double slope : {0., .3 * angle})
    {
      const PairFace f(turned(angle, slope), {0, 1, 2});
      const auto integral = exact(f, g);
      ++n_level[integral.level];
      EXPECT_LE(integral.error, tolerance);
      EXPECT_NEAR(integral.value, exact.precise(f, g), tolerance) << angle << " " << slope;
      EXPECT_NEAR(integral.value, limit, 2 * angle * limit + tolerance) << angle << " " << slope;
    }
  for (const unsigned int n : n_level)
    EXPECT_GT(n, 0u);
}

// Where digits of double do not suffice, edges that are parallel to each other are so with 237
// bits, too, although coordinates of the normals are rounded. The faces do not see each other.
TEST(ExactPairs, of_parallel_edges_out_of_reach_vanish_with_all_digits)
{
  const PairFace f({Point<3>(0, 1, -1), Point<3>(.5, 1, -.5), Point<3>(.5, 1.5, -.5)}, {0, 1, 2}),
      g({Point<3>(0.56582938213832668, 0.91700884141027927, 1.0659206729382276),
         Point<3>(.5, 1.5, 1), Point<3>(1, 1.5, 1.5)},
        {3, 4, 5});
  const ExactPairs exact(kernel_of("constant"), Kind::biharmonic, 1e-16);
  EXPECT_NEAR(exact(f, g).value, 0, 1e-16);
  EXPECT_NEAR(exact.precise(f, g), 0, 1e-30);
}

TEST(ExactEntries, of_the_cells_of_cubes_add_up_to_exact_ones_of_cubes)
{
  const double h = 1, horizon = 1.7;
  const auto space =
      space_on(geometry::six_per_cube({{{{Point<3>(), Point<3>(h, h, h)}}, {}}, h}, 2), false);
  for (const std::string type : {"constant", "linear-decay", "1/r"})
  {
    const auto kernel = kernel_of(type, horizon);
    const auto stencil = galerkin_stencil(kernel, h, AxisShapes(false, 0));
    FaceRule rule = FaceRule::exact();
    rule.spacing = h;
    const auto matrix = assemble_by_faces(space, kernel, 6, rule);
    EXPECT_LT(error_of_cube_sums(matrix, space, stencil), 1e-12) << type;
  }
}

TEST(ExactEntries, of_a_constant_kernel_are_products_of_masses_inside)
{
  const double horizon = 4;
  const auto space = space_on(moved_mesh(6, .05), true);
  const auto kernel = kernel_of("constant", horizon);
  FaceRuleUse use;
  const auto row = row_of(assemble_by_faces(space, kernel, 1, FaceRule::exact(), &use), 0);
  EXPECT_GT(use.n_pairs[1], 0u); // in long double
  EXPECT_GT(use.error, 0);
  EXPECT_LT(use.error, 1e-12);
  const TetrahedralMesh &mesh = space.mesh();
  std::vector<double> mass(space.n_dofs());
  std::vector<std::vector<Point<3>>> stars(space.n_dofs());
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      mass[space.dof(cell, corner)] += determinant(mesh, cell) / 24;
      for (const unsigned int vertex : mesh.cells[cell])
        stars[space.dof(cell, corner)].push_back(mesh.vertices[vertex]);
    }
  unsigned int n_inside = 0;
  for (const auto &[column, value] : row)
  {
    double farthest = column == 0 ? horizon : 0;
    for (const Point<3> &x : stars[0])
      for (const Point<3> &y : stars[column])
        farthest = std::max(farthest, x.distance(y));
    if (farthest >= horizon)
      continue;
    ++n_inside;
    EXPECT_NEAR(value, -kernel.constant() * mass[0] * mass[column], 1e-13 * row.at(0));
  }
  EXPECT_GT(n_inside, 2u);
}

TEST(ExactEntries, add_up_over_finer_meshes)
{
  // the hat of a vertex is that of the finer mesh and half those of the middles of its edges
  const double horizon = .4;
  for (const std::string type : {"linear-decay"})
  {
    const auto kernel = kernel_of(type, horizon);
    const TetrahedralMesh mesh = moved_mesh(2, .2);
    const auto coarse = space_on(mesh, true), fine = space_on(refined(mesh), true);
    ASSERT_EQ(coarse.n_free(), 1u);
    const auto row = row_of(assemble_by_faces(coarse, kernel, 1, FaceRule::exact()), 0);
    const auto matrix = assemble_by_faces(fine, kernel, fine.n_free(), FaceRule::exact());
    std::map<std::array<unsigned int, 2>, double> parts; // of coarse and fine functions
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int own = coarse.dof(cell, i);
        parts[{own, fine.dof(8 * cell + i, corner_of(fine, 8 * cell + i, coarse.support(own)))}] =
            1;
        for (unsigned int j = 0; j < 4; ++j)
          if (j != i)
          {
            const Point<3> middle(.5 * (coarse.support(own) + coarse.support(coarse.dof(cell, j))));
            parts[{own, fine.dof(8 * cell + i, corner_of(fine, 8 * cell + i, middle))}] = .5;
          }
      }
    std::vector<double> of_fine(fine.n_dofs()); // the row of the coarse function by fine ones
    for (const auto &[names, part] : parts)
      if (names[0] == 0)
        for (const auto &[column, value] : row_of(matrix, names[1]))
          of_fine[column] += part * value;
    std::map<unsigned int, double> sums;
    for (const auto &[names, part] : parts)
      sums[names[0]] += part * of_fine[names[1]];
    double worst = 0;
    for (const auto &[column, sum] : sums)
    {
      const auto found = row.find(column);
      worst = std::max(worst, std::abs(sum - (found == row.end() ? 0 : found->second)));
    }
    EXPECT_LT(worst / row.at(0), 1e-12) << type;
  }
}

TEST(ExactEntries, are_symmetric_to_the_last_bit_and_annihilate_linear_fields)
{
  for (const bool is_continuous : {true, false})
  {
    const auto space = space_on(moved_mesh(2, .2), is_continuous);
    const auto kernel = kernel_of("linear-decay", .7);
    const std::size_t n_rows = is_continuous ? 1 : 48;
    const auto matrix = assemble_by_faces(space, kernel, n_rows, FaceRule::exact());
    std::vector<std::map<unsigned int, double>> rows;
    for (std::size_t i = 0; i < n_rows; ++i)
      rows.push_back(row_of(matrix, i));
    for (std::size_t i = 0; i < n_rows; ++i)
    {
      double sum = 0;
      dealii::Tensor<1, 3> first;
      for (const auto &[j, value] : rows[i])
      {
        sum += value;
        first += value * (space.support(j) - space.support(i));
        if (j < n_rows)
        {
          EXPECT_EQ(value, rows[j].at(static_cast<unsigned int>(i)));
        }
      }
      EXPECT_LT(std::abs(sum) / rows[i].at(static_cast<unsigned int>(i)), 1e-13);
      if (is_continuous)
      {
        EXPECT_LT(first.norm() / rows[i].at(static_cast<unsigned int>(i)), 1e-13);
      }
    }
  }
}

TEST(ExactEntries, of_lattices_are_those_of_their_meshes_and_symmetric)
{
  const double h = .5, horizon = .45;
  const geometry::CubeLattice lattice({{{Point<3>(), Point<3>(1.5, 1.5, 1.5)}}, {}}, h);
  const auto kernel = kernel_of("constant", horizon);
  const auto space =
      space_on(geometry::six_per_cube(lattice, geometry::layers_within(horizon, h)), true);
  FaceRuleUse once, all;
  const RepeatedRows rows(kernel, h, true, FaceRule::exact(), &once);
  const auto repeated = rows.on(space, lattice),
             matrix = assemble_by_faces(space, kernel, 1, FaceRule::exact(), &all);
  EXPECT_LT(4 * once.n_pairs[0], all.n_pairs[0]);
  const auto expected = row_of(matrix, 0);
  for (const auto &[column, value] : row_of(repeated, 0))
    EXPECT_NEAR(value, expected.at(column), 1e-13 * expected.at(0));
  for (std::size_t i = 0; i < repeated.n_rows(); ++i)
    for (const auto &[j, value] : row_of(repeated, i))
      if (j < repeated.n_rows())
      {
        EXPECT_EQ(value, row_of(repeated, j).at(static_cast<unsigned int>(i)));
      }
}
