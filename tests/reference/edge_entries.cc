// Galerkin matrices of continuous piecewise linears by pairs of sides, against identities that only
// exact entries satisfy, and against quadrature, which has nothing in common with them.
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/edge_assembly.h"
#include "reference/mesh/entry_check.h"

#include <gtest/gtest.h>

#include <deal.II/base/multithread_info.h>

#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::Point;
  using reference::MeshSpace;

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  physics::Kernel<2> kernel_of(physics::RadialProfile::Powers powers, double horizon)
  {
    return physics::Kernel<2>::with_diffusion(std::move(powers), horizon, 1);
  }
  physics::Kernel<2> constant(double horizon)
  {
    return kernel_of({{1, 0}}, horizon);
  }
  physics::Kernel<2> tensor(physics::RadialProfile::Powers powers, double horizon)
  {
    return physics::Kernel<2>::with_bulk_modulus(std::move(powers), horizon, 1);
  }
  std::vector<physics::Kernel<2>> kernels(double horizon)
  {
    return {constant(horizon),
            kernel_of({{1, 0}, {-1, 1}}, horizon),
            kernel_of({{1, -1}}, horizon),
            kernel_of({{1, 0}, {-1, 2}}, horizon),
            tensor({{1, -1}}, horizon),
            tensor({{1, 0}, {-1, 1}}, horizon),
            tensor({{1, 2}}, horizon)};
  }

  /// Kernels whose profile is a function, or has a break.
  std::vector<physics::Kernel<2>> functions(double horizon)
  {
    using physics::RadialProfile;
    const auto gaussian =
        RadialProfile::smooth([](double t) { return std::exp(-4 * t * t); }, true);
    const auto exponential =
        RadialProfile::smooth([](double t) { return std::exp(-2 * t); }, false);
    const auto table = RadialProfile::table({{0, 2}, {.6, 1}, {1, .2}});
    return {physics::Kernel<2>::with_diffusion(gaussian, horizon, 1),
            physics::Kernel<2>::with_diffusion(exponential, horizon, 1),
            physics::Kernel<2>::with_diffusion(table, horizon, 1),
            physics::Kernel<2>::with_bulk_modulus(exponential, horizon, 1),
            physics::Kernel<2>::with_bulk_modulus(table, horizon, 1)};
  }

  /// Triangles on a lattice, the vertices of Ω moved by up to a part of h.
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

  struct Assembled
  {
    std::shared_ptr<const MeshSpace> space;
    reference::MeshMatrix matrix;
    unsigned int n_components;

    /// By unknowns.
    double entry(std::size_t i, std::size_t j) const
    {
      const auto &rows = matrix.rows;
      const auto first = rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i]),
                 last = rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i + 1]);
      const auto at = std::lower_bound(first, last, j);
      return at == last || *at != j
                 ? 0
                 : rows.value[static_cast<std::size_t>(at - rows.column.begin())];
    }

    const Point<2> &support(std::size_t unknown) const
    {
      return space->support(static_cast<unsigned int>(unknown / n_components));
    }
  };

  Assembled assemble(const Mesh &mesh, const physics::Kernel<2> &kernel, bool exact = true,
                     unsigned int refinement = 0, bool is_continuous = true)
  {
    auto space =
        std::make_shared<const MeshSpace>(std::make_shared<const Mesh>(mesh), is_continuous, 1);
    const reference::MeshCells cells(mesh);
    return {space,
            reference::assemble(*space, cells, kernel, {},
                                {refinement, exact, geometry::Backend::fast},
                                base::Communicator::alone()),
            kernel.n_components()};
  }

  using Offset = dealii::Tensor<1, 2>;

  /// The largest |Σ_j A_ij u(x_j - x_i) - expected| over the rows, in units of the diagonal; of
  /// vector fields u in each component alone.
  double worst_row(
      const Assembled &system, const std::function<double(const Offset &)> &u,
      const std::function<double(unsigned int a, unsigned int b)> &expected =
          [](unsigned int, unsigned int) { return 0.; })
  {
    double worst = 0;
    const auto &rows = system.matrix.rows;
    const unsigned int nc = system.n_components;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      std::vector<double> sum(nc);
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        sum[rows.column[k] % nc] +=
            rows.value[k] * u(system.support(rows.column[k]) - system.support(i));
      for (unsigned int b = 0; b < nc; ++b)
        worst = std::max(worst, std::abs(sum[b] - expected(i % nc, b)) / system.entry(i, i));
    }
    return worst;
  }

  /// The same of quadratic fields on a lattice: A(x² e_b) = -∫C_ab ξ² ∫φ, which is -2 h² of scalar
  /// kernels, whatever the horizon.
  double worst_quadratic(const Assembled &system, const physics::Kernel<2> &kernel, double h)
  {
    double worst = 0;
    for (const std::array<int, 2> power : {std::array<int, 2>{2, 0}, {1, 1}, {0, 2}})
      worst = std::max(worst, worst_row(
                                  system,
                                  [&](const Offset &x)
                                  { return std::pow(x[0], power[0]) * std::pow(x[1], power[1]); },
                                  [&](unsigned int a, unsigned int b)
                                  { return -h * h * kernel.moment(power, a, b); }));
    return worst;
  }

  double largest_difference(const Assembled &a, const Assembled &b)
  {
    double largest = 0, diagonal = 0;
    for (std::size_t i = 0; i < a.matrix.rows.n_rows(); ++i)
    {
      diagonal = std::max(diagonal, a.entry(i, i));
      for (std::size_t j = 0; j < a.space->n_dofs() * a.n_components; ++j)
        largest = std::max(largest, std::abs(a.entry(i, j) - b.entry(i, j)));
    }
    return largest / diagonal;
  }

  /// Rounding in units of the diagonal: terms are larger than their sum where supports nearly
  /// touch, in terms of δ.
  double rounding(double m)
  {
    return m < 3 ? 4e-13 : 1e-13;
  }

  /// A field of slope 1 / δ.
  std::function<double(const Offset &)> linear(double horizon)
  {
    return [horizon](const Offset &x) { return (x[0] - 2 * x[1]) / (std::sqrt(5.) * horizon); };
  }

  /// Of m horizons, h the mean size: moved at random; with sides that grow from 2/3 h to 4/3 h;
  /// with a hole, moved.
  std::vector<std::pair<std::string, Mesh>> meshes(double h, double m)
  {
    const auto graded = [](const Point<2> &x)
    {
      Point<2> y = x;
      for (unsigned int d = 0; d < 2; ++d)
        if (x[d] > 0 && x[d] < 1)
          y[d] += std::sin(2 * M_PI * x[d]) / (6 * M_PI);
      return y;
    };
    geometry::Domain with_hole = unit_square;
    with_hole.exclude = {{Point<2>(.375, .375), Point<2>(.625, .625)}};
    Mesh hole = geometry::lattice_mesh(with_hole, h, m * h, true);
    std::mt19937 random(7);
    for (auto &vertex : hole.vertices)
    {
      const double outside = std::max({std::abs(vertex[0] - .5), std::abs(vertex[1] - .5)});
      if (outside < .5 - 1e-9 && outside > .125 + 1e-9)
        for (unsigned int d = 0; d < 2; ++d)
          vertex[d] += .2 * h * (2. * random() / random.max() - 1);
    }
    return {{"moved", triangles(h, m * h, .2)},
            {"graded", geometry::lattice_mesh(unit_square, h, m * h, true, graded)},
            {"with a hole", hole}};
  }
} // namespace

TEST(EdgeEntries, ReproduceQuadraticFieldsOnLattices)
{
  const double h = .125;
  for (const double m : {2., 3.7, 6.})
    for (const auto &kernel : kernels(m * h))
    {
      const Assembled system = assemble(triangles(h, m * h, 0), kernel);
      ASSERT_TRUE(system.matrix.is_exact) << system.matrix.way;
      const double allowed = rounding(m);
      EXPECT_LT(worst_row(system, [](const Offset &) { return 1.; }), allowed);
      EXPECT_LT(worst_row(system, linear(m * h)), allowed);
      EXPECT_LT(worst_quadratic(system, kernel, h), allowed);
    }
}

TEST(EdgeEntries, OfMovedTrianglesAreSymmetricToTheLastBitAndReproduceLinearFields)
{
  const double h = .125;
  for (const double m : {2., 3., 4.5, 8.})
    for (const auto &kernel : kernels(m * h))
    {
      const Assembled system = assemble(triangles(h, m * h, .2), kernel);
      ASSERT_TRUE(system.matrix.is_exact) << system.matrix.way;
      const double allowed = rounding(m);
      EXPECT_LT(worst_row(system, [](const Offset &) { return 1.; }), allowed) << m;
      EXPECT_LT(worst_row(system, linear(m * h)), allowed);
      for (unsigned int i = 0; i < system.matrix.rows.n_rows(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          ASSERT_EQ(system.entry(i, j), system.entry(j, i));
    }
}

TEST(EdgeEntries, AnnihilateLinearFieldsOnAnyMesh)
{
  const double h = .125;
  for (const double m : {3., 5., 8.})
    for (const auto &[name, mesh] : meshes(h, m))
      for (const auto &kernel : kernels(m * h))
      {
        const Assembled system = assemble(mesh, kernel);
        ASSERT_TRUE(system.matrix.is_exact) << system.matrix.way;
        EXPECT_LT(worst_row(system, linear(m * h)), 1e-13)
            << name << " m = " << m << " " << kernel.profile().lowest_exponent();
      }
}

TEST(EdgeEntries, OfDiscontinuousOnesAnnihilateLinearFieldsOnAnyMeshToo)
{
  const double h = .125;
  const auto check =
      [&](double m, const std::string &name, const Mesh &mesh, const physics::Kernel<2> &kernel)
  {
    const Assembled system = assemble(mesh, kernel, true, 0, false);
    ASSERT_TRUE(system.matrix.is_exact) << system.matrix.way;
    EXPECT_LT(worst_row(system, linear(m * h)), 1e-13) << name << " m = " << m;
  };
  for (const auto &[name, mesh] : meshes(h, 3))
    for (const auto &kernel : {kernel_of({{1, 0}, {-1, 1}}, 3 * h), kernel_of({{1, -1}}, 3 * h),
                               tensor({{1, -1}}, 3 * h)})
      check(3, name, mesh, kernel);
  for (const double m : {5., 8.}) // a singular kernel, which rounds off most
    check(m, "moved", triangles(2 * h, m * 2 * h, .2), kernel_of({{1, -1}}, m * 2 * h));
}

TEST(EdgeEntries, OfARefinedMeshAddUpToThoseOfTheCoarseOne)
{
  // coarse shape functions are sums of fine ones: A = Pᵀ A_fine P
  const double h = .25;
  for (const double m : {2., 3.3})
    for (const auto &kernel : kernels(m * h))
    {
      const Mesh mesh = triangles(h, m * h, .2);
      const Assembled coarse = assemble(mesh, kernel), fine = assemble(refine(mesh), kernel);
      ASSERT_TRUE(coarse.matrix.is_exact && fine.matrix.is_exact);
      // a fine node is a coarse one or the middle of two that share a side
      std::vector<std::map<unsigned int, double>> parents(fine.space->n_dofs());
      const auto &cells = coarse.space->mesh().cells;
      const auto at = [&](const Point<2> &x)
      {
        for (unsigned int dof = 0; dof < fine.space->n_dofs(); ++dof)
          if (fine.space->support(dof).distance(x) < 1e-12)
            return dof;
        ADD_FAILURE() << "no node at " << x;
        return 0u;
      };
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
        for (unsigned int k = 0; k < 3; ++k)
        {
          const unsigned int a = coarse.space->dofs(cell)[k],
                             b = coarse.space->dofs(cell)[(k + 1) % 3];
          const Point<2> &x = coarse.space->support(a), &y = coarse.space->support(b);
          parents[at(x)] = {{a, 1.}};
          parents[at(x + .5 * (y - x))] = {{a, .5}, {b, .5}};
        }
      std::map<std::pair<unsigned int, unsigned int>, double> sum;
      const unsigned int nc = kernel.n_components();
      const auto &rows = fine.matrix.rows;
      for (unsigned int i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          for (const auto &[from, p] : parents[i / nc])
            for (const auto &[to, q] : parents[rows.column[k] / nc])
              sum[{from * nc + i % nc, to * nc + rows.column[k] % nc}] += p * q * rows.value[k];
      double worst = 0, diagonal = 0;
      for (unsigned int i = 0; i < coarse.matrix.rows.n_rows(); ++i)
        for (unsigned int j = 0; j < coarse.space->n_dofs() * nc; ++j)
        {
          const double entry = coarse.entry(i, j);
          diagonal = std::max(diagonal, entry);
          worst = std::max(worst, std::abs(entry - sum[{i, j}]));
        }
      EXPECT_LT(worst, 2e-13 * diagonal) << m;
    }
}

TEST(EdgeEntries, AreWhatRefinedQuadratureApproachesAndCorrelationsGive)
{
  const double h = .25;
  const Mesh mesh = triangles(h, 3 * h, .2);
  for (const auto &kernel : kernels(3 * h))
  {
    const Assembled exact = assemble(mesh, kernel);
    const auto check =
        reference::check_entries(*exact.space, kernel, {}, exact.matrix.rows, 100, 4);
    EXPECT_GE(check.n_pairs, 100u);
    EXPECT_LT(check.worst_difference, 1e-13);
    if (kernel.n_components() > 1) // quadrature costs three times as much
      continue;
    const auto error = [&](unsigned int refinement)
    { return largest_difference(exact, assemble(mesh, kernel, false, refinement)); };
    const double coarse = error(1), fine = error(4);
    EXPECT_LT(fine, 5e-7);
    EXPECT_GT(coarse, 10 * fine);
  }
}

TEST(EdgeEntries, OfFunctionsAndTablesAreExactToo)
{
  const double h = .125;
  for (const double m : {4., 6.5})
    for (const double part : {0., .2})
      for (const auto &kernel : functions(m * h))
      {
        const Assembled system = assemble(triangles(h, m * h, part), kernel);
        ASSERT_TRUE(system.matrix.is_exact) << system.matrix.way;
        const double allowed = 1e-13;
        EXPECT_LT(worst_row(system, [](const Offset &) { return 1.; }), 2 * allowed);
        EXPECT_LT(worst_row(system, linear(m * h)), allowed);
        if (part == 0)
        {
          EXPECT_LT(worst_quadratic(system, kernel, h), 2 * allowed);
        }
        for (unsigned int i = 0; i < system.matrix.rows.n_rows(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            ASSERT_EQ(system.entry(i, j), system.entry(j, i));
      }
  const Mesh mesh = triangles(.25, 1, .2);
  for (const auto &kernel : functions(1))
  {
    const Assembled exact = assemble(mesh, kernel);
    const double coarse = largest_difference(exact, assemble(mesh, kernel, false, 0)),
                 fine = largest_difference(exact, assemble(mesh, kernel, false, 2));
    EXPECT_LT(fine, 2e-5);
    EXPECT_GT(coarse, 10 * fine);
  }
}

TEST(EdgeEntries, DoNotDependOnTheNumberOfThreads)
{
  const Mesh mesh = triangles(.125, .5, .2);
  const Assembled several = assemble(mesh, constant(.5));
  dealii::MultithreadInfo::set_thread_limit(1);
  const Assembled one = assemble(mesh, constant(.5));
  dealii::MultithreadInfo::set_thread_limit();
  EXPECT_EQ(several.matrix.rows.value, one.matrix.rows.value);
}

TEST(EdgeEntries, AreRefusedWhereTheFormDoesNotHold)
{
  const auto reason =
      [](const Mesh &mesh, const physics::Kernel<2> &kernel, unsigned int degree = 1)
  {
    const MeshSpace space(std::make_shared<const Mesh>(mesh), true, degree);
    return reference::refuse_edges(space, kernel);
  };
  const double h = .125;
  const Mesh mesh = triangles(h, 4 * h, 0);
  EXPECT_EQ(reason(mesh, constant(4 * h)), "");
  EXPECT_EQ(reason(mesh, constant(4 * h), 2), "the degree is not 1");
  EXPECT_EQ(reason(mesh, tensor({{1, -1}}, 4 * h)), "");
  for (const auto &kernel : functions(4 * h))
    EXPECT_EQ(reason(mesh, kernel), "");
  const auto scalar = [&](physics::RadialProfile profile)
  { return physics::Kernel<2>::with_diffusion(std::move(profile), 4 * h, 1); };
  std::vector<std::array<double, 2>> rows;
  for (unsigned int i = 0; i < 10; ++i)
    rows.push_back({i / 9., std::cos(i)});
  EXPECT_EQ(reason(mesh, scalar(physics::RadialProfile::table(rows))),
            "the kernel's profile has more than 7 breaks");
  EXPECT_EQ(reason(mesh, scalar(physics::RadialProfile::table({{0, 2}, {.2, 1}, {1, .2}}))),
            "triangles are large in relation to the horizon");
  // too narrow for a table of its potential, for powers, for powers that do not cancel
  for (const auto &[rate, is_even] : {std::pair(400., true), {20., false}, {12., false}})
    EXPECT_EQ(reason(mesh, scalar(physics::RadialProfile::smooth(
                               [rate = rate, is_even = is_even](double t)
                               { return std::exp(-rate * (is_even ? t * t : t)); },
                               is_even))),
              "the kernel varies fast in relation to the horizon");
  EXPECT_EQ(reason(mesh, constant(4.5 * h)), "balls reach beyond the mesh");
  EXPECT_EQ(reason(triangles(h, 1.2 * h, 0), constant(1.2 * h)),
            "triangles are large in relation to the horizon");
  Mesh body = mesh;
  for (auto &cell : body.cells)
    cell.is_inside = true;
  EXPECT_EQ(reason(body, constant(4 * h)), "balls reach beyond the mesh");
  Mesh flat = mesh;
  for (auto &vertex : flat.vertices)
    vertex[1] *= .02;
  EXPECT_EQ(reason(flat, constant(.01 * h)),
            "some triangle is more than 30 times longer than high");
  const Assembled system = assemble(body, constant(4 * h)); // by pairs of triangles instead
  EXPECT_TRUE(system.matrix.is_exact);
  EXPECT_EQ(system.matrix.way, "exact by sides of pairs of triangles");
}
