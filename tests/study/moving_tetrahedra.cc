// Motions by Galerkin methods on tetrahedra.
#include "geometry/tetrahedral_domain.h"
#include "reference/tetrahedra/field.h"
#include "reference/tetrahedra/mass.h"
#include "study/transient.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;

  const Settings moving = {{"Time/final time", "0.5"},
                           {"Methods/names", "P1"},
                           {"Methods/perturbation", "0.2"},
                           {"Domain/boxes", "0,0,0 : 3/4,3/4,3/4"},
                           {"Study/m", "1"},
                           {"Study/h", "1/4"},
                           {"Study/norms", "nodal Linf, nodal L2"},
                           {"Study/decisive error", "nodal L2 | exact"}};
  const Settings bond_based = {{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}};
  const Settings state_based = {{"Kernel/type", "1/r"},
                                {"Kernel/limit", "Navier"},
                                {"Material/model", "LPS"},
                                {"Material/E", "1"},
                                {"Material/nu", "0.35"}};

  std::vector<Record> motions(const Settings &settings)
  {
    const scene::Scene scene = make_scene(with(moving, settings));
    const Methods methods = choose_methods(scene, available());
    check_transient(scene, methods, 0);
    std::vector<Record> records = run_study(transient_analysis({}), scene, methods).records;
    for (const Record &record : records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return records;
  }
} // namespace

TEST(MovingTetrahedra, have_the_masses_of_their_cells)
{
  const geometry::CubeLattice lattice({{{dealii::Point<3>(), dealii::Point<3>(1, 1, 1)}}, {}}, .25);
  const auto mesh = std::make_shared<const geometry::TetrahedralMesh>(
      geometry::with_moved_vertices(geometry::six_per_cube(lattice, 1), .05, 3));
  const auto linear = [](const dealii::Point<3> &x) { return 1 + x[0] - 2 * x[1] + 3 * x[2]; };
  for (const bool is_continuous : {true, false})
  {
    const reference::TetrahedralSpace space(mesh, is_continuous);
    const auto rows = reference::mass_rows(space, 1);
    // ∫ of a linear function that the space has, or nearly has, times φ_i
    const auto tested = reference::tested_load(
        problem::Field<3>{[&](const dealii::Point<3> &x, unsigned int) { return linear(x); }},
        space);
    ASSERT_EQ(rows.n_rows(), space.n_free());
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
    {
      double sum = 0;
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        sum += rows.value[k] * linear(space.support(rows.column[k]));
      EXPECT_NEAR(sum, tested[row], 1e-15);
    }
  }
}

TEST(MovingTetrahedra, hold_fields_that_are_linear_in_space)
{
  for (const Settings &solid : {Settings{}, bond_based, state_based})
  {
    const bool is_scalar = solid.empty();
    const auto records = motions(with(
        with(solid, {{"Methods/perturbation", solid.size() == state_based.size() ? "0" : "0.2"}}),
        {{"Problem/solution",
          is_scalar ? "(1 + x)*sin(2*t) + y - z*t^2" : "x*sin(2*t) + z, y - t*x, (1 + x)*t^2 - y"},
         {"Time/density", "1.7"},
         {"Time/damping", "0.6"},
         {"Time/schemes", "Runge-Kutta"}}));
    ASSERT_FALSE(records.empty());
    for (const Record &record : records)
    {
      EXPECT_LT(record["nodal L2 | exact"], 1e-9) << record.key.label();
      EXPECT_LT(record["velocity nodal L2 | exact"], 1e-8) << record.key.label();
    }
  }
}

TEST(MovingTetrahedra, with_lumped_masses_hold_them_on_lattices_alone)
{
  const auto error = [](const std::string &perturbation)
  {
    return motions({{"Methods/perturbation", perturbation},
                    {"Time/mass", "lumped"},
                    {"Problem/solution", "(1 + x)*sin(2*t) + y - z*t^2"},
                    {"Time/schemes", "Runge-Kutta"}})
        .front()["nodal L2 | exact"];
  };
  EXPECT_LT(error("0"), 1e-9);
  EXPECT_GT(error("0.2"), 1e-6);
}

TEST(MovingTetrahedra, keep_their_energy_to_second_order_in_time)
{
  const auto records = motions(with(
      bond_based, {{"Problem/solution", ""},
                   {"Problem/load", "0, 0, 0"},
                   {"Problem/constraint", "0, 0, 0"},
                   {"Problem/local solution", "none"},
                   {"Time/initial displacement", "sin(4*pi*x/3)*sin(4*pi*y/3)*sin(4*pi*z/3), 0, 0"},
                   {"Time/final time", "5"},
                   {"Time/critical fractions", "0.5, 0.25"}}));
  ASSERT_EQ(records.size(), 2u);
  std::array<double, 2> swing{};
  for (unsigned int k = 0; k < 2; ++k)
  {
    EXPECT_EQ(records[k]["symmetric"], 1);
    const std::vector<analysis::Energies> energies = energies_of(records[k]);
    for (const analysis::Energies &now : energies)
      swing[k] = std::max(swing[k], std::abs(now.stored() / energies[0].stored() - 1));
  }
  EXPECT_LT(swing[0], .1);
  EXPECT_NEAR(swing[0] / swing[1], 4, 1);
}
