// Problems in space on meshes from gmsh files, from the scene to verdicts.
#include "method/linear_equations.h"
#include "scene/problem.h"
#include "study/preflight.h"
#include "study/transient.h"
#include "tests/geometry/tetrahedra_file.h"
#include "tests/study/space_scene.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using in_space::available;
  using in_space::run;
  using in_space::Settings;
  using in_space::with;

  /// The same as scenes/three_d/ball.geo.
  const std::string ball = R"(
    SetFactory("OpenCASCADE");
    DefineConstant[ h = 0.5, delta = 0.5 ];
    Sphere(1) = {0, 0, 0, 1};
    Sphere(2) = {0, 0, 0, 1 + delta + h / 4};
    BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
    Physical Volume("omega") = {1};
    Physical Volume("collar") = {2};
    Mesh.MeshSizeMin = h;
    Mesh.MeshSizeMax = h;
    Mesh.OptimizeThreshold = 0.7;
  )";

  class ProblemsOnTetrahedra : public testing::Test
  {
  protected:
    scene::Scene make(const Settings &more) const
    {
      Settings settings = {{"Domain/dimension", "3"},
                           {"Domain/mesh", file_},
                           {"Kernel/type", "constant"},
                           {"Kernel/limit", "-Laplace"},
                           {"Problem/solution", "sin(x + y/2)*cos(z)"},
                           {"Methods/names", "P1"},
                           {"Study/m", "1"},
                           {"Study/h", "0.5"},
                           {"Study/norms", "nodal Linf, nodal L2, averages L2"},
                           {"Study/decisive error", "averages L2 | exact"}};
      if (std::any_of(more.begin(), more.end(),
                      [](const auto &one) { return one.key == "Study/horizon"; }))
        settings.erase(std::find_if(settings.begin(), settings.end(),
                                    [](const auto &one) { return one.key == "Study/m"; }));
      return scene::parse_scene("body.prm", "", in_space::last_of_each(with(settings, more)));
    }

    std::string message_of(const Settings &settings) const
    {
      return in_space::refusal_of([&] { return make(settings); });
    }

    void expect_refused(const Settings &settings, const std::string &words) const
    {
      const std::string message = message_of(settings);
      EXPECT_NE(message.find(words), std::string::npos) << words << "\nis not in\n" << message;
    }

    const tests::TextFolder folder_{"tetrahedra_of_files"};
    const std::string file_ = folder_.write("ball.geo", ball);
    /// The unit cube and a layer of width 1/2 around it, edges 1/2 long.
    const std::string cube_ = folder_.write(
        "cube.msh", tests::msh_22(geometry::six_per_cube({{{{{0, 0, 0}, {1, 1, 1}}}, {}}, .5}, 1)));
  };
} // namespace

TEST_F(ProblemsOnTetrahedra, are_exact_for_linear_fields)
{
  const auto results = run(make(
      {{"Problem/solution", "3*x + 2*y - z + 1"}, {"Study/norms", "nodal Linf, averages L2"}}));
  ASSERT_EQ(results.records.front().failure, "");
  EXPECT_LT(results.records.front()["nodal Linf | exact"], 1e-11);
  EXPECT_LT(results.records.front()["averages L2 | exact"], 1e-11);
  // nodes of meshfree rules with exact moments, too
  const auto rule = run(make({{"Problem/solution", "3*x + 2*y - z + 1"},
                              {"Study/m", "1.5"},
                              {"Methods/nodes", "mesh"},
                              {"Methods/names", "IPA-AC-R2"}}));
  ASSERT_EQ(rule.records.front().failure, "");
  EXPECT_LT(rule.records.front()["nodal Linf | exact"], 1e-10);
}

TEST_F(ProblemsOnTetrahedra, move_and_hold_fields_that_are_linear_in_space)
{
  const scene::Scene scene = make({{"Domain/mesh", cube_},
                                   {"Problem/solution", "(1 + x)*sin(2*t) + y - z*t^2"},
                                   {"Methods/names", "P1, FA"},
                                   {"Methods/nodes", "mesh"},
                                   {"Study/norms", "nodal L2"},
                                   {"Study/decisive error", "nodal L2 | exact"},
                                   {"Time/final time", "0.5"},
                                   {"Time/schemes", "Runge-Kutta"}});
  const Methods methods = choose_methods(scene, available());
  check_transient(scene, methods, 0);
  EXPECT_NO_THROW(check_memory_of_motion(scene, methods, 0));
  const auto records = run_study(transient_analysis({}), scene, methods).records;
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].failure, "");
  EXPECT_LT(records[0]["nodal L2 | exact"], 1e-9);
  EXPECT_EQ(records[1].failure, "");
  EXPECT_LT(records[1]["nodal L2 | exact"], 1);
  EXPECT_GT(records[1]["nodal L2 | exact"], 1e-3); // whose linear moments are wrong
}

TEST_F(ProblemsOnTetrahedra, converge_with_P1_and_with_rules_that_are_compatible)
{
  std::map<std::string, std::vector<Record>> found;
  for (const Record &record : run(make({{"Methods/names", "P1, FA, IPA-AC-R2"},
                                        {"Methods/nodes", "mesh"},
                                        {"Study/h", "0.5, 0.3"}}))
                                  .records)
  {
    EXPECT_EQ(record.failure, "");
    found[record.key.method].push_back(record);
  }
  const auto rate = [&](const std::string &method, const std::string &error)
  { return std::log(found.at(method)[0][error] / found.at(method)[1][error]) / std::log(.5 / .3); };
  EXPECT_NEAR(rate("P1", "averages L2 | exact"), 1.85, .3);
  EXPECT_LT(rate("FA", "averages L2 | exact"), 1.3);
  EXPECT_NEAR(rate("IPA-AC-R2", "averages L2 | exact"), 2.2, .3);
  EXPECT_NEAR(rate("IPA-AC-R2", "nodal L2 | exact"), 1.8, .4);
}

TEST_F(ProblemsOnTetrahedra, have_an_area_that_is_the_volume_of_the_domain)
{
  const auto scene = make({{"Methods/names", "FA"}, {"Methods/nodes", "mesh"}});
  const Record record = run(scene).records.front();
  const auto problem =
      scene::make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
  double volume = 0;
  for (std::size_t i = 0; i < problem.cells->n_free; ++i)
    volume += problem.cells->area[i];
  EXPECT_NEAR(record["area"], volume, 1e-12);
  EXPECT_LT(std::pow(problem.h(), 3) * static_cast<double>(problem.lattice.size()), volume);
}

TEST_F(ProblemsOnTetrahedra, have_symmetric_entries_that_leave_nothing_of_linear_fields)
{
  const auto scene = make({});
  const auto problem =
      scene::make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
  const auto discretisation = find_method(available(), "P1", "test")->discretise_in_space(problem);
  const auto *shown = dynamic_cast<const method::HasLinearEquations<3> *>(discretisation.get());
  ASSERT_NE(shown, nullptr);
  const auto equations = shown->equations(problem);
  const algebra::CsrMatrix &rows = equations.rows;
  ASSERT_GT(rows.n_rows(), 5u);
  std::map<std::pair<std::size_t, std::size_t>, double> entries;
  double largest = 0;
  for (std::size_t i = 0; i < rows.n_rows(); ++i)
    for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
    {
      entries[{i, rows.column[k]}] = rows.value[k];
      largest = std::max(largest, rows.value[k]);
    }
  for (std::size_t i = 0; i < rows.n_rows(); ++i)
  {
    double sum = 0;
    for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
    {
      const std::size_t j = rows.column[k];
      sum += rows.value[k] * (equations.nodes[j] * dealii::Point<3>(1, 2, 3) + 1);
      if (j < rows.n_rows())
      {
        EXPECT_NEAR(rows.value[k], (entries[{j, i}]), 1e-13 * largest);
      }
    }
    EXPECT_NEAR(sum, 0, 1e-12 * largest);
  }
}

TEST_F(ProblemsOnTetrahedra, may_have_a_reference_with_an_estimate_on_cells_cut_into_eight)
{
  const auto results = run(make({{"Domain/mesh", cube_},
                                 {"Study/regime", "m"},
                                 {"Study/horizon", "0.5"},
                                 {"Methods/names", "P1"},
                                 {"Reference/method", "P1"},
                                 {"Study/decisive error", "averages L2 | reference"}}));
  ASSERT_EQ(results.references.size(), 1u);
  ASSERT_EQ(results.records.front().failure, "");
  const double error = results.records.front()["averages L2 | exact"];
  EXPECT_LT(error, results.references.front().estimate);
  EXPECT_GT(error, results.references.front().estimate / 10);
}

TEST_F(ProblemsOnTetrahedra, are_refused_where_methods_or_settings_do_not_fit)
{
  EXPECT_EQ(message_of({}), "");
  EXPECT_EQ(message_of({{"Methods/names", "DGP0"}}), "");
  expect_refused({{"Methods/names", "Q1"}}, "'Q1' cannot do this scene: the cells of Domain/mesh");
  expect_refused({{"Methods/names", "Q1"}}, "are tetrahedra; take P1, DGP0");
  expect_refused({{"Methods/names", "P2"}}, "take P1, DGP0");
  expect_refused({{"Methods/names", "FA"}}, "write Methods/nodes = mesh (the centroids");
  expect_refused({{"Methods/names", "FA"}, {"Methods/nodes", "vertices"}}, "write mesh");
  expect_refused({{"Methods/names", "FA"}, {"Methods/perturbation", "0.1"}},
                 "Methods/perturbation with Domain/mesh");
  expect_refused({{"Domain/sides", "curved"}}, "Domain/sides = curved");
  expect_refused({{"Domain/mesh", "hyper_ball"}, {"Domain/inside", "1"}},
                 "write lattice, or a file .msh or .geo");
  expect_refused({{"Study/h", "2"}}, "no cube of this side lies in the domain");
  expect_refused({{"Quadrature/tolerance", "1e-5"}}, "Quadrature/tolerance = 1e-5 has no effect");
}

TEST_F(ProblemsOnTetrahedra, are_refused_on_meshes_that_do_not_fit_the_level)
{
  const Settings on_cube = {{"Domain/mesh", cube_}};
  EXPECT_EQ(message_of(on_cube), "");
  expect_refused(
      with(on_cube, {{"Study/m", "1.2"}}),
      "the interaction domain is 0.5 wide at its thinnest place, thinner than the "
      "reach of the kernel, 0.6 (the horizon, or twice the horizon with a dilatation), so "
      "that balls would contain points without data; widen");
  expect_refused(with(on_cube, {{"Study/h", "0.5, 0.25"}}), "has the 48 cells of the level before");
  expect_refused(with(on_cube, {{"Study/h", "0.01"}}), "in the same unit? Scale the mesh");
  expect_refused({{"Domain/mesh", "missing.msh"}}, "cannot be read; check its name and folder");
}

TEST(MethodsInSpace, that_are_of_the_plane_name_those_on_the_same_cells)
{
  const std::string message = in_space::message_of({{"Methods/names", "P2"}});
  EXPECT_NE(message.find("in two dimensions only"), std::string::npos) << message;
  EXPECT_NE(message.find("take P1, DGP0"), std::string::npos) << message;
  EXPECT_EQ(message.find("squares or triangles"), std::string::npos) << message;
  EXPECT_NE(in_space::message_of({{"Methods/names", "Q3"}}).find("take Q1, Q2, DGQ0"),
            std::string::npos);
}
