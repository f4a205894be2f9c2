#include "reference/method.h"
#include "scene/problem.h"
#include "study/comparison.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::reference;

namespace
{
  const std::string scalar_kernel = "set type = linear-decay";
  const std::string tensor_kernel = "set type = bond-tensor\nset limit = Navier";
  const std::string trigonometric = "sin(3*x)*cos(2*y)";
  const std::string trigonometric_vector = "sin(3*x)*cos(2*y), cos(x)*sin(3*y)";

  scene::Scene make_scene(const std::string &kernel, const std::string &solution,
                          const std::string &more = "")
  {
    return scene::parse_scene(
        "test.prm", "subsection Kernel\n" + kernel + "\nend\nsubsection Problem\n set solution = " +
                        solution + "\nend\nsubsection Methods\n set names = Q1\nend\n" +
                        "subsection Study\n set norms = nodal Linf, field L2, averages L2\nend\n" +
                        "subsection Geometry\n set checks = 0\nend\n" + more);
  }

  std::shared_ptr<const method::Method> method_named(const std::string &name)
  {
    for (const auto &candidate : methods())
      if (candidate->name() == name)
        return candidate;
    throw std::logic_error(name);
  }

  double error(const scene::Scene &scene, const std::string &name, const std::string &norm,
               double h, double horizon)
  {
    const auto problem = make_problem(scene, 0, {h, horizon});
    return study::errors(scene.study.norms, problem, analysis::solve(*method_named(name), problem),
                         {})
        .at(norm + " | exact");
  }

  unsigned int n_iterations(const scene::Scene &scene, const std::string &name, double h,
                            double horizon)
  {
    return analysis::solve(*method_named(name), make_problem(scene, 0, {h, horizon}))
        .cost.n_iterations;
  }

  std::string domain(const std::string &holes)
  {
    return "subsection Domain\n set holes = " + holes +
           "\nend\nsubsection Study\n set h = 0.125\nend\n";
  }
} // namespace

TEST(LatticeGalerkin, q1_is_exact_at_nodes_for_low_polynomials_at_every_h)
{
  for (const std::string u : {"x*(1-x)/2 + y*(1-y)/2", "x^3 + 2*y^2"})
  {
    const auto scene = make_scene(scalar_kernel, u);
    for (const double h : {.1, .05, .025, .0125, .00625})
    {
      EXPECT_LT(error(scene, "Q1", "nodal Linf", h, 3 * h), 1e-11) << u << ", h = " << h;
      EXPECT_LT(error(scene, "Q1", "nodal Linf", h, .4), 1e-11) << u << ", h = " << h;
    }
  }
}

TEST(LatticeGalerkin, q1_converges_at_rate_2_to_the_local_limit_for_a_quintic)
{
  const auto scene = make_scene(scalar_kernel, "x^3*y^2 + y^4");
  const double coarse = error(scene, "Q1", "nodal Linf", .025, .075);
  const double fine = error(scene, "Q1", "nodal Linf", .0125, .0375);
  EXPECT_NEAR(std::log2(coarse / fine), 2, .1);
}

// Optimal orders of the L2 error at fixed horizon and at fixed m; DGQ0 has order 1 at fixed horizon
// only.
TEST(LatticeGalerkin, every_space_has_its_own_optimal_rate_for_a_smooth_field)
{
  const std::map<std::string, double> rates = {
      {"Q1", 2}, {"Q2", 3}, {"Q3", 4}, {"DGQ1", 2}, {"DGQ2", 3}};
  for (const auto &[name, rate] : rates)
    for (const bool is_tensor : {false, true})
    {
      const auto scene = is_tensor ? make_scene(tensor_kernel, trigonometric_vector)
                                   : make_scene(scalar_kernel, trigonometric);
      for (const double m : {0., 3.})
      {
        const auto at = [&](double h)
        { return error(scene, name, "field L2", h, m > 0 ? m * h : .3); };
        EXPECT_NEAR(std::log2(at(1. / 16) / at(1. / 32)), rate, .15) << name << ", m = " << m;
      }
    }
  const auto scene = make_scene(scalar_kernel, trigonometric);
  EXPECT_NEAR(std::log2(error(scene, "DGQ0", "field L2", 1. / 32, .3) /
                        error(scene, "DGQ0", "field L2", 1. / 64, .3)),
              1, .1);
  // ... and stalls at fixed m: exact integration does not make it asymptotically compatible
  EXPECT_LT(std::log2(error(scene, "DGQ0", "nodal Linf", 1. / 64, 3. / 64) /
                      error(scene, "DGQ0", "nodal Linf", 1. / 128, 3. / 128)),
            .2);
}

TEST(LatticeGalerkin, continuous_and_discontinuous_solutions_agree)
{
  const auto scene = make_scene(tensor_kernel, trigonometric_vector);
  const auto problem = make_problem(scene, 0, {1. / 24, .2});
  const auto q2 = analysis::solve(*method_named("Q2"), problem),
             dg2 = analysis::solve(*method_named("DGQ2"), problem);
  EXPECT_LT(study::averages_l2(problem, q2.averages, dg2.averages), 1e-5);
}

TEST(Preconditioner, iterations_stay_below_6_16_of_long_kernels_and_26_of_tensors_whatever_h)
{
  for (const bool is_tensor : {false, true})
  {
    const auto scene = is_tensor ? make_scene(tensor_kernel, trigonometric_vector)
                                 : make_scene(scalar_kernel, trigonometric);
    for (const int n : {32, 64, 128, 256, 1024})
      for (const double horizon : {.1, 3. / n})
      {
        constexpr double longest =
            9; // cells, of kernels beside whose domains nodes are constrained
        const unsigned int bound = is_tensor ? 26 : horizon * n < longest ? 6 : 16;
        EXPECT_LE(n_iterations(scene, "Q1", 1. / n, horizon), bound)
            << "n = " << n << ", horizon = " << horizon;
      }
  }
}

TEST(Preconditioner, iterations_are_bounded_in_h_for_every_space)
{
  const auto scene = make_scene(scalar_kernel, trigonometric);
  for (const std::string name : {"Q2", "Q3", "DGQ0", "DGQ1", "DGQ2"})
    for (const int n : {16, 32, 64})
      for (const double horizon : {.2, 3. / n})
        EXPECT_LE(n_iterations(scene, name, 1. / n, horizon), 20u)
            << name << ", n = " << n << ", horizon = " << horizon;
}

TEST(Preconditioner, iterations_are_bounded_in_h_on_unions_of_rectangles)
{
  for (const std::string holes : {"0.5, 0.5 : 1, 1", "0.375, 0.375 : 0.625, 0.625"})
  {
    const auto scene = make_scene(scalar_kernel, trigonometric, domain(holes));
    for (const int n : {32, 64, 128, 256})
      for (const double horizon : {.1, 3. / n})
        EXPECT_LE(n_iterations(scene, "Q1", 1. / n, horizon), 22u)
            << holes << ", n = " << n << ", horizon = " << horizon;
  }
}

TEST(SmallestModel, stencil_and_assembled_matrix_give_the_same_solution)
{
  for (const std::string holes : {"", "0.5, 0.5 : 1, 1"})
  {
    const auto text = [&](const std::string &backend)
    {
      return domain(holes) + "subsection Solver\n set operator = " + backend +
             "\n set tolerance = 1e-14\nend\n";
    };
    for (const bool is_tensor : {false, true})
      for (const bool is_continuous : {true, false})
      {
        std::vector<double> averages;
        for (const std::string backend : {"fft", "sparse"})
        {
          const auto scene = is_tensor
                                 ? make_scene(tensor_kernel, trigonometric_vector, text(backend))
                                 : make_scene(scalar_kernel, trigonometric, text(backend));
          const auto problem = make_problem(scene, 0, {.0625, .2});
          const auto solution =
              analysis::solve(*method_named(is_continuous ? "Q2" : "DGQ1"), problem);
          if (averages.empty())
            averages = solution.averages;
          else
            EXPECT_LT(study::averages_l2(problem, averages, solution.averages), 1e-11);
        }
      }
  }
}

TEST(LatticeGalerkin, a_load_that_is_not_smooth_is_integrated_cell_by_cell)
{
  // a load with a jump along a line of the lattice: the same as the sum of its two smooth halves
  const auto solve = [](const std::string &load)
  {
    const auto scene =
        make_scene(scalar_kernel, "0*x",
                   "subsection Problem\n set load = " + load + "\n set constraint = 0\nend\n");
    const auto problem = make_problem(scene, 0, {.125, .25});
    return analysis::solve(*method_named("Q1"), problem).averages;
  };
  const auto jump = solve("x < 0.5 ? 1 : 3"), constant = solve("1");
  double sum_jump = 0, sum_constant = 0;
  for (std::size_t i = 0; i < jump.size(); ++i)
  {
    sum_jump += jump[i];
    sum_constant += constant[i];
  }
  // by symmetry the mean load counts
  EXPECT_NEAR(sum_jump, 2 * sum_constant, 1e-11 * sum_jump);
}

TEST(LatticeGalerkin, loads_on_two_halves_add_up_to_the_load_on_both)
{
  // the halves jump along a line of the lattice and are integrated cell by cell; both together are
  // smooth and are integrated as a series
  const auto solve = [](const std::string &load)
  {
    const auto scene = make_scene(
        scalar_kernel, "0*x",
        "subsection Problem\n set load = " + load +
            "\n set constraint = 0\nend\nsubsection Solver\n set tolerance = 1e-13\nend\n");
    const auto problem = make_problem(scene, 0, {.125, .25});
    EXPECT_EQ(problem.load.series.has_value(), load.find('?') == std::string::npos);
    return analysis::solve(*method_named("Q1"), problem).nodal;
  };
  const auto both = solve("x^2*(1 + y^3)");
  const double largest = *std::max_element(both.begin(), both.end());
  for (const std::string side : {"x < 0.5", "y < 0.5"})
  {
    const auto one = solve(side + " ? x^2*(1 + y^3) : 0"),
               other = solve(side + " ? 0 : x^2*(1 + y^3)");
    ASSERT_EQ(one.size(), both.size());
    for (std::size_t i = 0; i < both.size(); ++i)
      EXPECT_NEAR(one[i] + other[i], both[i], 1e-11 * largest) << side;
  }
}

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 2);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
