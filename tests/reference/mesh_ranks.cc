// Run on 1, 2 and 4 ranks: the solution on all of them is the solution on each one alone.
#include "algebra/distributed_matrix.h"
#include "analysis/statics.h"
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/cell_order.h"
#include "reference/mesh/edge_assembly.h"
#include "reference/method.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace plumbline;

  scene::Scene make_scene(const std::string &mesh, const std::string &kernel,
                          const std::string &solution, const std::string &solver)
  {
    return scene::parse_scene(
        "test.prm", "subsection Domain\n set mesh = " + mesh + "\nend\nsubsection Kernel\n" +
                        kernel + "end\nsubsection Problem\n set solution = " + solution +
                        "\nend\nsubsection Methods\n set names = P1\nend\n"
                        "subsection Quadrature\n set tolerance = 0\nend\n"
                        "subsection Solver\n set tolerance = 1e-14\n"
                        " set linear solver = " +
                        solver + "\nend\n");
  }

  std::shared_ptr<const method::Method> method_named(const std::string &name)
  {
    for (const auto &one : reference::methods())
      if (one->name() == name)
        return one;
    throw std::logic_error(name);
  }
} // namespace

TEST(Ranks, FindTheSolutionThatOneOfThemFindsAlone)
{
  const std::string scalar = " set type = linear-decay\n";
  const std::string tensor = " set type = bond-tensor\n set limit = Navier\n";
  for (const std::string mesh : {"triangles", "squares"})
    for (const bool is_tensor : {false, true})
      for (const std::string solver : {"amg", "direct"})
      {
        const auto scene =
            make_scene(mesh, is_tensor ? tensor : scalar,
                       is_tensor ? "sin(3*x)*cos(2*y), x*y" : "sin(3*x)*cos(2*y)", solver);
        const auto problem = make_problem(scene, 0, {.2, .3});
        const std::string cell = mesh == "squares" ? "Q" : "P";
        for (const std::string &name : {cell + "1", "DG" + cell + "2"})
        {
          const auto together =
              analysis::solve(*method_named(name), problem, base::Communicator::all());
          const auto alone =
              analysis::solve(*method_named(name), problem, base::Communicator::alone());
          ASSERT_EQ(together.nodal.size(), alone.nodal.size());
          double difference = 0;
          for (std::size_t i = 0; i < alone.nodal.size(); ++i)
            difference = std::max(difference, std::abs(together.nodal[i] - alone.nodal[i]));
          EXPECT_LT(difference, 1e-12) << mesh << ", " << name << ", " << solver;
          EXPECT_EQ(together.cost.n_bonds, alone.cost.n_bonds);
        }
      }
}

namespace
{
  /// A lattice's triangles, in the order of the lattice or, as files may have them, in any other.
  std::shared_ptr<const geometry::Mesh> unit_square(double h, double horizon, bool is_shuffled)
  {
    geometry::Mesh mesh = geometry::lattice_mesh(
        {{{dealii::Point<2>(0, 0), dealii::Point<2>(1, 1)}}, {}}, h, horizon, true);
    std::mt19937 random(1);
    for (std::size_t i = mesh.cells.size(); i > 1 && is_shuffled; --i)
      std::swap(mesh.cells[i - 1], mesh.cells[random() % i]);
    return std::make_shared<const geometry::Mesh>(std::move(mesh));
  }

  /// This rank's rows of a sum are those of the whole matrix.
  void expect_rows(const algebra::CsrMatrix &own, const algebra::CsrMatrix &alone)
  {
    const base::Communicator all = base::Communicator::all();
    const algebra::OwnedRanges ranges(alone.n_rows(), 1, all);
    const algebra::CsrMatrix sum = algebra::sum_own_rows(own, ranges);
    EXPECT_EQ(all.sum(static_cast<double>(sum.value.size())),
              static_cast<double>(alone.value.size()));
    double worst = 0, largest = 0;
    for (std::size_t row = 0; row < alone.n_rows(); ++row)
    {
      const std::size_t n = sum.start[row + 1] - sum.start[row];
      const bool is_own = row - ranges.own_first < ranges.own_size;
      ASSERT_EQ(n, is_own ? alone.start[row + 1] - alone.start[row] : 0) << row;
      for (std::size_t k = 0; k < n; ++k)
      {
        const std::size_t at = sum.start[row] + k, of_alone = alone.start[row] + k;
        ASSERT_EQ(sum.column[at], alone.column[of_alone]);
        worst = std::max(worst, std::abs(sum.value[at] - alone.value[of_alone]));
        largest = std::max(largest, std::abs(alone.value[of_alone]));
      }
    }
    EXPECT_LT(worst, 1e-13 * largest);
  }
} // namespace

TEST(Ranks, SharePairsOfSidesOfWhichEachIsIntegratedOnce)
{
  const double h = 1. / 24, horizon = 4 * h;
  const auto kernel = physics::Kernel<2>::with_diffusion(
      physics::RadialProfile::Powers{{1, 0}, {-1, 1}}, horizon, 1);
  const base::Communicator all = base::Communicator::all();
  for (const bool is_shuffled : {false, true})
  {
    SCOPED_TRACE(is_shuffled);
    const auto mesh = unit_square(h, horizon, is_shuffled);
    const auto order = reference::order_for_ranks(*mesh, all.n_ranks());
    EXPECT_EQ(order.empty(), all.n_ranks() == 1 || !is_shuffled);
    const reference::MeshSpace space(mesh, true, 1, {}, order);
    ASSERT_EQ(reference::refuse_edges(space, kernel), "");
    std::uint64_t n_own = 0, n_alone = 0;
    const auto own = reference::assemble_by_edges(space, kernel, all, &n_own);
    const auto alone =
        reference::assemble_by_edges(space, kernel, base::Communicator::alone(), &n_alone);
    EXPECT_GT(n_alone, 100000u);
    // none twice, none by nobody, and nobody has much more than a share
    EXPECT_EQ(all.sum(static_cast<double>(n_own)), static_cast<double>(n_alone));
    const double n_ranks = all.n_ranks();
    EXPECT_LT(static_cast<double>(n_own), 1.4 * static_cast<double>(n_alone) / n_ranks);
    // Of the unit square it has entries of a slab, with one layer of cells more at either end, and
    // half of those in a layer that the supports of its functions reach: δ + 2 h. Squares of four
    // ranks have four sides of half the length.
    const auto n_entries = static_cast<double>(alone.value.size());
    const double halo = all.n_ranks() == 1 ? 0 : horizon + 4 * h;
    EXPECT_LE(static_cast<double>(own.value.size()), (1 / n_ranks + halo) * n_entries);
    expect_rows(own, alone);
  }
}

TEST(Ranks, ShareCellsThatLieTogether)
{
  const double h = 1. / 16, horizon = 2.5 * h;
  const auto kernel = physics::Kernel<2>::with_diffusion(
      physics::RadialProfile::Powers{{1, 0}, {-1, 1}}, horizon, 1);
  const base::Communicator all = base::Communicator::all();
  for (const bool is_shuffled : {false, true})
  {
    SCOPED_TRACE(is_shuffled);
    const auto mesh = unit_square(h, horizon, is_shuffled);
    const reference::MeshSpace space(mesh, false, 1, {},
                                     reference::order_for_ranks(*mesh, all.n_ranks()));
    const reference::MeshCells cells(*mesh);
    const auto make = [&](const base::Communicator &ranks)
    { return reference::assemble(space, cells, kernel, {}, {}, ranks).rows; };
    const auto own = make(all), alone = make(base::Communicator::alone());
    const double halo = all.n_ranks() == 1 ? 0 : horizon + 2 * h;
    EXPECT_LE(static_cast<double>(own.value.size()),
              (1. / all.n_ranks() + halo) * static_cast<double>(alone.value.size()));
    expect_rows(own, alone);
  }
}
