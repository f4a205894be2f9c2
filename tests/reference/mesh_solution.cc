// Galerkin solutions on meshes: exactness, rates, agreement of spaces, projection, local limit.
#include "base/error.h"
#include "geometry/mesh_input.h"
#include "reference/mesh/field.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/comparison.h"
#include "study/reference_estimate.h"
#include "study/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace
{
  using namespace plumbline;
  using geometry::Point;

  const std::string wave = "sin(3*x)*cos(2*y)", wave_vector = "sin(3*x)*cos(2*y), cos(x)*sin(3*y)";

  scene::Scene make_scene(const std::string &mesh, const std::string &solution,
                          const std::string &more = "", bool is_tensor = false)
  {
    return scene::parse_scene(
        "test.prm",
        "subsection Domain\n set mesh = " + mesh + "\nend\n" +
            (is_tensor ? "subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
                       : "") +
            "subsection Problem\n set solution = " + solution +
            "\nend\nsubsection Methods\n set names = P1\nend\n" +
            "subsection Study\n set norms = nodal Linf, field L2, averages L2\nend\n" +
            "subsection Geometry\n set checks = 0\nend\n" + more);
  }

  const std::string constant_kernel =
      "subsection Kernel\n set type = constant\n set limit = -Laplace\nend\n";
  const std::string no_refinement = "subsection Quadrature\n set tolerance = 0\nend\n";

  std::shared_ptr<const method::Method> method_named(const std::string &name)
  {
    for (const auto &candidate : reference::methods())
      if (candidate->name() == name)
        return candidate;
    throw std::logic_error(name);
  }

  double error(const scene::Scene &scene, const std::string &name, double h, double horizon,
               const std::string &norm = "field L2")
  {
    const auto problem = make_problem(scene, 0, {h, horizon});
    return study::errors(scene.study.norms, problem, analysis::solve(*method_named(name), problem),
                         {})
        .at(norm + " | exact");
  }
} // namespace

TEST(MeshGalerkin, SolvesWhatItsSpaceContains)
{
  // exact entries on rectangles; a linear field on any degree, a quadratic one on degree 2
  for (const bool is_tensor : {false, true})
  {
    const auto linear =
        make_scene("squares", is_tensor ? "1 + x - y, 2*y" : "1 + x - y", "", is_tensor);
    EXPECT_LT(error(linear, "Q1", .125, .3, "nodal Linf"), 1e-11);
    const auto quadratic =
        make_scene("squares", is_tensor ? "x^2 - x*y, y^2" : "x^2 - x*y", "", is_tensor);
    for (const std::string name : {"Q2", "DGQ2"})
      EXPECT_LT(error(quadratic, name, .25, .3, "nodal Linf"), 1e-11) << name;
  }
}

TEST(MeshGalerkin, OnSquaresIsTheLatticeSolution)
{
  for (const std::string name : {"Q1", "Q3", "DGQ0", "DGQ1", "DGQ2"})
  {
    const auto on_mesh = make_scene("squares", wave), on_lattice = make_scene("lattice", wave);
    const auto mesh = make_problem(on_mesh, 0, {.125, .3}),
               lattice = make_problem(on_lattice, 0, {.125, .3});
    const auto a = analysis::solve(*method_named(name), mesh),
               b = analysis::solve(*method_named(name), lattice);
    EXPECT_LT(study::averages_l2(lattice, a.averages, b.averages), 1e-11) << name;
  }
}

TEST(MeshGalerkin, MovesTwoBodiesWithACrackBetweenThemEachAsItsOwn)
{
  const auto outcome = [](const std::string &mesh, const std::string &name, double y)
  {
    const auto scene = make_scene(
        mesh, "0 + (y > 0.5)",
        "subsection Domain\n set cracks = -2, " + std::to_string(y) + " : 3, " + std::to_string(y) +
            "\nend\nsubsection Problem\n set load = 0\nend\n" + no_refinement);
    const auto problem = make_problem(scene, 0, {.25, .5});
    const auto solution = analysis::solve(*method_named(name), problem);
    const auto &notes = solution.diagnostics.notes;
    const bool is_told =
        std::any_of(notes.begin(), notes.end(),
                    [](const std::string &note) { return note.find("cracks run through") == 0; });
    return std::pair(
        study::errors(scene.study.norms, problem, solution, {}).at("averages L2 | exact"), is_told);
  };
  for (const auto &[mesh, name] : {std::pair("squares", "DGQ0"),
                                   {"squares", "DGQ1"},
                                   {"triangles", "DGP0"},
                                   {"triangles", "DGP1"}})
  {
    const auto [error, is_told] = outcome(mesh, name, .5);
    EXPECT_LT(error, 1e-11) << name;
    EXPECT_FALSE(is_told) << name;
    const auto [error_inside, is_told_inside] = outcome(mesh, name, .6);
    EXPECT_GT(error_inside, .02) << name;
    EXPECT_TRUE(is_told_inside) << name;
  }
  EXPECT_GT(outcome("squares", "Q1", .5).first, .02); // may not jump
}

TEST(MeshGalerkin, ConvergesAtTheOptimalRateOnTriangles)
{
  struct Case
  {
    std::string name;
    double rate, h;
  };
  for (const auto &[name, rate, h] :
       {Case{"P1", 2, .25}, Case{"P2", 3, .25}, Case{"P3", 4, .25}, Case{"DGP0", 1, .125},
        Case{"DGP1", 2, .25}, Case{"DGP2", 3, .25}})
  {
    const auto scene = make_scene("triangles", wave,
                                  constant_kernel + "subsection Quadrature\n set tolerance = " +
                                      std::string(rate > 2 ? "1e-5" : "1e-3") + "\nend\n");
    const double coarse = error(scene, name, h, .3), fine = error(scene, name, h / 2, .3);
    EXPECT_NEAR(std::log2(coarse / fine), rate, .25) << name << " " << coarse << " " << fine;
  }
}

TEST(MeshGalerkin, DegreeZeroStallsAtAFixedRatioAndDegreeOneDoesNot)
{
  const auto scene = make_scene("triangles", wave, no_refinement);
  const auto rate = [&](const std::string &name)
  {
    return std::log2(error(scene, name, .1, .3, "averages L2") /
                     error(scene, name, .05, .15, "averages L2"));
  };
  EXPECT_LT(rate("DGP0"), .4);
  EXPECT_GT(rate("P1"), 1.7);
  EXPECT_GT(rate("DGP1"), 1.7);
}

TEST(MeshGalerkin, KnowsItsOuterError)
{
  const auto solve = [](const std::string &quadrature)
  {
    const auto scene = make_scene(
        "triangles", wave, quadrature + "subsection Quadrature\n set entries = quadrature\nend\n");
    return analysis::solve(*method_named("P1"), make_problem(scene, 0, {.125, .3}));
  };
  const auto first = solve(no_refinement);
  EXPECT_EQ(first.diagnostics.n_refinements, 0u);
  EXPECT_FALSE(first.diagnostics.is_outer_error_known);

  const auto settled = solve("subsection Quadrature\n set tolerance = 1e-6\nend\n");
  EXPECT_GT(settled.diagnostics.n_refinements, 0u);
  EXPECT_TRUE(settled.diagnostics.is_outer_error_known);
  EXPECT_LE(settled.diagnostics.outer_change, 1e-6);
  EXPECT_GT(settled.diagnostics.outer_change, 0);

  try
  {
    solve("subsection Quadrature\n set tolerance = 1e-14\n set max refinements = 1\nend\n");
    FAIL() << "a tolerance of 1e-14 was met";
  }
  catch (const NumericalError &failure)
  {
    EXPECT_NE(std::string(failure.what()).find("Quadrature/tolerance"), std::string::npos)
        << failure.what();
  }
}

TEST(MeshGalerkin, ContinuousAndDiscontinuousSolutionsAgreeWithinTheirEstimatedErrors)
{
  const auto scene = make_scene("triangles", wave, constant_kernel);
  const auto problem = make_problem(scene, 0, {.25, .25});
  const auto exact = study::cell_averages(*problem.solution, *problem.cells(), 1);
  std::vector<std::vector<double>> averages;
  double sum = 0;
  for (const std::string name : {"P2", "DGP2"})
  {
    const auto found =
        study::solve_reference(make_case(scene, 0, problem), *method_named(name), scene.reference);
    const double error = study::averages_l2(problem, found.averages, exact);
    EXPECT_GE(found.estimate.estimate, error) << name;
    EXPECT_LT(found.estimate.estimate, 3 * error) << name;
    averages.push_back(found.averages);
    sum += found.estimate.estimate;
  }
  const double round_off = 1e-13;
  EXPECT_LE(study::averages_l2(problem, averages[0], averages[1]), sum + round_off);
}

TEST(MeshGalerkin, DistortedQuadrilateralsAndVariableCoefficientsConverge)
{
  const auto scene = scene::parse_scene(
      "test.prm",
      "subsection Domain\n set mesh = squares\n set map = x + .1*sin(3*y), y + .1*x*x\nend\n"
      "subsection Kernel\n set coefficient = 1 + .5*x*y + x^2\n set symmetrisation = "
      "harmonic\nend\n"
      "subsection Problem\n set solution = " +
          wave +
          "\nend\nsubsection Methods\n set names = Q1\nend\nsubsection Study\n set norms = field "
          "L2\n"
          " set decisive error = field L2 | exact\nend\n"
          "subsection Geometry\n set checks = 0\nend\nsubsection Quadrature\n set tolerance = "
          "1e-4\nend\n");
  const double coarse = error(scene, "Q1", .25, .3), fine = error(scene, "Q1", .125, .3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, .3) << coarse << " " << fine;
}

TEST(MeshGalerkin, SolvesOnAGeneratorOfDealii)
{
  const auto scene = scene::parse_scene(
      "test.prm", "subsection Domain\n set mesh = hyper_ball_balanced\n set arguments = 0, 0 : 1\n"
                  " set inside = (1 - 1.6*delta)^2 - x^2 - y^2\nend\n" +
                      constant_kernel + "subsection Problem\n set solution = " + wave +
                      "\nend\nsubsection Methods\n set names = Q1\nend\nsubsection Study\n"
                      " set norms = field L2\n set decisive error = field L2 | exact\nend\n" +
                      no_refinement);
  EXPECT_LT(error(scene, "Q1", .2, .25), .02);
  EXPECT_LT(error(scene, "Q1", .1, .25), .3 * error(scene, "Q1", .2, .25));
}

TEST(MeshField, ProjectsExactlyOntoLatticeAndVoronoiCells)
{
  // averages of a polynomial that the space contains are those of the polynomial
  for (const std::string mesh : {"triangles", "squares"})
    for (const std::string nodes : {"", " set perturbation = 0.3\n", " set nodes = mesh\n"})
    {
      const auto scene =
          make_scene(mesh, mesh == "squares" ? "x^2*y^2 - x*y + 2*y" : "x^2*1 - x*y + 2*y",
                     "subsection Methods\n" + nodes + "end\n");
      const auto problem = make_problem(scene, 0, {.25, .25});
      const auto space = std::make_shared<const reference::MeshSpace>(problem.mesh(), true, 2);
      reference::MeshField field{space,
                                 std::make_shared<const reference::MeshCells>(*problem.mesh()), 1,
                                 std::vector<double>(space->n_dofs())};
      for (std::size_t dof = 0; dof < space->n_dofs(); ++dof)
        field.values[dof] = problem.solution->value(space->support(dof), 0);
      const auto averages = field.averages(*problem.cells());
      const auto exact = study::cell_averages(*problem.solution, *problem.cells(), 1);
      for (std::size_t i = 0; i < exact.size(); ++i)
        ASSERT_NEAR(averages[i], exact[i], 1e-13) << mesh << nodes;
      EXPECT_NEAR(field.value(Point<2>(.3, .7), 0),
                  (mesh == "squares" ? .09 * .49 : .09) - .21 + 1.4, 1e-13);
    }
}

TEST(LocalLimit, IsTheSolutionOfPoissonsAndNaviersEquation)
{
  // -½ Δ u = b and -div σ = b with u outside the space: rate 3 of degree 2
  const auto rate = [](const scene::Scene &scene)
  {
    const auto local_error = [&](double h)
    {
      const auto problem = make_problem(scene, 0, {h, h});
      const auto solution = analysis::solve(*method_named("LOCAL"), problem);
      return study::errors(scene.study.norms, problem, solution, {}).at("field L2 | exact");
    };
    return std::log2(local_error(.125) / local_error(.0625));
  };
  for (const std::string mesh : {"triangles", "squares"})
  {
    auto scalar = make_scene(mesh, "exp(x)*sin(2*y)");
    scalar.problem.loads = {{"u", "1.5*exp(x)*sin(2*y)"}};
    EXPECT_NEAR(rate(scalar), 3, .15);
    // u = (sin x cos y, 0), λ = μ = .6: -[μ Δu + (λ + μ) ∇ div u]
    auto tensor = make_scene(mesh, "sin(x)*cos(y), 0", "", true);
    tensor.problem.loads = {{"u", "1.2*sin(x)*cos(y) + 1.2*sin(x)*cos(y), 1.2*cos(x)*sin(y)"}};
    EXPECT_NEAR(rate(tensor), 3, .2);
  }
}

TEST(LocalLimit, HasTheDilatationOfASolid)
{
  // u = (sin x cos y, 0) at λ = 3, μ = 1: -[μ Δu + (λ + μ) ∇ div u]
  const auto scene = scene::parse_scene("solid.prm", "",
                                        {{"Domain/mesh", "triangles"},
                                         {"Kernel/type", "1/r"},
                                         {"Kernel/limit", "Navier"},
                                         {"Material/model", "LPS"},
                                         {"Material/lambda", "3"},
                                         {"Material/mu", "1"},
                                         {"Methods/names", "LOCAL"},
                                         {"Problem/solution", "sin(x)*cos(y), 0"},
                                         {"Problem/load", "6*sin(x)*cos(y), 4*cos(x)*sin(y)"},
                                         {"Study/norms", "field L2"},
                                         {"Study/decisive error", "field L2 | exact"}});
  std::vector<double> errors;
  for (const double h : {.125, .0625})
  {
    const auto problem = make_problem(scene, 0, {h, h});
    const auto solution = analysis::solve(*method_named("LOCAL"), problem);
    errors.push_back(
        study::errors(scene.study.norms, problem, solution, {}).at("field L2 | exact"));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3, .2);
}

TEST(MeshMethods, SayWhyTheyCannotDoAMesh)
{
  const auto scene = make_scene("triangles", wave);
  const auto problem = make_problem(scene, 0, {.25, .25});
  EXPECT_EQ(study::refusal(*method_named("P1"), scene, problem, reference::methods()), "");
  EXPECT_NE(
      study::refusal(*method_named("Q1"), scene, problem, reference::methods()).find("take P1"),
      std::string::npos);
}

TEST(MeshMethods, WriteFieldsForEveryDegree)
{
  for (const std::string mesh : {"triangles", "squares"})
  {
    const auto scene = make_scene(mesh, wave, no_refinement);
    const auto problem = make_problem(scene, 0, {.25, .25});
    for (const std::string degree : {"1", "3"})
    {
      const std::string name = (mesh == "squares" ? "Q" : "P") + degree;
      const auto file = std::filesystem::temp_directory_path() / ("plumbline_" + name + ".vtu");
      analysis::solve(*method_named(name), problem).write_vtu(file.string());
      std::ifstream written(file);
      std::string first;
      std::getline(written, first);
      EXPECT_NE(first.find("xml"), std::string::npos);
      std::filesystem::remove(file);
    }
  }
}

TEST(MeshGalerkin, DoesNotDependOnTheFirstVertexOfRectangles)
{
  const auto scene = make_scene("squares", wave);
  auto problem = make_problem(scene, 0, {.25, .3});
  const auto expected = analysis::solve(*method_named("Q2"), problem).averages;
  for (unsigned int turn = 1; turn < 4; ++turn)
  {
    geometry::Mesh mesh = *problem.mesh();
    for (auto &cell : mesh.cells)
      std::rotate(cell.vertex.begin(), cell.vertex.begin() + turn, cell.vertex.end());
    auto turned = problem;
    turned.on_mesh()->mesh = std::make_shared<const geometry::Mesh>(mesh);
    EXPECT_LT(study::averages_l2(problem, analysis::solve(*method_named("Q2"), turned).averages,
                                 expected),
              1e-4)
        << turn;
  }
  // refined cells are rectangles like those they come from: entries stay exact
  auto fine = problem; // averaged over the same cells
  fine.on_mesh()->mesh = std::make_shared<const geometry::Mesh>(geometry::refine(*problem.mesh()));
  const auto refined = analysis::solve(*method_named("Q2"), fine);
  EXPECT_EQ(refined.diagnostics.n_refinements, 0u);
  auto half = make_problem(scene, 0, {.125, .3});
  half.on_mesh()->cells = problem.cells();
  const auto direct = analysis::solve(*method_named("Q2"), half);
  EXPECT_LT(study::averages_l2(problem, refined.averages, direct.averages), 1e-11);
}

TEST(MeshGalerkin, TellsWhatExactPredicatesSayOfPairsOfCells)
{
  const auto notes = [](const std::string &mesh, const std::string &name, const std::string &more)
  {
    auto scene = make_scene(mesh, "sin(x)", more);
    scene.geometry.n_checks = 12;
    const auto problem = make_problem(scene, 0, {.125, .5});
    std::string all;
    for (const std::string &note :
         analysis::solve(*method_named(name), problem, base::Communicator::alone())
             .diagnostics.notes)
      all += note + "; ";
    return all;
  };
  const std::string right = "apart as CGAL's exact predicates say in all of them";
  for (const auto &[mesh, name] : {std::pair<std::string, std::string>("triangles", "P1"),
                                   {"triangles", "DGP1"},
                                   {"squares", "Q1"}})
  {
    const std::string text = notes(mesh, name, "");
    EXPECT_NE(text.find("12 pairs of cells, "), std::string::npos) << text;
    EXPECT_NE(text.find(right), std::string::npos) << text;
  }
  const std::string by_quadrature =
      notes("triangles", "P1",
            "subsection Quadrature\n set entries = quadrature\n set tolerance = 0\nend\n");
  EXPECT_EQ(by_quadrature.find(right), std::string::npos) << by_quadrature;
}
