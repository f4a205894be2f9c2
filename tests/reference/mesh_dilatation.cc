// The dilatation's part of state-based Galerkin matrices on meshes: exact identities, the lattice's
// entries, direct sums.
#include "physics/gauss.h"
#include "reference/mesh/dilatation.h"

#include "geometry/mesh_input.h"
#include "geometry/visible_part.h"
#include "reference/lattice/dilatation.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/dilatation_row.h"
#include "reference/mesh/weighted_volume.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::Point;
  using physics::Dilatation;
  using physics::Lame;
  using reference::MeshCells;
  using reference::MeshSpace;

  using Field = std::function<Point<2>(const Point<2> &)>;

  struct Discrete
  {
    Discrete(const Mesh &mesh, bool is_continuous, unsigned int degree)
        : space(std::make_shared<const Mesh>(mesh), is_continuous, degree), cells(space.mesh())
    {
    }

    algebra::CsrMatrix assemble(const Dilatation<2> &dilatation, unsigned int refinement,
                                bool is_normalised = false) const
    {
      return assemble(dilatation, {refinement, is_normalised, geometry::Backend::fast});
    }
    algebra::CsrMatrix assemble(const Dilatation<2> &dilatation,
                                const reference::DilatationOptions &options) const
    {
      return reference::assemble_dilatation(space, cells, dilatation, options,
                                            base::Communicator::alone());
    }

    std::vector<double> interpolate(const Field &u) const
    {
      std::vector<double> values;
      for (std::size_t dof = 0; dof < space.n_dofs(); ++dof)
        for (unsigned int c = 0; c < 2; ++c)
          values.push_back(u(space.support(dof))[c]);
      return values;
    }

    MeshSpace space;
    MeshCells cells;
  };

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  /// Of the unit square with a collar, vertices moved at random by up to `shift` h.
  Mesh square_mesh(double h, double collar, bool is_triangles, double shift = 0)
  {
    Mesh mesh = geometry::lattice_mesh(unit_square, h, collar, is_triangles);
    std::mt19937 random(3);
    for (auto &vertex : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
        vertex[d] += shift * h * (2. * random() / random.max() - 1);
    return mesh;
  }

  /// The cells of a mesh for which a condition holds.
  template <class Condition>
  Mesh part_of(const Mesh &mesh, const Condition &is_kept)
  {
    Mesh inside;
    std::map<unsigned int, unsigned int> number;
    for (geometry::MeshCell cell : mesh.cells)
      if (is_kept(cell))
      {
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
        {
          const auto [at, is_new] =
              number.emplace(cell.vertex[v], static_cast<unsigned int>(number.size()));
          if (is_new)
            inside.vertices.push_back(mesh.vertices[cell.vertex[v]]);
          cell.vertex[v] = at->second;
        }
        inside.cells.push_back(cell);
      }
    return inside;
  }

  /// The unit square alone, with nothing around it.
  Mesh free_square(double h, bool is_triangles)
  {
    return part_of(geometry::lattice_mesh(unit_square, h, h, is_triangles),
                   [](const geometry::MeshCell &cell) { return cell.is_inside; });
  }

  Dilatation<2> homogeneous(physics::RadialProfile profile, double horizon)
  {
    return {physics::influence_function<2>(std::move(profile), horizon),
            [](const Point<2> &) {
              return Lame{3, 1};
            },
            true, true};
  }

  Dilatation<2> heterogeneous(double horizon, bool is_two_point)
  {
    return {physics::influence_function<2>({{1, -1}}, horizon),
            [](const Point<2> &x) {
              return Lame{3 + x[0], 1 + .5 * x[1] * x[1]};
            },
            is_two_point, false};
  }

  const physics::RadialProfile singular{{1, -1}}, constant{{1, 0}}, conical{{1, 0}, {-1, 1}},
      bell = physics::kernel_type("gaussian").make({{}, 0, .5, {}}),
      decaying = physics::kernel_type("exponential").make({{}, 0, .5, {}}),
      table = physics::RadialProfile::table({{0, 2}, {.3, 1.5}, {.5, .2}, {1, .1}});

  std::vector<double> product(const algebra::CsrMatrix &rows, const std::vector<double> &values)
  {
    std::vector<double> result(rows.n_rows());
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        result[i] += rows.value[k] * values[rows.column[k]];
    return result;
  }

  double largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  std::map<std::pair<std::size_t, std::size_t>, double> entries(const algebra::CsrMatrix &rows)
  {
    std::map<std::pair<std::size_t, std::size_t>, double> matrix;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        matrix[{i, rows.column[k]}] = rows.value[k];
    return matrix;
  }

  /// Largest |D_ij - D_ji| among the free unknowns, in units of the largest entry.
  double asymmetry(const algebra::CsrMatrix &rows)
  {
    const auto matrix = entries(rows);
    double worst = 0;
    for (const auto &[place, value] : matrix)
      if (place.second < rows.n_rows())
        worst = std::max(worst, std::abs(value - matrix.at({place.second, place.first})));
    return worst / largest(rows.value);
  }

  /// Largest |θ_u(x) - divergence(x)| at points of Ω.
  double row_error(const Discrete &discrete, const Dilatation<2> &dilatation, const Field &u,
                   const std::function<double(const Point<2> &)> &divergence)
  {
    const MeshSpace &space = discrete.space;
    reference::DilatationRow row(space, discrete.cells, dilatation, {}, 2, geometry::Backend::fast);
    std::vector<unsigned int> near, slot(space.n_dofs());
    std::iota(slot.begin(), slot.end(), 0u);
    std::vector<double> theta(2 * space.n_dofs()), test(2 * space.n_dofs());
    const std::vector<double> values = discrete.interpolate(u);
    double worst = 0;
    for (std::size_t cell = 0; cell < discrete.cells.size(); ++cell)
      for (const Point<2> &unit : {Point<2>(.3, .3), Point<2>(.01, .4), Point<2>(.5, 1e-6)})
        if (space.mesh().cells[cell].is_inside)
        {
          discrete.cells.find_near(cell, dilatation.influence.horizon(), near);
          row.evaluate(cell, unit, near, {}, slot, theta, test);
          const double value = std::inner_product(theta.begin(), theta.end(), values.begin(), 0.);
          worst = std::max(worst, std::abs(value - divergence(space.map(cell).point(unit))));
        }
    return worst;
  }

  Point<2> linear(const Point<2> &x)
  {
    return Point<2>(1 + 2 * x[0] - x[1], x[0] + 3 * x[1]);
  }
  Point<2> quadratic(const Point<2> &x)
  {
    return Point<2>(x[0] * x[0] + 2 * x[0] * x[1], x[1] * x[1] - 3 * x[0] * x[1]);
  }

  /// ∫ K ξ·(u(x+ξ) - u(x)) dξ of the quadratic field over what is seen, and with M ξ for ξ.
  std::array<double, 2> visible_dilatation(const geometry::VisibleBody &body,
                                           const physics::Kernel<2> &influence, const Point<2> &x)
  {
    const geometry::Ball ball{x, influence.horizon()};
    std::vector<geometry::Polygon> visible;
    body.find(ball, visible);
    const auto m = geometry::weighted_moments(
        ball, visible, [&](double r) { return influence.radial(r); }, 3);
    const double u[2][2] = {{2 * x[0] + 2 * x[1], 2 * x[0]}, {-3 * x[1], 2 * x[1] - 3 * x[0]}};
    // ∫ K (u_a(x+ξ) - u_a(x)) ξ_c dξ
    const double p[2][2] = {{u[0][0] * m[3] + u[0][1] * m[4] + m[6] + 2 * m[7],
                             u[0][0] * m[4] + u[0][1] * m[5] + m[7] + 2 * m[8]},
                            {u[1][0] * m[3] + u[1][1] * m[4] + m[8] - 3 * m[7],
                             u[1][0] * m[4] + u[1][1] * m[5] + m[9] - 3 * m[8]}};
    const double determinant = m[3] * m[5] - m[4] * m[4];
    return {p[0][0] + p[1][1],
            (m[5] * p[0][0] - m[4] * (p[0][1] + p[1][0]) + m[3] * p[1][1]) / determinant};
  }

  /// The cells below a line y = top.
  Mesh lower_part(const Mesh &mesh, double top)
  {
    return part_of(mesh,
                   [&](const geometry::MeshCell &cell)
                   {
                     return std::all_of(cell.vertex.begin(), cell.vertex.begin() + cell.n_vertices,
                                        [&](unsigned int v)
                                        { return mesh.vertices[v][1] < top + 1e-9; });
                   });
  }
} // namespace

TEST(DilatationRow, GivesTheDivergenceOfLinearAndQuadraticFields)
{
  for (const auto &profile : {singular, constant, conical, bell, decaying, table})
    for (const bool is_triangles : {true, false})
      for (const unsigned int degree : {1u, 2u})
        for (const bool is_continuous : {true, false})
        {
          const Dilatation<2> dilatation = homogeneous(profile, .3);
          const Discrete any(square_mesh(.125, .3, is_triangles, .15), is_continuous, degree);
          EXPECT_LT(row_error(any, dilatation, linear, [](const Point<2> &) { return 5; }), 3e-13);
          if (degree == 1)
            continue; // of unit mass: φ ⋆ div u = div u where that is linear
          const Discrete straight(square_mesh(.125, .3, is_triangles), is_continuous, degree);
          EXPECT_LT(row_error(straight, dilatation, quadratic,
                              [](const Point<2> &x) { return -x[0] + 4 * x[1]; }),
                    3e-13);
        }
}

// The oracle takes the visible part of the whole ball at once, not cell by cell.
TEST(DilatationRow, IsOverWhatIsSeenPastCracksAndOfABody)
{
  using reference::Correction;
  const double delta = .3;
  const std::vector<geometry::Polyline> along_sides = {{Point<2>(-5, .5), Point<2>(.5, .5)}},
                                        through_cells = {{Point<2>(.21, .33), Point<2>(.47, .41),
                                                          Point<2>(.72, .83)}};
  struct Case
  {
    std::vector<geometry::Polyline> cracks;
    double top; ///< of the body, below a free surface
  };
  unsigned int n_far_from_whole = 0;
  for (const Case &one :
       {Case{along_sides, 2}, Case{through_cells, 2}, Case{{}, 1}, Case{along_sides, 1}})
    for (const bool is_triangles : {true, false})
    {
      const Discrete discrete(lower_part(square_mesh(.125, delta, is_triangles), one.top), false,
                              2);
      const geometry::VisibleBody body({{{-1, -1}, {2, -1}, {2, one.top}, {-1, one.top}}},
                                       one.cracks, 1e-9 * delta);
      const auto values = discrete.interpolate(quadratic);
      std::vector<unsigned int> near, slot(discrete.space.n_dofs());
      std::iota(slot.begin(), slot.end(), 0u);
      std::vector<double> theta(values.size()), test(values.size());
      for (const auto &profile : {singular, constant})
        for (const Correction correction : {Correction::dilatation, Correction::energy})
        {
          const Dilatation<2> dilatation = homogeneous(profile, delta);
          reference::DilatationRow row(discrete.space, discrete.cells, dilatation, {}, 2,
                                       geometry::Backend::fast, correction,
                                       geometry::straight_parts(one.cracks));
          for (std::size_t cell = 0; cell < discrete.cells.size(); ++cell)
            for (const Point<2> &unit : {Point<2>(.3, .3), Point<2>(.01, .4), Point<2>(.5, 1e-6)})
            {
              if (!discrete.space.mesh().cells[cell].is_inside)
                continue;
              discrete.cells.find_near(cell, delta, near);
              row.evaluate(cell, unit, near, {}, slot, theta, test);
              const auto [whole, corrected] = visible_dilatation(
                  body, dilatation.influence, discrete.space.map(cell).point(unit));
              EXPECT_NEAR(std::inner_product(theta.begin(), theta.end(), values.begin(), 0.),
                          corrected, 1e-11);
              EXPECT_NEAR(.5 * std::inner_product(test.begin(), test.end(), values.begin(), 0.),
                          correction == Correction::energy ? corrected : whole, 1e-11);
              n_far_from_whole += std::abs(whole - corrected) > .01 ? 1 : 0;
            }
        }
    }
  EXPECT_GT(n_far_from_whole, 1000u);
}

TEST(WeightedVolume, IsTwoInAFullBallAndItsShareAtTheBoundary)
{
  const Mesh mesh = free_square(.25, true);
  for (const auto &profile : {singular, constant, conical, bell, decaying, table})
  {
    const reference::WeightedVolume volume(mesh, physics::influence_function<2>(profile, .3));
    EXPECT_DOUBLE_EQ(volume(Point<2>(.5, .5)), 2);
    for (const double y : {0., 1e-17, 1e-15})
      EXPECT_NEAR(volume(Point<2>(.5, y)), 1, 1e-13);
    EXPECT_NEAR(volume(Point<2>(1e-15, 1e-15)), .5, 1e-13);
  }
}

TEST(WeightedVolume, IsTheSumOverTheCells)
{
  Mesh mesh = square_mesh(.25, .1, true, .1);
  mesh.cells.erase(mesh.cells.begin() + 20, mesh.cells.begin() + 30); // holes, corners of all kinds
  const MeshCells cells(mesh);
  for (const auto &profile : {singular, constant, conical, bell, decaying, table})
  {
    const auto kernel = physics::influence_function<2>(profile, .3);
    const reference::WeightedVolume volume(mesh, kernel);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      const geometry::Ball ball{cells.centroid(cell), .3};
      double sum = 0;
      for (std::size_t other = 0; other < cells.size(); ++other)
        for (const auto &part : kernel.parts())
          sum += geometry::weighted_moments(
              {ball.centre, part.horizon()}, cells[other],
              [&](double r) { return part.radial(r) * r * r; }, 0)[0];
      EXPECT_NEAR(volume(ball.centre), sum, 1e-13);
    }
  }
}

// beyond a straight side at the distance d the ball lacks arcs of 2 acos(d/r)
TEST(WeightedVolume, LacksTheSegmentBeyondASide)
{
  const Mesh mesh = free_square(.25, true);
  const double delta = .2;
  for (const auto &profile : {bell, decaying})
  {
    const auto kernel = physics::influence_function<2>(profile, delta);
    const reference::WeightedVolume volume(mesh, kernel);
    for (double d = 1e-6; d < delta; d += .0037)
    {
      const auto &gauss = physics::gauss(60);
      double segment = 0; // over r = d + (δ - d) v², smooth in v
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double v = gauss.point(q)[0], r = d + (delta - d) * v * v;
        segment += gauss.weight(q) * 2 * (delta - d) * v * kernel.radial(r) * r * r * r * 2 *
                   std::acos(d / r);
      }
      EXPECT_NEAR(volume(Point<2>(.5, d)), 2 - segment, 1e-13) << d;
      EXPECT_NEAR(volume(Point<2>(1 - d, .4)), 2 - segment, 1e-13) << d;
    }
  }
}

TEST(WeightedVolume, IsHalfAtTheBoundaryInSpiteOfRounding)
{
  const auto kernel = physics::influence_function<2>(singular, .2);
  Mesh mesh = free_square(.5, true);
  const double c = std::cos(.7), s = std::sin(.7);
  for (Point<2> &x : mesh.vertices) // turned, so that points of its sides are rounded
    x = Point<2>(3 + c * x[0] - s * x[1], -5 + s * x[0] + c * x[1]);
  const reference::WeightedVolume volume(mesh, kernel);
  for (int k = 25; k <= 75; ++k)
    for (const Point<2> &x :
         {Point<2>(.01 * k, 0), Point<2>(1, .01 * k), Point<2>(.01 * k, 1), Point<2>(0, .01 * k)})
      EXPECT_NEAR(volume(Point<2>(3 + c * x[0] - s * x[1], -5 + s * x[0] + c * x[1])), 1, 1e-12)
          << x;
}

TEST(MeshDilatation, IsBlindToConstantsAndSymmetricWhereItShouldBe)
{
  for (const bool is_triangles : {true, false})
    for (const unsigned int degree : {0u, 1u, 2u})
      for (const bool is_continuous : {true, false})
      {
        const Discrete discrete(square_mesh(.5, .8, is_triangles, .15), is_continuous, degree);
        const auto translation =
            discrete.interpolate([](const Point<2> &) { return Point<2>(1, -2); });
        for (const auto &dilatation :
             {homogeneous(singular, .4), heterogeneous(.4, false), heterogeneous(.4, true)})
        {
          const auto rows = discrete.assemble(dilatation, 0, !dilatation.is_two_point);
          EXPECT_LT(largest(product(rows, translation)), 1e-13 * largest(rows.value));
          if (dilatation.is_symmetric())
            EXPECT_LT(asymmetry(rows), 1e-14);
          else
            EXPECT_GT(asymmetry(rows), 1e-4);
        }
      }
}

TEST(MeshDilatation, PastCracksIsBlindToRigidMotionsAndWithAnEnergySymmetric)
{
  using reference::Correction;
  const auto cracks =
      geometry::straight_parts({{Point<2>(.25, .5), Point<2>(.75, .5)},
                                {Point<2>(.3, -1), Point<2>(.37, .1), Point<2>(.2, .3)}});
  for (const bool is_triangles : {true, false})
    for (const unsigned int degree : {0u, 1u})
    {
      const Discrete discrete(square_mesh(.25, .8, is_triangles), false, degree);
      const auto translation =
          discrete.interpolate([](const Point<2> &) { return Point<2>(1, -2); });
      const auto rotation =
          discrete.interpolate([](const Point<2> &x) { return Point<2>(-x[1], x[0]); });
      for (const auto &dilatation :
           {homogeneous(singular, .4), heterogeneous(.4, false), heterogeneous(.4, true)})
        for (const Correction correction : {Correction::dilatation, Correction::energy})
        {
          const auto rows = discrete.assemble(
              dilatation, {0, false, geometry::Backend::fast, correction, cracks});
          EXPECT_LT(largest(product(rows, translation)), 1e-13 * largest(rows.value));
          if (degree > 0) // constants in cells are no rotation
          {
            EXPECT_LT(largest(product(rows, rotation)), 1e-13 * largest(rows.value));
          }
          if (dilatation.is_symmetric() && correction == Correction::energy)
            EXPECT_LT(asymmetry(rows), 1e-14);
          else
            EXPECT_GT(asymmetry(rows), 1e-4);
        }
    }
}

TEST(MeshDilatation, OfABodyThatACrackCutsOffIsThatOfTheBodyAlone)
{
  using reference::Correction;
  for (const bool is_triangles : {true, false})
    for (const unsigned int degree : {0u, 1u})
      for (const Correction correction : {Correction::dilatation, Correction::energy})
      {
        const Discrete all(square_mesh(.125, .4, is_triangles), false, degree),
            body(lower_part(all.space.mesh(), .5), false, degree);
        std::vector<geometry::Box> gaps;
        std::vector<std::size_t> dof_of_body(all.space.n_dofs(), body.space.n_dofs());
        std::size_t n_kept = 0;
        for (std::size_t cell = 0; cell < all.cells.size(); ++cell)
          if (all.cells.centroid(cell)[1] > .5)
            gaps.push_back(all.cells[cell].box());
          else
          {
            for (unsigned int a = 0; a < all.space.shapes().size(); ++a)
              dof_of_body[all.space.dofs(cell)[a]] = body.space.dofs(n_kept)[a];
            ++n_kept;
          }
        ASSERT_EQ(n_kept, body.cells.size());
        const Dilatation<2> dilatation = homogeneous(singular, .2);
        const reference::DilatationOptions alone{0, false, geometry::Backend::fast, correction};
        reference::DilatationOptions cut = alone, with_gaps = alone;
        cut.cracks = {{Point<2>(-5, .5), Point<2>(5, .5)}};
        with_gaps.gaps = gaps;
        const auto of_all = all.assemble(dilatation, cut),
                   of_body = body.assemble(dilatation, with_gaps);
        auto expected = entries(of_body);
        double worst = 0;
        for (const auto &[place, value] : entries(of_all))
          if (const std::size_t row = dof_of_body[place.first / 2]; row < body.space.n_dofs())
          {
            const std::size_t column = dof_of_body[place.second / 2];
            const auto other =
                expected.find({2 * row + place.first % 2, 2 * column + place.second % 2});
            worst =
                std::max(worst, std::abs(value - (other == expected.end() ? 0 : other->second)));
            if (other != expected.end())
              other->second = 0;
          }
        for (const auto &[place, value] : expected)
          worst = std::max(worst, std::abs(value)); // none is missing
        EXPECT_LT(worst, 1e-12 * largest(of_body.value));
        EXPECT_GT(largest(of_body.value), 0);
      }
}

TEST(MeshDilatation, OfSurroundingsThatRepeatIsThatOfEachCell)
{
  // a material that differs by rounding inside of cells is asked for at every point
  const auto halves = [](double rounding, bool is_two_point)
  {
    return Dilatation<2>{physics::influence_function<2>(singular, .4),
                         [=](const Point<2> &x) {
                           return Lame{(x[0] < .5 ? 3 : 5) + rounding * x[1], x[0] < .5 ? 1. : 4.};
                         },
                         is_two_point, false};
  };
  for (const bool is_triangles : {true, false})
    for (const bool is_continuous : {true, false})
      for (const bool is_two_point : {true, false})
        for (const bool is_free : {true, false})
        {
          const Discrete discrete(is_free ? free_square(.125, is_triangles)
                                          : square_mesh(.25, .8, is_triangles),
                                  is_continuous, 1);
          const auto rows = discrete.assemble(halves(0, is_two_point), 0, is_free),
                     of_each = discrete.assemble(halves(4e-15, is_two_point), 0, is_free);
          ASSERT_EQ(rows.column, of_each.column);
          double difference = 0;
          for (std::size_t k = 0; k < rows.value.size(); ++k)
            difference = std::max(difference, std::abs(rows.value[k] - of_each.value[k]));
          EXPECT_LT(difference, 1e-13 * largest(of_each.value));
          EXPECT_GT(largest(of_each.value), 0);
        }
}

TEST(MeshDilatation, OfUniformSquaresApproachesThatOfTheLattice)
{
  const double h = .5, horizon = 1.3;
  const Dilatation<2> dilatation = homogeneous(singular, horizon);
  for (const unsigned int degree : {1u, 2u})
  {
    const Discrete discrete(square_mesh(h, 2 * horizon, false), true, degree);
    const reference::AxisShapes shapes(true, degree);
    const auto stencil = reference::dilatation_stencil(dilatation.influence, 2, h, shapes);
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    // block of an unknown, and the lattice cell of its place
    const auto locate = [&](std::size_t unknown)
    {
      std::array<int, 3> place{static_cast<int>(unknown % 2)};
      for (const unsigned int d : {1u, 0u})
        for (unsigned int s = 0; s < n_axis; ++s)
        {
          const double at =
              discrete.space.support(unknown / 2)[d] / h - shapes.families()[s].offset;
          if (std::abs(at - std::round(at)) < 1e-9)
          {
            place[0] = place[0] * static_cast<int>(n_axis) + static_cast<int>(s);
            place[1 + d] = static_cast<int>(std::lround(at));
          }
        }
      return place;
    };
    std::vector<double> difference;
    for (const unsigned int refinement : {0u, 1u, 2u})
    {
      double square = 0, size = 0;
      for (const auto &[position, value] : entries(discrete.assemble(dilatation, refinement)))
      {
        const auto from = locate(position.first), to = locate(position.second);
        const int k1 = to[1] - from[1], k2 = to[2] - from[2];
        const double expected = std::max(std::abs(k1), std::abs(k2)) > stencil.reach()
                                    ? 0
                                    : stencil(static_cast<unsigned int>(from[0]),
                                              static_cast<unsigned int>(to[0]), k1, k2);
        square += std::pow(value - expected, 2);
        size += std::pow(expected, 2);
      }
      difference.push_back(std::sqrt(square / size));
    }
    EXPECT_LT(difference[0], 5e-3);
    EXPECT_LT(difference[1], difference[0] / 12);
    EXPECT_LT(difference[2], 5e-5);
  }
}

TEST(MeshDilatation, WithItsBondsIsTheLocalOperatorOfPolynomials)
{
  // weakly for interior test functions: -(λ - μ) ∇div u, and -[μ Δu + (λ + μ) ∇div u] with bonds
  const Discrete discrete(square_mesh(.25, .6, true, .15), true, 2);
  const Dilatation<2> dilatation = homogeneous(singular, .3);
  std::vector<double> integrals(discrete.space.n_free());
  const auto &shapes = discrete.space.shapes();
  const dealii::QWitherdenVincentSimplex<2> gauss(3);
  std::vector<double> phi(shapes.size());
  for (std::size_t cell = 0; cell < discrete.cells.size(); ++cell)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      shapes.values(gauss.point(q), phi.data());
      for (unsigned int a = 0; a < shapes.size(); ++a)
        if (const unsigned int dof = discrete.space.dofs(cell)[a]; dof < integrals.size())
          integrals[dof] +=
              gauss.weight(q) * discrete.space.map(cell).determinant(gauss.point(q)) * phi[a];
    }
  const auto error = [&](const algebra::CsrMatrix &rows, const Field &u, const Point<2> &expected)
  {
    auto residual = product(rows, discrete.interpolate(u));
    for (std::size_t i = 0; i < residual.size(); ++i)
      residual[i] -= expected[i % 2] * integrals[i / 2];
    return largest(residual) / largest(integrals);
  };
  std::array<std::array<double, 3>, 2> errors;
  for (const unsigned int refinement : {0u, 1u})
  {
    const auto rows = discrete.assemble(dilatation, refinement);
    const auto bonds = reference::assemble(
        discrete.space, discrete.cells, physics::deviatoric_kernel(dilatation.influence, 1), {},
        {refinement, true, geometry::Backend::fast}, base::Communicator::alone());
    errors[refinement] = {error(rows, linear, Point<2>()), error(rows, quadratic, Point<2>(2, -8)),
                          error(algebra::add(bonds.rows, rows), quadratic, Point<2>(2, -18))};
  }
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_LT(errors[0][i], .4);
    EXPECT_LT(errors[1][i], errors[0][i] / 8);
  }
}

TEST(MeshDilatation, OfDegreeZeroIsTheVariationalModel)
{
  // families end at the boundary: forces from areas and centroids of ball ∩ cell alone, as Pflug,
  // Stingl & Zetzmann 2026, eqs. (13)-(15)
  const double horizon = .6;
  const Discrete discrete(free_square(.25, false), false, 0);
  Dilatation<2> dilatation = heterogeneous(horizon, false);
  dilatation.influence = physics::influence_function<2>(constant, horizon);
  const double K = dilatation.influence.constant();
  const std::size_t n = discrete.cells.size();
  std::vector<double> expected(4 * n * n);
  const dealii::QGauss<2> gauss(2);
  for (std::size_t cell = 0; cell < n; ++cell)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<2> x = discrete.space.map(cell).point(gauss.point(q));
      std::vector<double> row(2 * n);
      double volume = 0;
      for (std::size_t other = 0; other < n; ++other)
      {
        const auto part = geometry::intersect({x, horizon}, discrete.cells[other]);
        const auto d = part.centroid - x;
        volume += K * (part.area * d.norm_square() + part.second[0] + part.second[2]);
        for (unsigned int c = 0; c < 2; ++c)
        {
          row[2 * other + c] += K * part.area * d[c];
          row[2 * cell + c] -= K * part.area * d[c];
        }
      }
      const Lame material = dilatation.material(x);
      const double weight = gauss.weight(q) * discrete.cells.area(cell) *
                            (material.lambda - material.mu) * std::pow(2 / volume, 2);
      for (std::size_t i = 0; i < 2 * n; ++i)
        for (std::size_t j = 0; j < 2 * n; ++j)
          expected[i * 2 * n + j] += weight * row[i] * row[j];
    }
  const auto rows = discrete.assemble(dilatation, 0, true);
  ASSERT_EQ(rows.n_rows(), 2 * n);
  for (const auto &[place, value] : entries(rows))
  {
    // unknowns are numbered by cell
    double &other = expected[place.first * 2 * n + place.second];
    EXPECT_NEAR(value, other, 1e-13 * largest(rows.value));
    other = 0;
  }
  EXPECT_EQ(largest(expected), 0); // nothing is missing
}

TEST(MeshDilatation, TakesTheMaterialAtBothEnds)
{
  // two cells, each in the ball of all of the other's points: all integrands are smooth
  Mesh mesh;
  mesh.vertices = {Point<2>(0, 0), Point<2>(1, 0), Point<2>(2, 0),
                   Point<2>(0, 1), Point<2>(1, 1), Point<2>(2, 1)};
  mesh.cells = {{{0, 1, 4, 3}, 4, true}, {{1, 2, 5, 4}, 4, true}};
  const Discrete discrete(mesh, false, 0);
  Dilatation<2> dilatation = heterogeneous(3, true);
  dilatation.influence = physics::influence_function<2>(constant, 3);
  const double K = dilatation.influence.constant();
  const dealii::QGauss<2> gauss(8);
  std::vector<std::array<double, 4>> expected(4);
  for (unsigned int cell = 0; cell < 2; ++cell)
    for (unsigned int p = 0; p < gauss.size(); ++p)
    {
      const Point<2> x = discrete.space.map(cell).point(gauss.point(p));
      std::array<double, 4> theta{}, test{};
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<2> y = discrete.space.map(1 - cell).point(gauss.point(q));
        const double f = dilatation.factor(dilatation.material(x), dilatation.material(y));
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double value = gauss.weight(q) * K * (y - x)[c];
          theta[2 * (1 - cell) + c] += value;
          theta[2 * cell + c] -= value;
          test[2 * (1 - cell) + c] += f * value;
          test[2 * cell + c] -= f * value;
        }
      }
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          expected[i][j] += gauss.weight(p) * test[i] * theta[j];
    }
  const auto difference = [&](unsigned int refinement)
  {
    const auto rows = discrete.assemble(dilatation, refinement);
    double worst = 0;
    for (const auto &[place, value] : entries(rows))
      worst = std::max(worst, std::abs(value - expected[place.first][place.second]));
    return worst / largest(rows.value);
  };
  EXPECT_LT(difference(0), 1e-3);
  EXPECT_LT(difference(3), 1e-7);
}
