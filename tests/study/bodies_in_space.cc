// Bodies of several materials with free surfaces on meshes in space, from the scene to solutions.
#include "method/linear_equations.h"
#include "scene/problem.h"
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
  using dealii::Point;
  using in_space::available;
  using in_space::Settings;

  /// A bar of cubes 1/2 long: held for x < 1/2, soft up to x = 1, then stiff.
  geometry::TetrahedralMesh bar()
  {
    geometry::TetrahedralMesh mesh =
        geometry::six_per_cube({{{{{0, 0, 0}, {2, .5, .5}}}, {}}, .5}, 0);
    mesh.groups = {"omega_soft", "omega_stiff", "collar_grip"};
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      double x = 0;
      for (const unsigned int vertex : mesh.cells[cell])
        x += mesh.vertices[vertex][0] / 4;
      mesh.is_inside[cell] = x > .5 ? 1 : 0;
      mesh.group.push_back(x < .5 ? 2 : x < 1 ? 0 : 1);
    }
    return mesh;
  }

  class BodiesInSpace : public testing::Test
  {
  protected:
    scene::Scene make(const Settings &more = {}) const
    {
      return scene::parse_scene(
          "body.prm", "",
          in_space::last_of_each(
              in_space::with({{"Domain/dimension", "3"},
                              {"Domain/mesh", file_},
                              {"Domain/boundary", "free"},
                              {"Kernel/type", "1/r"},
                              {"Kernel/limit", "-Laplace"},
                              {"Kernel/materials", "omega_soft: 1; omega_stiff: 4; collar_grip: 1"},
                              {"Kernel/symmetrisation", "harmonic"},
                              {"Problem/solution", ""},
                              {"Problem/load", "0"},
                              {"Problem/constraint", "7"},
                              {"Methods/names", "FA, PA-AC, DGP0, DGP1, P1"},
                              {"Methods/nodes", "mesh"},
                              {"Reference/method", "P1"},
                              {"Reference/estimate", "none"},
                              {"Study/regime", "m"},
                              {"Study/horizon", "0.6"},
                              {"Study/h", "0.5"},
                              {"Study/norms", "nodal Linf, averages L2"},
                              {"Study/decisive error", "averages L2 | reference"}},
                             more)));
    }

    void expect_refused(const Settings &settings, const std::string &words) const
    {
      const std::string message = in_space::refusal_of([&] { return make(settings); });
      EXPECT_NE(message.find(words), std::string::npos) << words << "\nis not in\n" << message;
    }

    static std::shared_ptr<const method::Method> find(const std::string &name)
    {
      for (const auto &one : available())
        if (one->name() == name)
          return one;
      throw std::logic_error("no method " + name);
    }

    const tests::TextFolder folder_{"bodies_in_space"};
    const std::string file_ = folder_.write("bar.msh", tests::msh_22(bar()));
  };

  const auto *equations_of(const method::DiscretisationInSpace &discretisation)
  {
    return dynamic_cast<const method::HasLinearEquations<3> *>(&discretisation);
  }
} // namespace

TEST_F(BodiesInSpace, have_bonds_with_the_mean_of_their_materials)
{
  const scene::Scene scene = make();
  const auto problem = scene::make_problem_in_space(scene, 0, scene.study.series[0].levels[0]);
  EXPECT_TRUE(problem.is_free);
  const auto rule = find("FA")->discretise_in_space(problem);
  const auto equations = equations_of(*rule)->equations(problem);
  const auto coefficient = [](const Point<3> &x) { return x[0] < 1 ? 1. : 4.; };
  ASSERT_EQ(equations.nodes.size(), 6u * 4);
  ASSERT_EQ(equations.n_free, 6u * 3);
  std::size_t n_bonds = 0;
  for (std::size_t i = 0; i < equations.n_free; ++i)
  {
    std::map<std::size_t, double> row;
    for (std::size_t k = equations.rows.start[i]; k < equations.rows.start[i + 1]; ++k)
      row[equations.rows.column[k]] = equations.rows.value[k];
    double sum = 0;
    for (std::size_t j = 0; j < equations.nodes.size(); ++j)
    {
      const double r = equations.nodes[i].distance(equations.nodes[j]);
      if (j == i || r >= .6)
        continue;
      const double a = coefficient(equations.nodes[i]), b = coefficient(equations.nodes[j]),
                   volume = 1. / 48, // of all cells
          expected = 2 / (1 / a + 1 / b) * problem.kernel.constant() * (.6 / r) * volume;
      EXPECT_NEAR(row[j], -expected, 1e-12 * expected) << i << ' ' << j;
      sum += expected;
      ++n_bonds;
    }
    EXPECT_NEAR(row[i], sum, 1e-12 * sum);
  }
  EXPECT_GT(n_bonds, 100u);
}

TEST_F(BodiesInSpace, that_are_held_and_not_loaded_do_not_move)
{
  for (const bool is_solid : {false, true})
  {
    const StudyResults results = in_space::run(is_solid ? make({{"Kernel/type", "bond-tensor"},
                                                                {"Kernel/limit", "Navier"},
                                                                {"Problem/load", "0, 0, 0"},
                                                                {"Problem/constraint", "7, -2, 3"}})
                                                        : make());
    ASSERT_EQ(results.records.size(), 5u);
    for (const Record &record : results.records)
    {
      EXPECT_EQ(record.failure, "") << record.key.method;
      EXPECT_LT(record["averages L2 | reference"], 1e-9) << record.key.method;
    }
  }
}

// The energy that a load gives to a body is the larger the larger the space of functions.
TEST_F(BodiesInSpace, take_more_energy_from_a_load_in_larger_spaces)
{
  const scene::Scene scene = make({{"Problem/load", "1"}, {"Problem/constraint", "0"}});
  const auto problem = scene::make_problem_in_space(scene, 0, scene.study.series[0].levels[0]);
  std::map<std::string, double> energy;
  for (const std::string name : {"P1", "DGP0", "DGP1"})
  {
    const auto discretisation = find(name)->discretise_in_space(problem);
    const auto load = discretisation->data(problem).load;
    auto u = load;
    u = 0;
    constexpr double tolerance = 1e-12;
    constexpr unsigned int most = 1000;
    discretisation->tangent()->solve(u, load, {tolerance, most});
    energy[name] = u * load;
  }
  EXPECT_GT(energy["P1"], 0);
  EXPECT_GT(energy["DGP1"], energy["P1"]);
  EXPECT_GT(energy["DGP1"], energy["DGP0"]);
  EXPECT_LT(energy["DGP1"], 1.3 * energy["P1"]);
}

TEST_F(BodiesInSpace, move_as_a_whole_with_their_grip)
{
  const auto scene = make({{"Problem/solution", "7 + 2*t"},
                           {"Problem/constraint", "7 + 2*t"},
                           {"Methods/names", "FA, DGP0, DGP1, P1"},
                           {"Reference/method", "none"},
                           {"Study/norms", "nodal L2"},
                           {"Study/decisive error", "nodal L2 | exact"},
                           {"Time/final time", "0.5"}});
  const Methods methods = choose_methods(scene, available());
  check_transient(scene, methods, 0);
  const auto records = run_study(transient_analysis({}), scene, methods).records;
  ASSERT_EQ(records.size(), 4u);
  for (const Record &record : records)
  {
    EXPECT_EQ(record.failure, "");
    EXPECT_LT(record["nodal L2 | exact"], 1e-9) << record.key.method;
  }
}

TEST_F(BodiesInSpace, are_refused_where_they_have_no_rule)
{
  expect_refused({{"Methods/names", "IPA-AC-R2"}}, "Domain/boundary = free; take");
  expect_refused({{"Problem/solution", "x"}, {"Problem/load", ""}}, "give Problem/load");
  expect_refused({{"Methods/names", "Q1"}}, "tetrahedra");
  expect_refused({{"Domain/fixed", "0, 0 : 1, 1"}}, "physical volumes collar");
  expect_refused({{"Domain/mesh", "lattice"},
                  {"Domain/boxes", "0,0,0 : 1,1,1"},
                  {"Kernel/materials", ""},
                  {"Methods/nodes", "centres"}},
                 "Domain/boundary = free with Domain/mesh = lattice");
  expect_refused({{"Kernel/coefficient", "1 + x"}, {"Kernel/materials", ""}},
                 "Kernel/materials: a coefficient for each physical volume");
  expect_refused({{"Material/model", "LPS"},
                  {"Methods/names", "P1"},
                  {"Methods/nodes", "centres"},
                  {"Kernel/limit", "Navier"},
                  {"Kernel/materials", ""},
                  {"Material/E", "1"},
                  {"Material/nu", "0.3"},
                  {"Problem/load", "0, 0, 0"},
                  {"Problem/constraint", "0, 0, 0"}},
                 "Domain/boundary = free; write Domain/boundary = constrained");
  const auto message = [&](const std::string &materials)
  {
    return in_space::refusal_of(
        [&]
        {
          const scene::Scene scene = make({{"Kernel/materials", materials}});
          (void)scene::make_problem_in_space(scene, 0, scene.study.series[0].levels[0]);
          return scene;
        });
  };
  EXPECT_NE(message("omega_soft: 1; omega_stiff: 4").find("physical volume 'collar_grip'"),
            std::string::npos);
  EXPECT_NE(message("omega_soft: 1; omega_stiff: 4; collar_grip: 1; steel: 2")
                .find("no physical volume 'steel'"),
            std::string::npos);
  EXPECT_NE(message("omega_soft: 1; omega_stiff: -4; collar_grip: 1").find("'omega_stiff' is -4"),
            std::string::npos);
}
