// Pairs of quadrilaterals by their sides: against the correlations of the pairs, those of
// rectangles, and against identities that only exact entries satisfy.
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/entry_check.h"
#include "reference/mesh/pair_correlation.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/rectangle_pairs.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::Point;
  using reference::MeshCells;
  using reference::MeshSpace;
  using reference::PairBlocks;
  using Powers = physics::RadialProfile::Powers;

  const std::vector<Powers> profiles = {{{1, 0}}, {{1, 0}, {-1, 1}}, {{1, -1}}};

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  Mesh squares(double h, double horizon)
  {
    return geometry::lattice_mesh(unit_square, h, horizon, false);
  }

  /// All alike: squares sheared, and wide enough for balls.
  Mesh parallelograms(double h, double horizon)
  {
    Mesh mesh = squares(h, 1.5 * horizon);
    for (auto &x : mesh.vertices)
      x = Point<2>(x[0] + .3 * x[1], .9 * x[1] - .2 * x[0]);
    return mesh;
  }

  /// None alike, but for those near the lower left corner of the unit square.
  Mesh moved(double h, double horizon, double part, double from = -1e9)
  {
    Mesh mesh = squares(h, horizon);
    std::mt19937 random(3);
    for (auto &x : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
        if (x[0] + x[1] > from)
          x[d] += part * h * (2. * random() / random.max() - 1);
    return mesh;
  }

  double difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  }

  double difference(const PairBlocks &a, const PairBlocks &b)
  {
    return std::max(
        {difference(a.outer, b.outer), difference(a.cross, b.cross), difference(a.inner, b.inner)});
  }

  struct Assembled
  {
    std::shared_ptr<const MeshSpace> space;
    reference::MeshMatrix matrix;
  };

  Assembled assemble(const Mesh &mesh, const physics::Kernel<2> &kernel, bool is_continuous,
                     unsigned int degree)
  {
    auto space = std::make_shared<const MeshSpace>(std::make_shared<const Mesh>(mesh),
                                                   is_continuous, degree);
    const MeshCells cells(mesh);
    return {space,
            reference::assemble(*space, cells, kernel, {}, {0, true, geometry::Backend::fast},
                                base::Communicator::alone())};
  }

  /// The largest |Σ_j A_ij u(x_j - x_i)| of the rows, in units of the diagonal.
  double worst_row(const Assembled &system, double constant, double slope)
  {
    double worst = 0;
    const auto &rows = system.matrix.rows;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0, largest = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const auto z = system.space->support(rows.column[k]) - system.space->support(i);
        sum += rows.value[k] * (constant + slope * (z[0] - 2 * z[1]));
        largest = std::max(largest, rows.value[k]);
      }
      worst = std::max(worst, std::abs(sum) / largest);
    }
    return worst;
  }

  bool is_symmetric(const algebra::CsrMatrix &rows)
  {
    const auto at = [&](std::size_t i, std::size_t j)
    {
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (rows.column[k] == j)
          return rows.value[k];
      return 0.;
    };
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (rows.column[k] < i && rows.value[k] != at(rows.column[k], i))
          return false;
    return true;
  }

  /// Terms of near pairs of bilinear functions are larger than their sum, see PolygonPairs.
  double rounding(const Powers &powers, unsigned int degree)
  {
    return degree == 0 ? 2e-13 : powers.front().exponent == 0 && powers.size() == 1 ? 1e-12 : 5e-11;
  }
} // namespace

TEST(QuadrilateralPairs, HaveTheIntegralsOfTheirCorrelations)
{
  const double h = .125;
  std::mt19937 random(5);
  for (const double m : {.7, 1.5, 3.})
    for (const Powers &powers : profiles)
      for (const unsigned int degree : {0u, 1u})
      {
        const auto mesh = std::make_shared<const Mesh>(degree == 0 ? moved(h, m * h, .25)
                                                                   : parallelograms(h, m * h));
        const MeshSpace space(mesh, false, degree);
        const MeshCells cells(*mesh);
        const physics::Kernel<2> kernel(physics::Structure::scalar, powers, m * h, 1);
        ASSERT_EQ(reference::PolygonPairs::refuse(space, kernel), "");
        reference::PolygonPairs pairs(space, cells, kernel);
        PairBlocks sides, correlation;
        std::vector<unsigned int> near;
        for (unsigned int trial = 0; trial < 4; ++trial)
        {
          const std::size_t outer = random() % cells.size();
          cells.find_near(outer, m * h, near);
          for (unsigned int partner = 0; partner < 3; ++partner)
          {
            const std::size_t inner = near[random() % near.size()];
            ASSERT_TRUE(pairs.is_exact(outer, inner));
            pairs.integrate(outer, inner, sides);
            reference::integrate_correlation(space, outer, inner, kernel, correlation);
            const double scale =
                cells.area(outer) * cells.area(inner) * std::max(1., kernel.radial(h));
            EXPECT_LT(difference(sides, correlation), (degree == 0 ? 2e-12 : 2e-11) * scale)
                << m << ' ' << degree;
          }
        }
      }
}

TEST(QuadrilateralPairs, OfSquaresAreThoseOfRectangles)
{
  const double h = .125, horizon = 2.5 * h;
  for (const Powers &powers : profiles)
    for (const unsigned int degree : {0u, 1u})
    {
      const auto mesh = std::make_shared<const Mesh>(squares(h, horizon));
      const MeshSpace space(mesh, true, degree);
      const MeshCells cells(*mesh);
      const physics::Kernel<2> kernel(physics::Structure::scalar, powers, horizon, 1);
      const reference::KernelEntries profile(kernel);
      reference::PolygonPairs by_sides(space, cells, kernel);
      reference::RectanglePairs by_correlation(space.shapes(), profile, horizon,
                                               geometry::Backend::fast);
      PairBlocks sides, correlation;
      std::vector<unsigned int> near;
      const std::size_t outer = cells.size() / 2;
      cells.find_near(outer, horizon, near);
      const double scale = std::pow(h, 4) * std::max(1., kernel.radial(h));
      for (const unsigned int inner : near)
      {
        by_sides.integrate(outer, inner, sides);
        by_correlation.integrate(cells[outer].box(), cells[inner].box(), correlation);
        EXPECT_LT(difference(sides, correlation), rounding(powers, degree) * scale)
            << degree << ' ' << cells.centroid(outer).distance(cells.centroid(inner)) / h;
      }
    }
}

TEST(QuadrilateralPairs, MakeMatricesThatReproduceLinearFields)
{
  const double h = .2;
  for (const Powers &powers : profiles)
    for (const auto &[is_continuous, degree] :
         {std::pair(false, 0u), std::pair(false, 1u), std::pair(true, 1u)})
    {
      const auto kernel = physics::Kernel<2>::with_diffusion(powers, 2.2 * h, 1);
      const Assembled system =
          assemble(degree == 0 ? moved(h, 2.2 * h, .2) : parallelograms(h, 2.2 * h), kernel,
                   is_continuous, degree);
      EXPECT_TRUE(system.matrix.is_exact);
      EXPECT_EQ(system.matrix.way, "exact by sides of pairs of quadrilaterals");
      const double allowed = rounding(powers, degree);
      EXPECT_LT(worst_row(system, 1, 0), allowed);
      if (degree > 0)
      {
        EXPECT_LT(worst_row(system, 0, 1 / (2.2 * h)), allowed);
      }
      EXPECT_TRUE(is_symmetric(system.matrix.rows));
      const auto check =
          reference::check_entries(*system.space, kernel, {}, system.matrix.rows, 20, 1);
      EXPECT_GT(check.n_entries, 0u);
      EXPECT_LT(check.worst_difference, allowed);
    }
}

TEST(QuadrilateralPairs, AddUpToThoseOfTheirParts)
{
  const double h = .25, horizon = 1.6 * h;
  const Mesh coarse = moved(h, horizon, .2), fine = geometry::refine(coarse);
  for (const Powers &powers : profiles)
  {
    const physics::Kernel<2> kernel(physics::Structure::scalar, powers, horizon, 1);
    const MeshSpace of_coarse(std::make_shared<const Mesh>(coarse), false, 0),
        of_fine(std::make_shared<const Mesh>(fine), false, 0);
    const MeshCells cells(coarse), parts(fine);
    reference::PolygonPairs pairs(of_coarse, cells, kernel), of_parts(of_fine, parts, kernel);
    PairBlocks whole, part;
    std::vector<unsigned int> near;
    const std::size_t outer = cells.size() / 2;
    cells.find_near(outer, horizon, near);
    for (const unsigned int inner : near)
    {
      pairs.integrate(outer, inner, whole);
      double sum = 0;
      for (std::size_t i = 4 * outer; i < 4 * outer + 4; ++i)
        for (std::size_t j = 4 * inner; j < 4 * inner + 4; ++j)
        {
          of_parts.integrate(i, j, part);
          sum += part.cross[0];
        }
      const double scale = cells.area(outer) * cells.area(inner) * std::max(1., kernel.radial(h));
      EXPECT_NEAR(whole.cross[0], sum, 1e-12 * scale);
    }
  }
}

TEST(QuadrilateralPairs, LeaveToQuadratureWhatIsNoPolynomial)
{
  const double h = .2, horizon = 2 * h;
  const auto kernel = physics::Kernel<2>::with_diffusion(profiles[0], horizon, 1);
  const Mesh some = moved(h, horizon, .2, .7);
  const Assembled mixed = assemble(some, kernel, true, 1);
  EXPECT_FALSE(mixed.matrix.is_exact);
  EXPECT_EQ(mixed.matrix.way, "by sides of pairs of quadrilaterals, but by quadrature where one "
                              "of them is no parallelogram");
  EXPECT_LT(worst_row(mixed, 1, 0), 1e-12);
  const Assembled quadratic = assemble(parallelograms(h, horizon), kernel, true, 2);
  EXPECT_FALSE(quadratic.matrix.is_exact);
  EXPECT_EQ(quadratic.matrix.way,
            "by quadrature, not exact by sides of quadrilaterals: the degree is more than 1");
  // rectangles as before, and beside others
  EXPECT_EQ(assemble(squares(h, horizon), kernel, true, 2).matrix.way,
            "of axis-aligned rectangles exact by correlation");
  Mesh sheared = squares(h, 1.5 * horizon);
  for (auto &x : sheared.vertices)
    x[0] += .3 * std::max(0., x[1] - .4);
  const Assembled both = assemble(sheared, kernel, true, 1);
  EXPECT_TRUE(both.matrix.is_exact);
  EXPECT_LT(worst_row(both, 0, 1 / horizon), 1e-12);
}
