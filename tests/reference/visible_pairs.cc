// Pairs of cells with a crack between them, by what is seen past it, against those of the lattice,
// which are exact and go the other way round: bond by bond, not point by point.
#include "geometry/mesh_input.h"
#include "physics/state_based.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/strip/bond_pairs.h"
#include "tests/geometry/crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;
  using geometry::Mesh;
  using reference::BondPairs;
  using reference::MeshCells;
  using reference::MeshSpace;

  constexpr double horizon = .25, h = .125;

  physics::Kernel<2> bonds()
  {
    return physics::deviatoric_kernel(
        physics::influence_function<2>(physics::kernel_type("1/r").profile, horizon), 1);
  }

  struct System
  {
    System(const Mesh &of, bool is_continuous, unsigned int degree)
        : mesh(std::make_shared<const Mesh>(of)), space(mesh, is_continuous, degree), cells(*mesh)
    {
    }
    std::size_t cell_at(const Point<2> &x) const
    {
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
        if (cells.centroid(cell).distance(x) < 1e-9)
          return cell;
      throw std::logic_error("no cell");
    }

    std::shared_ptr<const Mesh> mesh;
    MeshSpace space;
    MeshCells cells;
  };

  Mesh square(bool is_triangles, double size = 1)
  {
    return geometry::lattice_mesh({{{Point<2>(0, 0), Point<2>(size, size)}}, {}}, h, horizon,
                                  is_triangles);
  }

  /// The form of a pair as BondPairs orders it.
  Eigen::MatrixXd form(const System &system, const reference::PairBlocks &blocks,
                       const reference::AxisShapes &shapes)
  {
    const auto &support = system.space.shapes().support();
    const auto n = static_cast<unsigned int>(support.size());
    std::vector<unsigned int> place(n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int s = 0; s < n; ++s)
        if (support[k].distance(Point<2>(shapes.support_point(s % shapes.n_local()),
                                         shapes.support_point(s / shapes.n_local()))) < 1e-9)
          place[k] = s;
    const unsigned int entry[2][2] = {{0, 1}, {1, 2}};
    Eigen::MatrixXd result(4 * n, 4 * n);
    for (unsigned int s = 0; s < n; ++s)
      for (unsigned int t = 0; t < n; ++t)
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
          {
            const std::size_t at = (s * n + t) * 3 + entry[a][b];
            const unsigned int row = 2 * place[s] + a, column = 2 * place[t] + b;
            result(row, column) = blocks.outer[at];
            result(2 * n + row, 2 * n + column) = blocks.inner[at];
            result(row, 2 * n + column) = -blocks.cross[at];
            result(2 * n + column, row) = -blocks.cross[at];
          }
    return result;
  }

  /// Of a uniform point of a square, one of a triangle.
  Point<2> of_triangle(geometry::ArrayView<const Point<2>> vertices, double s, double t)
  {
    if (s + t > 1)
      return of_triangle(vertices, 1 - s, 1 - t);
    return vertices[0] + s * (vertices[1] - vertices[0]) + t * (vertices[2] - vertices[0]);
  }

  /// The k-th point of Halton's sequence in a base.
  double halton(unsigned int k, unsigned int base)
  {
    double result = 0;
    for (double digit = 1. / base; k > 0; k /= base, digit /= base)
      result += k % base * digit;
    return result;
  }
} // namespace

TEST(VisiblePairs, approach_those_of_bonds_on_a_lattice)
{
  const reference::KernelEntries profile(bonds());
  for (const unsigned int degree : {0u, 1u})
  {
    const reference::AxisShapes shapes(false, degree);
    const System system(square(false), false, degree);
    const BondPairs exact(bonds(), h, shapes);
    const Point<2> first(.5 + h / 2, .5 + h / 2);
    const double size = exact.whole(0, 1).cwiseAbs().maxCoeff();
    for (const double tip : {.25, 1., 1.7})
    {
      const std::vector<geometry::Cut> cracks = {
          {Point<2>(-10, .5 + h), Point<2>(.5 + tip * h, .5 + h)}};
      std::vector<double> worst;
      unsigned int n_partial = 0, n_hidden = 0;
      for (const unsigned int refinement : {0u, 2u, 4u})
      {
        reference::PairQuadrature pairs(system.space, system.cells, profile, horizon, {},
                                        refinement, geometry::Backend::fast);
        worst.push_back(0);
        for (int j = 1; j <= 2; ++j)
          for (int i = -2; i <= 2; ++i)
          {
            const std::size_t outer = system.cell_at(first);
            const std::size_t inner = system.cell_at(first + Point<2>(i * h, j * h));
            const BondPairs::Form broken = exact.broken(i, j, 1, tip);
            std::vector<geometry::Cut> between;
            const geometry::Sight sight = geometry::find_between(
                cracks, system.cells[outer].vertices(), system.cells[inner].vertices(), between);
            if (sight == geometry::Sight::hidden)
            {
              EXPECT_LT((exact.whole(i, j) - broken).cwiseAbs().maxCoeff(), 1e-12 * size);
              ++n_hidden;
              continue;
            }
            EXPECT_TRUE(sight == geometry::Sight::partial || broken.cwiseAbs().maxCoeff() == 0);
            n_partial += sight == geometry::Sight::partial ? 1 : 0;
            reference::PairBlocks blocks;
            pairs.integrate(outer, inner, blocks, between);
            worst.back() =
                std::max(worst.back(), (form(system, blocks, shapes) - (exact.whole(i, j) - broken))
                                               .cwiseAbs()
                                               .maxCoeff() /
                                           size);
          }
      }
      EXPECT_GE(n_partial, 6);
      EXPECT_LT(worst[0], .2) << degree << ' ' << tip;
      EXPECT_LT(worst[1], worst[0] / 12) << degree << ' ' << tip; // like d² where shadows turn
      EXPECT_LT(worst[2], worst[1] / 12) << degree << ' ' << tip;
      EXPECT_LT(worst[2], 2e-4) << degree << ' ' << tip;
    }
  }
}

// Past oblique cracks, one with a corner, through triangles, against points that are looked at pair
// by pair.
TEST(VisiblePairs, are_means_over_points_that_see_each_other)
{
  const auto kernel =
      physics::Kernel<2>::with_diffusion(physics::kernel_type("constant").profile, horizon, 1);
  const reference::KernelEntries profile(kernel);
  const System system(square(true), false, 0);
  const auto cracks =
      geometry::straight_parts({{Point<2>(.41, .52), Point<2>(.56, .58), Point<2>(.49, .73)},
                                {Point<2>(.6, .4), Point<2>(.57, .62)}});
  reference::PairQuadrature pairs(system.space, system.cells, profile, horizon, {}, 4,
                                  geometry::Backend::fast);
  unsigned int n_partial = 0;
  const auto near = [&](std::size_t cell)
  { return system.cells.centroid(cell).distance(Point<2>(.5, .55)) < 1.2 * h; };
  for (std::size_t outer = 0; outer < system.cells.size(); ++outer)
    for (std::size_t inner = 0; inner < system.cells.size(); ++inner)
    {
      const auto a = system.cells[outer].vertices(), b = system.cells[inner].vertices();
      std::vector<geometry::Cut> between;
      if (!near(outer) || !near(inner) ||
          geometry::find_between(cracks, a, b, between) != geometry::Sight::partial)
        continue;
      ++n_partial;
      reference::PairBlocks blocks;
      pairs.integrate(outer, inner, blocks, between);
      constexpr unsigned int n_points = 100000;
      unsigned int n_seen = 0;
      for (unsigned int k = 1; k <= n_points; ++k)
      {
        const Point<2> x = of_triangle(a, halton(k, 2), halton(k, 3));
        const Point<2> y = of_triangle(b, halton(k, 5), halton(k, 7));
        n_seen += x.distance(y) < horizon && std::none_of(cracks.begin(), cracks.end(),
                                                          [&](const geometry::Cut &cut)
                                                          { return geometry::crosses(cut, x, y); })
                      ? 1
                      : 0;
      }
      const double all = kernel.constant() * system.cells.area(outer) * system.cells.area(inner);
      EXPECT_NEAR(blocks.cross[0] / all, 1. * n_seen / n_points, .002) << outer << ' ' << inner;
      EXPECT_EQ(blocks.cross[0], blocks.outer[0]);
    }
  EXPECT_GT(n_partial, 50u);
}

// Two cracks that meet leave two bodies: shape functions of one have no entries with those of the
// other.
TEST(VisiblePairs, of_two_bodies_hold_none_at_the_other)
{
  const Mesh squares = square(false), triangles = square(true);
  for (const System &system :
       {System(squares, false, 0), System(squares, false, 1), System(squares, true, 1),
        System(triangles, false, 0), System(triangles, false, 1), System(triangles, true, 1)})
  {
    const std::vector<geometry::Cut> cracks = {{Point<2>(-5, .5), Point<2>(.54, .5)},
                                               {Point<2>(.43, .5), Point<2>(5, .5)}};
    const auto matrix = reference::assemble(system.space, system.cells, bonds(), {},
                                            {0, true, geometry::Backend::fast, cracks},
                                            base::Communicator::alone());
    EXPECT_FALSE(matrix.is_exact);
    std::vector<char> is_above(system.space.n_dofs()), is_below(is_above);
    for (std::size_t cell = 0; cell < system.cells.size(); ++cell)
      for (unsigned int k = 0; k < system.space.shapes().size(); ++k)
        (system.cells.centroid(cell)[1] > .5 ? is_above : is_below)[system.space.dofs(cell)[k]] = 1;
    double between = 0, size = 0;
    for (std::size_t row = 0; row < matrix.rows.n_rows(); ++row)
      for (std::size_t k = matrix.rows.start[row]; k < matrix.rows.start[row + 1]; ++k)
      {
        const std::size_t a = row / 2, b = matrix.rows.column[k] / 2;
        size = std::max(size, std::abs(matrix.rows.value[k]));
        if ((!is_above[a] && !is_below[b]) || (!is_below[a] && !is_above[b]))
          between = std::max(between, std::abs(matrix.rows.value[k]));
      }
    EXPECT_GT(size, 0);
    EXPECT_LT(between, 1e-12 * size);
  }
}
