// Run on 1, 2 and 4 ranks: the solution on all of them is the solution on each one alone.
#include "reference/mesh/solution.h"

#include <gtest/gtest.h>

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
        for (const unsigned int degree : {1u, 2u})
        {
          const bool is_continuous = degree == 1;
          const auto together =
              reference::solve_on_mesh(scene, problem, is_continuous, degree, base::Team::all());
          const auto alone =
              reference::solve_on_mesh(scene, problem, is_continuous, degree, base::Team::alone());
          ASSERT_EQ(together.field.values.size(), alone.field.values.size());
          double difference = 0;
          for (std::size_t i = 0; i < alone.field.values.size(); ++i)
            difference =
                std::max(difference, std::abs(together.field.values[i] - alone.field.values[i]));
          EXPECT_LT(difference, 1e-12) << mesh << ", degree " << degree << ", " << solver;
          EXPECT_EQ(together.cost.n_bonds, alone.cost.n_bonds);
        }
      }
}
