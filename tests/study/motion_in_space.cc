// Motions on boxes of cubes in space.
#include "meshfree/method.h"
#include "method/mass_root.h"
#include "reference/method.h"
#include "study/preflight.h"
#include "study/transient.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  const std::string cube = "0, 0, 0 : 1, 1, 1",
                    l_shape = "0, 0, 0 : 1, 1/2, 1; 0, 0, 0 : 1/2, 1, 1";

  /// Moves until t = 1/2, by schemes that are exact in time to 1e-12 where none is given.
  StudyResults run(const std::string &boxes, const std::string &solution,
                   const std::string &methods, const std::string &time = "",
                   const std::string &h = "1/4", const std::string &kernel = "")
  {
    const bool is_vector = solution.find(',') != std::string::npos;
    const scene::Scene scene = scene::parse_scene(
        "t.prm", "subsection Domain\n set dimension = 3\n set boxes = " + boxes +
                     "\nend\nsubsection Kernel\n set type = " +
                     (!kernel.empty() ? kernel
                      : is_vector     ? "bond-tensor\n set limit = Navier"
                                      : "linear-decay\n set limit = -Laplace") +
                     "\nend\nsubsection Problem\n set solution = " + solution +
                     "\nend\nsubsection Time\n set final time = 0.5\n" +
                     (time.empty() ? " set schemes = Runge-Kutta\n" : time) +
                     "end\nsubsection Methods\n set names = " + methods +
                     "\nend\nsubsection Study\n set regime = delta\n set m = 3\n set h = " + h +
                     "\n set norms = nodal Linf, nodal L2\n"
                     " set decisive error = nodal Linf | exact\nend\n");
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    const Methods chosen = choose_methods(scene, all);
    check_transient(scene, chosen, 0);
    StudyResults results = run_study(transient_analysis({}), scene, chosen);
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return results;
  }

  double error_of(const StudyResults &results, const std::string &what = "")
  {
    double worst = 0;
    for (const Record &record : results.records)
      worst = std::max(worst, record[what + "nodal Linf | exact"]);
    return worst;
  }
} // namespace

TEST(MotionInSpace, of_a_fourth_order_rule_is_exact_for_polynomials)
{
  constexpr double rounding = 1e-9; // series in time: u_tt of values that round
  const std::string scalar = "(x^3*y^2 + z^4 + x*y*z^2)*(1 + t^3)",
                    vector = "(x^3*y^2 + z^4)*(1 + t^3), y^2*z^3*t + x*z, x^2*y*z*t^2 + y^3";
  for (const auto &[boxes, solution] : {std::pair(cube, vector), {l_shape, scalar}})
  {
    const StudyResults results = run(boxes, solution, "IPA-AC-R4");
    EXPECT_LT(error_of(results), rounding) << boxes << ": " << solution;
    EXPECT_LT(error_of(results, "velocity "), 10 * rounding) << boxes << ": " << solution;
  }
  // a rule without the moments is off
  EXPECT_GT(error_of(run(l_shape, scalar, "FA")), 1e-3);
}

TEST(MotionInSpace, of_trilinear_functions_has_their_mass_matrix)
{
  // u_tt is trilinear, which the functions hold; quadratics at rest are nodally exact
  const std::string scalar = "x*y*z*t^2 + (x^2 + y^2)*t",
                    vector = "x*y*z*t^2, (x + y*z)*t^3 + z^2, y*t^2 + x*z";
  for (const std::string &boxes : {cube, l_shape})
    for (const std::string &solution : {scalar, vector})
      EXPECT_LT(error_of(run(boxes, solution, "Q1")), 1e-9) << boxes << ": " << solution;
}

TEST(MotionInSpace, of_a_state_based_solid_is_exact_for_polynomials)
{
  const std::string lps = "1/r\n set limit = Navier\nend\nsubsection Material\n set model = LPS\n"
                          " set E = 2\n set nu = 0.4";
  EXPECT_LT(error_of(run(l_shape, "(x^3*y^2 + z^4)*(1 + t^3), y^2*z^3*t + x*z, x^2*y*z*t^2 + y^3",
                         "IPA-AC-R4", "", "1/4", lps)),
            1e-9);
  EXPECT_LT(
      error_of(run(cube, "x*y*z*t^2, (x + y*z)*t^3 + z^2, y*t^2 + x*z", "Q1", "", "1/4", lps)),
      1e-9);
}

TEST(MotionInSpace, records_the_steps_that_are_taken_and_the_speed_of_its_own_kernel)
{
  const StudyResults results =
      run(cube, "x*t", "FA", " set schemes = velocity Verlet\n set steps = 0.06, 0.03\n", "1/4",
          "constant\n set limit = none\n set constant = 10");
  for (const Record &record : results.records)
    EXPECT_NEAR(record["time step"] * record["time steps"], .5, 1e-12);
  // ½ c ∫ξ_1² = ½ c 4π δ⁵/15
  const double speed = std::sqrt(.5 * 10 * 4 * M_PI / 15 * std::pow(.75, 5));
  EXPECT_NEAR(std::stod(results.facts.at("speed of long waves")), speed, 1e-5);
}

TEST(MotionInSpace, of_a_thin_body_has_an_estimate_without_cells_of_twice_the_size)
{
  const StudyResults results = run("0, 0, 0 : 1, 1, 1/2", "0*x", "Q1",
                                   " set initial displacement = sin(pi*x)*sin(pi*y)*sin(2*pi*z)\n"
                                   " set schemes = velocity Verlet\n set steps = 0.02, 0.01\n");
  EXPECT_EQ(results.records.size(), 2u);
}

TEST(MotionInSpace, by_velocity_verlet_is_of_second_order_and_keeps_its_energy)
{
  const std::string rest = "0*x";
  const StudyResults results =
      run(cube, rest, "IPA-AC-R2, Q1",
          " set initial displacement = sin(pi*x)*sin(pi*y)*sin(pi*z)\n"
          " set schemes = velocity Verlet\n set steps = 0.02, 0.01, 0.005\n",
          "1/8");
  ASSERT_EQ(results.records.size(), 6u);
  for (std::size_t i = 0; i < 6; i += 3)
  {
    const double coarse = results.records[i + 1][time_error],
                 fine = results.records[i + 2][time_error];
    EXPECT_NEAR(std::log2(coarse / fine), 2, .1) << results.records[i].key.label();
    EXPECT_LT(results.records[i + 2]["energy imbalance"], 1e-3);
    EXPECT_GT(results.records[i + 2]["kinetic energy"], 0);
  }
}

TEST(MotionInSpace, refuses_steps_beyond_the_critical_one)
{
  try
  {
    run(cube, "x*t", "FA", " set schemes = velocity Verlet\n set steps = 0.5\n");
    ADD_FAILURE() << "the step is taken";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("longer than the critical one"), std::string::npos)
        << error.what();
  }
}

TEST(MassRoot, of_a_product_is_that_of_its_matrix)
{
  // T⊗T⊗T for two components on 3 × 2 × 4 nodes
  constexpr double factor = 1.7, off = .25;
  const std::array<int, 3> n = {3, 2, 4};
  constexpr unsigned int n_nodes = 24;
  const auto along = [&](int i, int j) { return i == j ? 1. : std::abs(i - j) == 1 ? off : 0.; };
  algebra::CsrMatrix rows;
  rows.start.assign(1, 0);
  for (unsigned int i = 0; i < 2 * n_nodes; ++i)
  {
    for (unsigned int j = 0; j < 2 * n_nodes; ++j)
    {
      double value = i / n_nodes == j / n_nodes ? factor : 0;
      unsigned int a = i % n_nodes, b = j % n_nodes;
      for (const int length : n)
      {
        value *= along(static_cast<int>(a % length), static_cast<int>(b % length));
        a /= length;
        b /= length;
      }
      if (value != 0)
      {
        rows.column.push_back(j);
        rows.value.push_back(value);
      }
    }
    rows.start.push_back(rows.column.size());
  }
  const method::MassRoot product(method::ProductMass{n, 2, factor, off});
  std::vector<double> u(2 * n_nodes), mass_u(2 * n_nodes);
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = std::sin(1 + 3. * static_cast<double>(i));
  double energy = 0, norm = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      mass_u[i] += rows.value[k] * u[rows.column[k]];
    energy += u[i] * mass_u[i];
  }
  const auto state = product.to_state(u);
  for (const double x : state)
    norm += x * x;
  EXPECT_NEAR(norm / energy, 1, 1e-14); // uᵀ S Sᵀ u = uᵀ M u
  const auto again = product.to_unknowns(state), force = product.of_force(mass_u);
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    EXPECT_NEAR(again[i], u[i], 1e-14);     // S⁻ᵀ Sᵀ u
    EXPECT_NEAR(force[i], state[i], 1e-13); // S⁻¹ M u = Sᵀ u
  }
}
