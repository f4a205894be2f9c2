// Pairs of triangles by their sides: against stored integrals, against the correlations of the
// pairs, and against identities that only exact entries satisfy.
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/edge_assembly.h"
#include "reference/mesh/entry_check.h"
#include "reference/mesh/pair_correlation.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/repeated_pairs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <random>
#include <sstream>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::Point;
  using reference::MeshCells;
  using reference::MeshSpace;
  using reference::PairBlocks;
  using Powers = physics::RadialProfile::Powers;

  const std::vector<Powers> profiles = {{{1, 0}}, {{1, 0}, {-1, 1}}, {{1, -1}}, {{1, 0}, {-1, 2}}};

  /// A row of the stored integrals.
  struct StoredPair
  {
    std::string kind, profile;
    double horizon = 0;
    std::array<Point<2>, 6> vertices;
    std::array<double, 9> cross{}, outer{};

    physics::Kernel<2> kernel() const
    {
      const std::size_t i = profile == "constant" ? 0 : profile == "linear-decay" ? 1 : 2;
      return {physics::Structure::scalar, profiles[i], horizon, 1};
    }
    Mesh mesh() const
    {
      Mesh result;
      for (const unsigned int first : {0u, 3u})
      {
        geometry::MeshCell cell{{}, 3, true};
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto at =
              std::find(result.vertices.begin(), result.vertices.end(), vertices[first + k]);
          cell.vertex[k] = static_cast<unsigned int>(at - result.vertices.begin());
          if (at == result.vertices.end())
            result.vertices.push_back(vertices[first + k]);
        }
        result.cells.push_back(cell);
      }
      return result;
    }
  };

  std::vector<StoredPair> stored_pairs()
  {
    std::ifstream file(PLUMBLINE_TEST_DATA "/pair_integrals/pair_integrals.csv");
    std::vector<StoredPair> pairs;
    for (std::string line; std::getline(file, line);)
    {
      if (line.empty() || line[0] == '#' || line.rfind("class", 0) == 0)
        continue;
      std::istringstream cells(line);
      StoredPair pair;
      std::getline(cells, pair.kind, ',');
      std::getline(cells, pair.profile, ',');
      const auto number = [&]
      {
        std::string word;
        std::getline(cells, word, ',');
        return std::stod(word);
      };
      pair.horizon = number();
      for (auto &vertex : pair.vertices)
        for (unsigned int d = 0; d < 2; ++d)
          vertex[d] = number();
      for (auto *block : {&pair.cross, &pair.outer})
        for (double &value : *block)
          value = number();
      pairs.push_back(pair);
    }
    return pairs;
  }

  template <class Values>
  double largest_difference(const std::vector<double> &a, const Values &b)
  {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  }

  /// Longest side over the height upon it, of the more slender one.
  double slenderness(const Mesh &mesh)
  {
    double most = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      Mesh alone = mesh;
      alone.cells = {mesh.cells[cell]};
      const double longest = alone.longest_side();
      most = std::max(most,
                      longest * longest / (2 * geometry::area(geometry::view(mesh.polygon(cell)))));
    }
    return most;
  }

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  Mesh triangles(double h, double horizon, double part)
  {
    Mesh mesh = geometry::lattice_mesh(unit_square, h, horizon, true);
    std::mt19937 random(3);
    for (auto &vertex : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
        if (std::min({vertex[0], vertex[1], 1 - vertex[0], 1 - vertex[1]}) > 1e-9)
          vertex[d] += part * h * (2. * random() / random.max() - 1);
    return mesh;
  }

  physics::Kernel<2> kernel_of(const Powers &powers, double horizon)
  {
    return physics::Kernel<2>::with_diffusion(powers, horizon, 1);
  }

  struct Assembled
  {
    std::shared_ptr<const MeshSpace> space;
    reference::MeshMatrix matrix;
  };

  Assembled assemble(const Mesh &mesh, const physics::Kernel<2> &kernel, bool is_continuous,
                     unsigned int degree,
                     const std::optional<physics::Coefficient> &coefficient = {}, bool exact = true,
                     unsigned int refinement = 0)
  {
    auto space = std::make_shared<const MeshSpace>(std::make_shared<const Mesh>(mesh),
                                                   is_continuous, degree);
    const MeshCells cells(mesh);
    return {space, reference::assemble(*space, cells, kernel, coefficient,
                                       {refinement, exact, geometry::Backend::fast},
                                       base::Communicator::alone())};
  }

  /// In units of the diagonal: of degree 2, terms of near pairs are larger than their sum by the
  /// fourth power of their distance over their height, of kernels with odd powers by the eighth.
  double rounding(const Powers &powers, unsigned int degree)
  {
    if (degree < 2)
      return 1e-13;
    const bool is_even = std::all_of(powers.begin(), powers.end(),
                                     [](const auto &p) { return p.exponent % 2 == 0; });
    return is_even ? 1e-12 : 5e-11;
  }

  physics::Coefficient coefficient_of(const std::string &text, physics::Mean mean)
  {
    return {physics::Expression("Kernel/coefficient", text), mean};
  }

  /// The largest |Σ_j A_ij u(x_j - x_i)| of the rows, in units of the diagonal.
  double worst_row(const Assembled &system,
                   const std::function<double(const dealii::Tensor<1, 2> &)> &u)
  {
    double worst = 0;
    const auto &rows = system.matrix.rows;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0, largest = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        sum += rows.value[k] * u(system.space->support(rows.column[k]) - system.space->support(i));
        largest = std::max(largest, rows.value[k]);
      }
      worst = std::max(worst, std::abs(sum) / largest);
    }
    return worst;
  }

  std::map<std::pair<std::size_t, unsigned int>, double> entries(const algebra::CsrMatrix &rows)
  {
    std::map<std::pair<std::size_t, unsigned int>, double> result;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        result[{i, rows.column[k]}] = rows.value[k];
    return result;
  }

  /// In units of the largest entry.
  double difference(const Assembled &a, const Assembled &b)
  {
    auto rest = entries(a.matrix.rows);
    double largest = 0, worst = 0;
    for (const auto &[place, value] : entries(b.matrix.rows))
    {
      rest[place] -= value;
      largest = std::max(largest, std::abs(value));
    }
    for (const auto &[place, value] : rest)
      worst = std::max(worst, std::abs(value));
    return worst / largest;
  }
} // namespace

TEST(TrianglePairs, HaveTheStoredIntegralsByTheirSidesAndByTheirCorrelations)
{
  const auto pairs = stored_pairs();
  ASSERT_EQ(pairs.size(), 267u);
  for (const StoredPair &pair : pairs)
  {
    const auto mesh = std::make_shared<const Mesh>(pair.mesh());
    const MeshSpace space(mesh, false, 1);
    const MeshCells cells(*mesh);
    const physics::Kernel<2> kernel = pair.kernel();
    reference::PolygonPairs by_sides(space, cells, kernel);
    PairBlocks sides, correlation;
    by_sides.integrate(0, 1, sides);
    const double scale = cells.area(0) * cells.area(1) / 9;
    const bool is_small = pair.horizon >= 4 * mesh->longest_side();
    const double allowed = slenderness(*mesh) > 10 ? 1e-9 : is_small ? 2.5e-12 : 1e-11;
    const std::string what =
        pair.kind + " " + pair.profile + " δ = " + std::to_string(pair.horizon);
    EXPECT_LT(largest_difference(sides.cross, pair.cross), allowed * scale) << what;
    EXPECT_LT(largest_difference(sides.outer, pair.outer), allowed * scale) << what;
    if (pair.kind == "shared vertex") // rays along sides that nearly meet
      continue;
    reference::integrate_correlation(space, 0, 1, kernel, correlation);
    EXPECT_LT(largest_difference(correlation.cross, pair.cross), 2.5e-12 * scale) << what;
    EXPECT_LT(largest_difference(correlation.outer, pair.outer), 2.5e-12 * scale) << what;
  }
}

TEST(TrianglePairs, OfMovedMeshesHaveTheIntegralsOfTheirCorrelations)
{
  const double h = .125;
  std::mt19937 random(5);
  for (const double m : {.7, 1.5, 3., 5.5})
    for (const Powers &powers : profiles)
      for (const unsigned int degree : {0u, 1u, 2u})
      {
        const auto mesh = std::make_shared<const Mesh>(triangles(h, m * h, .25));
        const MeshSpace space(mesh, false, degree);
        const MeshCells cells(*mesh);
        const physics::Kernel<2> kernel(physics::Structure::scalar, powers, m * h, 1);
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
            pairs.integrate(outer, inner, sides);
            reference::integrate_correlation(space, outer, inner, kernel, correlation);
            const double allowed = (degree == 2 ? 1e-10 : 1e-11) * cells.area(outer) *
                                   cells.area(inner) * std::max(1., kernel.radial(h)) /
                                   (degree == 0 ? 1 : 9);
            EXPECT_LT(largest_difference(sides.cross, correlation.cross), allowed) << m;
            EXPECT_LT(largest_difference(sides.outer, correlation.outer), allowed) << m;
            EXPECT_LT(largest_difference(sides.inner, correlation.inner), allowed) << m;
          }
        }
      }
}

TEST(TrianglePairs, MakeDiscontinuousMatricesThatReproduceLinearFields)
{
  for (const double m : {1.3, 3.})
    for (const Powers &powers : profiles)
      for (const unsigned int degree : {0u, 1u, 2u})
      {
        const double h = m < 2 ? .25 : .125;
        const Assembled system =
            assemble(triangles(h, m * h, .2), kernel_of(powers, m * h), false, degree);
        EXPECT_TRUE(system.matrix.is_exact);
        EXPECT_EQ(system.matrix.way, "exact by sides of pairs of triangles");
        const double allowed = rounding(powers, degree);
        EXPECT_LT(worst_row(system, [](const auto &) { return 1.; }), allowed) << m;
        const auto linear = [&](const auto &x)
        { return degree == 0 ? 0 : (x[0] - 2 * x[1]) / (m * h); };
        EXPECT_LT(worst_row(system, linear), allowed) << m;
        const algebra::CsrMatrix &rows = system.matrix.rows;
        for (std::size_t i = 0; i < rows.n_rows(); ++i)
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            if (const unsigned int j = rows.column[k]; j < i)
            {
              const auto at = std::lower_bound(
                  rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[j]),
                  rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[j + 1]), i);
              ASSERT_EQ(rows.value[k],
                        rows.value[static_cast<std::size_t>(at - rows.column.begin())]);
            }
      }
}

TEST(TrianglePairs, GiveContinuousMatricesThoseOfPairsOfNodes)
{
  const double h = .125;
  const auto one = coefficient_of("1", physics::Mean::arithmetic);
  for (const Powers &powers : profiles)
  {
    const Mesh mesh = triangles(h, 4 * h, .2);
    const Assembled by_pairs = assemble(mesh, kernel_of(powers, 4 * h), true, 1, one),
                    by_nodes = assemble(mesh, kernel_of(powers, 4 * h), true, 1);
    EXPECT_NE(by_pairs.matrix.way, by_nodes.matrix.way);
    EXPECT_LT(difference(by_pairs, by_nodes), 1e-12);
  }
}

TEST(TrianglePairs, TakeMaterialsThatChangeFromCellToCell)
{
  const double h = .25, horizon = 2 * h;
  const Mesh mesh = triangles(h, horizon, 0);
  for (const auto mean : {physics::Mean::arithmetic, physics::Mean::harmonic})
  {
    const auto jumps = coefficient_of("x > .5 ? 3 : 1", mean);
    for (const bool is_continuous : {true, false})
    {
      const auto kernel = kernel_of({{1, 0}}, horizon);
      const Assembled exact = assemble(mesh, kernel, is_continuous, 1, jumps);
      EXPECT_TRUE(exact.matrix.is_exact);
      const double coarse =
                       difference(assemble(mesh, kernel, is_continuous, 1, jumps, false, 1), exact),
                   fine =
                       difference(assemble(mesh, kernel, is_continuous, 1, jumps, false, 4), exact);
      EXPECT_LT(fine, 1e-6);
      EXPECT_GT(coarse, 10 * fine);
    }
  }
  const Assembled changing = assemble(mesh, kernel_of({{1, 0}}, horizon), false, 1,
                                      coefficient_of("1 + x", physics::Mean::arithmetic));
  EXPECT_FALSE(changing.matrix.is_exact);
  EXPECT_NE(changing.matrix.way.find("the material changes inside of triangles"),
            std::string::npos);
}

TEST(TrianglePairs, LeaveSlendersToQuadrature)
{
  const double h = .25;
  Mesh flat = triangles(h, 2 * h, 0);
  for (auto &vertex : flat.vertices)
    vertex[1] *= .02;
  const Assembled system = assemble(flat, kernel_of({{1, 0}}, 2 * h), false, 0);
  EXPECT_FALSE(system.matrix.is_exact);
  EXPECT_NE(system.matrix.way.find("30 times longer than high"), std::string::npos);
}

TEST(EntryCheck, FindsEntriesThatAreWrong)
{
  const double h = .25;
  for (const auto &[is_continuous, degree] :
       {std::pair(true, 1u), std::pair(false, 1u), std::pair(true, 2u)})
    for (const Powers &powers : {profiles[0], profiles[2]})
    {
      const auto kernel = kernel_of(powers, 3 * h);
      Assembled system = assemble(triangles(h, 3 * h, .2), kernel, is_continuous, degree);
      algebra::CsrMatrix &rows = system.matrix.rows;
      const auto check = [&]
      { return reference::check_entries(*system.space, kernel, {}, rows, 20, 1); };
      EXPECT_GE(check().n_pairs, 20u);
      EXPECT_LT(check().worst_difference, 1e-13);
      for (double &value : rows.value)
        value *= 1 + 1e-8;
      EXPECT_GT(check().worst_difference, 1e-12);
    }
}

TEST(RepeatedPairs, AreTranslationsOfTheFirstOfTheirKind)
{
  const double h = .125, horizon = 3 * h;
  Mesh mesh = triangles(h, horizon, 0);
  for (auto &vertex : mesh.vertices) // two shapes of four triangles
    vertex[0] += vertex[0] > .5 ? .5 * (vertex[0] - .5) : 0;
  const auto pairs_of = [&](const Mesh &any)
  {
    const MeshCells cells(any);
    std::vector<reference::CellPairs> pairs(cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      if (any.cells[cell].is_inside)
        cells.find_near(cell, horizon, pairs[cell].partners);
    return pairs;
  };
  auto pairs = pairs_of(mesh);
  const reference::RepeatedPairs repeated(mesh, pairs_of(mesh), pairs);
  std::size_t n_pairs = 0;
  for (std::size_t cell = 0; cell < pairs.size(); ++cell)
    for (std::size_t i = 0; i < pairs[cell].partners.size(); ++i)
    {
      ++n_pairs;
      const auto [outer, inner] = repeated.first().at(pairs[cell].same.at(i));
      const auto a = mesh.polygon(cell), b = mesh.polygon(pairs[cell].partners[i]),
                 c = mesh.polygon(outer), d = mesh.polygon(inner);
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int w = 0; w < 3; ++w)
        {
          EXPECT_LT(((a[v] - b[w]) - (c[v] - d[w])).norm(), 1e-9 * h);
          EXPECT_LT(((a[v] - a[w]) - (c[v] - c[w])).norm(), 1e-9 * h);
        }
    }
  EXPECT_LT(4 * repeated.first().size(), n_pairs);

  const Mesh moved = triangles(h, horizon, .2);
  auto single = pairs_of(moved);
  EXPECT_TRUE(reference::RepeatedPairs(moved, pairs_of(moved), single).first().empty());
  for (const auto &own : single)
    EXPECT_TRUE(own.same.empty());
}

TEST(RepeatedPairs, MakeTheMatrixOfAllPairs)
{
  const double h = .125;
  for (const Powers &powers : profiles)
    for (const unsigned int degree : {0u, 1u, 2u})
    {
      const auto kernel = kernel_of(powers, 3 * h);
      const auto jumps = coefficient_of("x > .5 ? 3 : 1", physics::Mean::harmonic);
      const Assembled system = assemble(triangles(h, 3 * h, 0), kernel, false, degree, jumps);
      const auto check =
          reference::check_entries(*system.space, kernel, jumps, system.matrix.rows, 60, 2);
      EXPECT_GE(check.n_entries, 60u);
      EXPECT_LT(check.worst_difference, rounding(powers, degree));
      EXPECT_LT(worst_row(system, [](const auto &) { return 1.; }), rounding(powers, degree));
    }
}
