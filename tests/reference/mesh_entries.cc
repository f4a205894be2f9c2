// Galerkin matrices on meshes against stored matrices, lattice entries and exact identities.
#include "geometry/mesh_input.h"
#include "reference/lattice_stencil.h"
#include "reference/mesh_assembly.h"

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
  using reference::MeshSpace;

  using Matrix = std::map<std::pair<std::size_t, std::size_t>, double>;

  std::istringstream without_comments(const std::string &name)
  {
    std::ifstream file(std::string(PLUMBLINE_TEST_DATA) + "/galerkin_entries/" + name);
    EXPECT_TRUE(file.good()) << name;
    std::string text;
    for (std::string line; std::getline(file, line);)
      if (line.empty() || line[0] != '#')
        text += line + "\n";
    return std::istringstream(text);
  }

  Mesh stored_mesh(const std::string &name)
  {
    auto file = without_comments(name);
    std::string word;
    std::size_t n, index;
    int label;
    Mesh mesh;
    file >> word >> n;
    mesh.vertices.resize(n);
    for (auto &vertex : mesh.vertices)
      file >> index >> vertex[0] >> vertex[1] >> label;
    file >> word >> n;
    mesh.cells.resize(n, {{}, 3, true});
    for (auto &cell : mesh.cells)
      file >> index >> cell.vertex[0] >> cell.vertex[1] >> cell.vertex[2] >> label;
    return mesh;
  }

  struct Assembled
  {
    std::shared_ptr<const MeshSpace> space;
    reference::MeshMatrix matrix;
  };

  Assembled assemble(const Mesh &mesh, const physics::Kernel<2> &kernel, bool is_continuous,
                     unsigned int degree, unsigned int refinement, bool exact_rectangles = true,
                     const std::optional<physics::Coefficient> &coefficient = {})
  {
    const auto shared = std::make_shared<const Mesh>(mesh);
    auto space = std::make_shared<const MeshSpace>(shared, is_continuous, degree);
    const reference::MeshCells cells(mesh);
    return {space, reference::assemble(*space, cells, kernel, coefficient,
                                       {refinement, exact_rectangles, geometry::Backend::fast},
                                       base::Team::alone())};
  }

  Matrix entries(const algebra::Rows &rows)
  {
    Matrix matrix;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        matrix[{i, rows.column[k]}] = rows.value[k];
    return matrix;
  }

  double frobenius_difference(const Matrix &a, const Matrix &b)
  {
    double difference = 0, size = 0;
    for (const auto &[place, value] : b)
    {
      const auto other = a.find(place);
      difference += std::pow(value - (other == a.end() ? 0 : other->second), 2);
      size += value * value;
    }
    for (const auto &[place, value] : a)
      if (b.count(place) == 0)
        difference += value * value;
    return std::sqrt(difference / size);
  }

  double against_stored(const std::string &name, unsigned int refinement)
  {
    const Mesh mesh = stored_mesh(name + ".mesh.txt");
    // ∬ without ½ and c = 4 / (π δ⁴): with ½, twice the kernel, whose limit is -Δ
    const auto kernel =
        physics::Kernel<2>::with_diffusion(physics::kernel_type("constant").profile, .3, 1);
    const Assembled ours = assemble(mesh, kernel, true, 1, refinement);
    std::vector<std::size_t> vertex(ours.space->n_dofs());
    for (std::size_t dof = 0; dof < vertex.size(); ++dof)
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        if (mesh.vertices[v].distance(ours.space->support(dof)) < 1e-12)
          vertex[dof] = v;
    Matrix matrix, stored;
    for (const auto &[place, value] : entries(ours.matrix.rows))
      matrix[{vertex[place.first], vertex[place.second]}] = value;
    auto file = without_comments(name + ".exact_constant_p1.coo.txt");
    std::size_t n_rows, n_columns, n, i, j;
    double value;
    file >> n_rows >> n_columns >> n;
    while (file >> i >> j >> value)
      stored[{i, j}] = value;
    EXPECT_EQ(stored.size(), n);
    return frobenius_difference(matrix, stored);
  }

  const physics::Kernel<2> linear_decay(double horizon)
  {
    return physics::Kernel<2>::with_diffusion(physics::kernel_type("linear-decay").profile, horizon,
                                              .5);
  }
  const physics::Kernel<2> bond_tensor(double horizon)
  {
    return physics::Kernel<2>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile,
                                                 horizon, 1);
  }
  const physics::Kernel<2> constant(double horizon)
  {
    return physics::Kernel<2>::with_diffusion(physics::kernel_type("constant").profile, horizon,
                                              .5);
  }

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  /// A u for nodal values of a function at all dofs, in units of the largest |A_ij u_j| of the row.
  double largest_row(const Assembled &system, unsigned int n_components,
                     const std::function<double(const Point<2> &, unsigned int)> &u,
                     double margin = 0)
  {
    double largest = 0;
    const algebra::Rows &rows = system.matrix.rows;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0, size = 0;
      const Point<2> &x = system.space->support(i / n_components);
      if (std::min({x[0], x[1], 1 - x[0], 1 - x[1]}) < margin)
        continue;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const double term = rows.value[k] * u(system.space->support(rows.column[k] / n_components),
                                              rows.column[k] % n_components);
        sum += term;
        size = std::max(size, std::abs(term));
      }
      largest = std::max(largest, std::abs(sum) / size);
    }
    return largest;
  }
} // namespace

TEST(MeshEntries, AgreeWithStoredMatricesAndConverge)
{
  for (const std::string name : {"diag4", "perturbed4"})
  {
    const double coarse = against_stored(name, 1), fine = against_stored(name, 6);
    EXPECT_LT(fine, 1e-6) << name;
    EXPECT_GT(coarse, 10 * fine) << name << ": refinement does nothing";
  }
}

TEST(MeshEntries, OfRectanglesAreThoseOfTheLattice)
{
  const double h = .25;
  for (const auto &kernel : {constant(.6), linear_decay(.75), linear_decay(.6), bond_tensor(.75)})
    for (const bool is_continuous : {true, false})
      for (const unsigned int degree : {0u, 1u, 2u, 3u})
      {
        if (is_continuous && degree == 0)
          continue;
        const unsigned int nc = kernel.n_components();
        const Mesh mesh = geometry::lattice_mesh(unit_square, h, kernel.horizon(), false);
        const Assembled ours = assemble(mesh, kernel, is_continuous, degree, 0);
        EXPECT_TRUE(ours.matrix.is_exact);
        const reference::AxisShapes shapes(is_continuous, degree);
        const auto stencil =
            reference::galerkin_stencil(kernel, h, shapes, geometry::Backend::fast);
        // place of a dof as block and offset: by its support point
        const auto locate = [&](std::size_t dof)
        {
          std::array<int, 4> place{}; // family and cell, x and y
          for (unsigned int d = 0; d < 2; ++d)
            for (unsigned int s = 0; s < shapes.families().size(); ++s)
            {
              const double cell = ours.space->support(dof)[d] / h - shapes.families()[s].offset;
              if (std::abs(cell - std::round(cell)) < 1e-9 && is_continuous)
                place[d] = static_cast<int>(s), place[2 + d] = static_cast<int>(std::lround(cell));
            }
          return place;
        };
        if (!is_continuous)
          continue; // discontinuous dofs share places: compared through solutions
        double worst = 0, largest = 0;
        const auto n_axis = static_cast<unsigned int>(shapes.families().size());
        for (const auto &[position, value] : entries(ours.matrix.rows))
        {
          const auto from = locate(position.first / nc), to = locate(position.second / nc);
          const unsigned int s =
              (position.first % nc) * n_axis * n_axis + from[0] + from[1] * n_axis;
          const unsigned int t = (position.second % nc) * n_axis * n_axis + to[0] + to[1] * n_axis;
          const int k1 = to[2] - from[2], k2 = to[3] - from[3];
          const double expected =
              std::max(std::abs(k1), std::abs(k2)) > stencil.reach() ? 0 : stencil(s, t, k1, k2);
          worst = std::max(worst, std::abs(value - expected));
          largest = std::max(largest, std::abs(expected));
        }
        EXPECT_LT(worst, 1e-12 * largest)
            << "degree " << degree << " horizon " << kernel.horizon() << " components " << nc;
      }
}

TEST(MeshEntries, ByRefinedQuadratureApproachTheExactOnes)
{
  // a kernel that jumps at the horizon, one that does not, and one that is singular at 0, whose
  // pairs of neighbouring cells converge more slowly
  struct Case
  {
    physics::Kernel<2> kernel;
    unsigned int refinement;
    double bound;
  };
  const geometry::Domain four_cells{{{Point<2>(0, 0), Point<2>(.5, .5)}}, {}};
  for (const auto &[kernel, refinement, bound] :
       {Case{constant(.3), 8, 1e-7}, Case{linear_decay(.3), 5, 1e-7},
        Case{bond_tensor(.3), 4, 2e-7}})
  {
    const Mesh mesh = geometry::lattice_mesh(four_cells, .25, kernel.horizon(), false);
    const auto by_quadrature = [&, &kernel = kernel](unsigned int n)
    { return entries(assemble(mesh, kernel, true, 1, n, false).matrix.rows); };
    const auto exact = entries(assemble(mesh, kernel, true, 1, 0).matrix.rows);
    EXPECT_GT(frobenius_difference(by_quadrature(0), exact), 1e-3);
    EXPECT_LT(frobenius_difference(by_quadrature(refinement), exact), bound);
  }
}

TEST(MeshEntries, GradedRectanglesReproduceLinearFieldsAndConstants)
{
  const auto map = [](const Point<2> &x)
  { return Point<2>(x[0] + .3 * x[0] * std::abs(x[0]), x[1] - .2 * x[1] * (1 - x[1])); };
  for (const auto &kernel : {linear_decay(.3), bond_tensor(.3), constant(.25)})
    for (const unsigned int degree : {1u, 2u})
    {
      const Mesh mesh = geometry::lattice_mesh(unit_square, .25, kernel.horizon(), false, map);
      const Assembled system = assemble(mesh, kernel, true, degree, 0);
      ASSERT_TRUE(system.matrix.is_exact);
      const unsigned int nc = kernel.n_components();
      const auto field = [&](double a, double b, double c)
      {
        return [=](const Point<2> &x, unsigned int i)
        { return a + b * x[0] + c * x[1] + (i == 1 ? 2 * b * x[1] : 0); };
      };
      EXPECT_LT(largest_row(system, nc, field(1, 0, 0)), 1e-13);
      EXPECT_LT(largest_row(system, nc, field(1, 1, -2)), 1e-12);
    }
}

TEST(MeshEntries, RowsAddUpToZeroOnAnyMeshForAnyOuterRule)
{
  std::mt19937 random(3);
  Mesh mesh = geometry::lattice_mesh(unit_square, .25, .3, true);
  for (auto &vertex : mesh.vertices)
    for (unsigned int d = 0; d < 2; ++d)
      vertex[d] += .05 * (2. * random() / random.max() - 1);
  const physics::Coefficient coefficient(physics::Expression("a", "1 + x^2 + .5*y"),
                                         physics::Mean::harmonic);
  for (const auto &kernel : {linear_decay(.3), bond_tensor(.3), constant(.2)})
    for (const unsigned int degree : {0u, 1u, 2u, 3u})
      for (const bool is_continuous : {true, false})
      {
        const auto system = assemble(mesh, kernel, is_continuous, degree, 0, true, coefficient);
        EXPECT_LT(largest_row(system, kernel.n_components(),
                              [](const Point<2> &, unsigned int) { return 1.; }),
                  2e-13);
      }
}

TEST(MeshEntries, OfUniformTrianglesReproduceLinearFields)
{
  // rows are alike and symmetric, so that the errors of outer points cancel; near the collar, whose
  // cells take no outer points, they are not
  const auto linear = [](const Point<2> &x, unsigned int c) { return c == 0 ? x[0] : x[1]; };
  for (const auto &kernel : {linear_decay(.3), bond_tensor(.3), constant(.25)})
  {
    const Mesh mesh = geometry::lattice_mesh(unit_square, .125, kernel.horizon(), true);
    const auto system = assemble(mesh, kernel, true, 1, 0);
    const double margin = kernel.horizon() + .125;
    EXPECT_LT(largest_row(system, kernel.n_components(), linear, margin), 1e-12);
    const auto refined = assemble(mesh, kernel, true, 1, 2);
    EXPECT_LT(largest_row(refined, kernel.n_components(), linear),
              .2 * largest_row(system, kernel.n_components(), linear));
  }
}

TEST(MeshEntries, DoNotDependOnTheNumberingOfCells)
{
  Mesh mesh = geometry::lattice_mesh(unit_square, .25, .3, true);
  const auto sorted = [&](const Mesh &m)
  {
    const auto system = assemble(m, linear_decay(.3), true, 1, 2);
    std::map<std::array<double, 4>, double> result;
    for (const auto &[place, value] : entries(system.matrix.rows))
    {
      const auto &x = system.space->support(place.first), &y = system.space->support(place.second);
      result[{x[0], x[1], y[0], y[1]}] = value;
    }
    return result;
  };
  const auto a = sorted(mesh);
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), std::mt19937(1));
  const auto b = sorted(mesh);
  ASSERT_EQ(a.size(), b.size());
  double difference = 0, size = 0;
  for (const auto &[place, value] : a)
  {
    difference += std::pow(value - b.at(place), 2);
    size += value * value;
  }
  EXPECT_LT(std::sqrt(difference / size), 1e-4); // outer points move to the other cell
}
