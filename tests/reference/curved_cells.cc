// Cells whose sides follow curves: entries against correlations of their parts and the sums over
// them, and what only exact entries satisfy.
#include "base/error.h"
#include "geometry/curved_mesh.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/cell_rules.h"
#include "reference/mesh/entry_check.h"
#include "reference/mesh/polygon_pairs.h"

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

  Point<2> on_circle(double angle, double radius)
  {
    return Point<2>(radius * std::cos(angle), radius * std::sin(angle));
  }

  /// Rings of triangles of sides h or so, circles between them; radius 1, and as much again.
  Mesh rings(unsigned int n_rings, bool is_curved)
  {
    const unsigned int n = 6 * n_rings;
    Mesh mesh;
    geometry::SideCurves curves;
    mesh.vertices = {Point<2>()};
    const auto place = [&](unsigned int ring, unsigned int k)
    { return ring == 0 ? 0 : 1 + (ring - 1) * n + k % n; };
    for (unsigned int ring = 1; ring <= 2 * n_rings; ++ring)
      for (unsigned int k = 0; k < n; ++k)
        mesh.vertices.push_back(
            on_circle((k + .1 * ring) * 2 * M_PI / n, static_cast<double>(ring) / n_rings));
    for (unsigned int ring = 1; ring <= 2 * n_rings; ++ring)
      for (unsigned int k = 0; k < n; ++k)
      {
        const bool is_inside = ring <= n_rings;
        const unsigned int a = place(ring - 1, k), b = place(ring, k), c = place(ring, k + 1),
                           d = place(ring - 1, k + 1);
        mesh.cells.push_back({{a, b, c, 0}, 3, is_inside});
        if (ring > 1)
          mesh.cells.push_back({{a, c, d, 0}, 3, is_inside});
        auto &curve = curves[std::minmax(b, c)];
        for (const double t : {.25, .5, .75})
          curve.push_back(
              on_circle((k + t + .1 * ring) * 2 * M_PI / n, static_cast<double>(ring) / n_rings));
        if (b > c)
          std::reverse(curve.begin(), curve.end());
      }
    return is_curved ? geometry::follow_curves(mesh, curves) : mesh;
  }

  struct System
  {
    System(const Mesh &mesh, bool is_continuous, unsigned int degree)
        : space(std::make_shared<const Mesh>(geometry::straightened(mesh)), is_continuous, degree,
                middles(mesh)),
          cells(mesh)
    {
    }
    static MeshSpace::Middles middles(const Mesh &mesh)
    {
      MeshSpace::Middles result;
      for (const geometry::WholeCell &whole : mesh.wholes)
        result.push_back(whole.middles);
      return result;
    }
    reference::MeshMatrix assemble(const physics::Kernel<2> &kernel,
                                   const std::optional<physics::Coefficient> &a = {}) const
    {
      return reference::assemble(space, cells, kernel, a, {0, true, geometry::Backend::fast},
                                 base::Communicator::alone());
    }

    MeshSpace space;
    MeshCells cells;
  };

  /// The largest |Σ_j A_ij u(x_j - x_i)| of the rows, in units of the diagonal.
  double worst_row(const System &system, const algebra::CsrMatrix &rows, double constant,
                   double slope)
  {
    double worst = 0;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0, largest = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const auto z = system.space.support(rows.column[k]) - system.space.support(i);
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

  /// Parts are a quarter as wide as triangles: terms of near pairs are larger than their sum by
  /// more than those of PolygonPairs.
  double rounding(const Powers &powers, unsigned int degree)
  {
    const bool is_constant = powers.size() == 1 && powers.front().exponent == 0;
    return degree < 2 ? 2e-12 : is_constant ? 1e-11 : 1e-9;
  }
} // namespace

TEST(CurvedCells, CoverTheDisk)
{
  const System system(rings(4, true), false, 2);
  double sum = 0, of_rule = 0;
  reference::CellRule rule;
  const reference::CellRules rules = reference::gauss_on_cells(system.space, system.cells, 4);
  std::vector<double> by_functions(system.space.shapes().size());
  for (std::size_t cell = 0; cell < system.cells.size(); ++cell)
  {
    if (!system.space.mesh().cells[cell].is_inside)
      continue;
    sum += system.cells.area(cell);
    rules.find(cell, rule);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      for (unsigned int a = 0; a < 6; ++a) // shape functions add up to one
        of_rule += rule.weights[q] * rule.phi[q * 6 + a];
  }
  EXPECT_NEAR(sum, M_PI, 1e-6);
  EXPECT_NEAR(of_rule, sum, 1e-13);
}

TEST(CurvedCells, HaveMatricesThatReproduceLinearFields)
{
  const Mesh mesh = rings(2, true);
  for (const Powers &powers : profiles)
    for (const auto &[is_continuous, degree] :
         {std::pair(false, 0u), std::pair(true, 1u), std::pair(false, 1u), std::pair(true, 2u),
          std::pair(false, 2u)})
    {
      if (powers.size() > 1 && degree == 2)
        continue; // costs most and is between the others
      const System system(mesh, is_continuous, degree);
      const double horizon = .8;
      const auto kernel = physics::Kernel<2>::with_diffusion(powers, horizon, 1);
      const reference::MeshMatrix matrix = system.assemble(kernel);
      EXPECT_TRUE(matrix.is_exact);
      EXPECT_EQ(
          matrix.way,
          "exact by sides of pairs of triangles, sides on curves by four straight parts each");
      const double allowed = rounding(powers, degree);
      EXPECT_LT(worst_row(system, matrix.rows, 1, 0), allowed) << degree;
      if (degree > 0)
      {
        EXPECT_LT(worst_row(system, matrix.rows, 0, 1 / horizon), allowed) << degree;
      }
      EXPECT_TRUE(is_symmetric(matrix.rows));
      const auto check = reference::check_entries(system.space, system.cells, kernel, {},
                                                  matrix.rows, degree == 2 ? 8 : 20, 1);
      EXPECT_GT(check.n_entries, 0u);
      EXPECT_LT(check.worst_difference, allowed);
    }
}

TEST(CurvedCells, HaveQuadraticFunctionsWhoseNodesLieOnTheCurves)
{
  const System system(rings(3, true), true, 2);
  const MeshSpace &space = system.space;
  unsigned int n_on_circles = 0;
  std::vector<double> phi(6);
  for (std::size_t cell = 0; cell < system.cells.size(); ++cell)
    for (unsigned int a = 0; a < 6; ++a)
    {
      const Point<2> &node = space.support(space.dofs(cell)[a]);
      n_on_circles += a >= 3 && std::abs(3 * node.norm() - std::round(3 * node.norm())) < 1e-5 &&
                              !space.own_functions(cell).empty()
                          ? 1
                          : 0;
      space.values(cell, space.map(cell).unit(node), phi.data());
      for (unsigned int b = 0; b < 6; ++b)
        EXPECT_NEAR(phi[b], a == b ? 1 : 0, 1e-12);
    }
  EXPECT_EQ(n_on_circles, 18 * 11u); // both cells of each side but those of the outermost circle
}

TEST(CurvedCells, HaveTheIntegralsOfTheirParts)
{
  const Mesh mesh = rings(3, true);
  Mesh parts = mesh;
  parts.wholes.clear();
  std::mt19937 random(7);
  for (const double horizon : {.3, .8, 2.5})
    for (const Powers &powers : profiles)
    {
      const physics::Kernel<2> kernel(physics::Structure::scalar, powers, horizon, 1);
      const System whole(mesh, false, 0), of_parts(parts, false, 0);
      reference::PolygonPairs pairs(whole.space, whole.cells, kernel),
          pairs_of_parts(of_parts.space, of_parts.cells, kernel);
      PairBlocks one, part;
      std::vector<unsigned int> near;
      for (unsigned int trial = 0; trial < 12; ++trial)
      {
        const std::size_t outer = random() % whole.cells.size();
        whole.cells.find_near(outer, horizon, near);
        const std::size_t inner = trial < 2 ? outer : near[random() % near.size()];
        pairs.integrate(outer, inner, one);
        double sum = 0;
        for (std::size_t i = whole.cells.first_part(outer); i < whole.cells.end_of_parts(outer);
             ++i)
          for (std::size_t j = whole.cells.first_part(inner); j < whole.cells.end_of_parts(inner);
               ++j)
          {
            pairs_of_parts.integrate(i, j, part);
            sum += part.cross[0];
          }
        const double scale =
            whole.cells.area(outer) * whole.cells.area(inner) * std::max(1., kernel.radial(.2));
        EXPECT_NEAR(one.cross[0], sum, 2e-11 * scale) << horizon;
        EXPECT_NEAR(one.outer[0], sum, 2e-11 * scale) << horizon;
      }
    }
}

TEST(CurvedCells, TakeMaterialsThatMeetAtACurve)
{
  const System system(rings(3, true), false, 1);
  const auto kernel = physics::Kernel<2>::with_diffusion(profiles[0], .8, 1);
  const auto coefficient = [](const std::string &text)
  {
    return physics::Coefficient(physics::Expression("Kernel/coefficient", text),
                                physics::Mean::arithmetic);
  };
  // the polygon leaves the circle by h²/200
  const auto jump = coefficient("x^2 + y^2 < 0.445 ? 1 : 1");
  const auto matrix = system.assemble(kernel, jump);
  EXPECT_TRUE(matrix.is_exact);
  EXPECT_LT(worst_row(system, matrix.rows, 1, 0), 2e-12);
  EXPECT_THROW(system.assemble(kernel, coefficient("1 + x^2")), InputError);
}

TEST(CurvedCells, AreRefusedWhereQuadratureWouldBeNeeded)
{
  Mesh flat = rings(3, true);
  for (auto &x : flat.vertices)
    x[1] *= .02;
  try
  {
    System(flat, false, 1).assemble(physics::Kernel<2>::with_diffusion(profiles[0], .8, 1));
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("write Domain/sides = straight"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("30 times longer than high"), std::string::npos);
  }
}
