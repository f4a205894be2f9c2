// Galerkin methods on hexahedra of gmsh files, from the scene to verdicts.
#include "method/linear_equations.h"
#include "scene/problem.h"
#include "study/preflight.h"
#include "study/transient.h"
#include "tests/geometry/moved_hexahedra.h"
#include "tests/geometry/tetrahedra_file.h"
#include "tests/study/space_scene.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using in_space::available;
  using in_space::run;
  using in_space::Settings;
  using in_space::with;

  class ProblemsOnHexahedra : public testing::Test
  {
  protected:
    /// The unit cube and a layer of two hexahedra around it, n along an edge, vertices moved by up
    /// to a tenth of an edge.
    std::string file(int n, double move = .1) const
    {
      const double h = 1. / n;
      return folder_.write(
          "cube_" + std::to_string(n) + ".msh",
          tests::msh_22(tests::moved_hexahedra({{{{{0, 0, 0}, {1, 1, 1}}}, {}}, h}, 2, move * h)));
    }

    scene::Scene make(int n, const Settings &more) const
    {
      Settings settings = {{"Domain/dimension", "3"},
                           {"Domain/mesh", file(n)},
                           {"Kernel/type", "constant"},
                           {"Kernel/limit", "-Laplace"},
                           {"Problem/solution", "sin(x + y/2)*cos(z)"},
                           {"Methods/names", "Q1"},
                           {"Study/m", "1.2"},
                           {"Study/h", "1/" + std::to_string(n)},
                           {"Study/norms", "nodal Linf, nodal L2, averages L2"},
                           {"Study/decisive error", "averages L2 | exact"}};
      return scene::parse_scene("body.prm", "", in_space::last_of_each(with(settings, more)));
    }

    std::string message_of(const Settings &settings) const
    {
      return in_space::refusal_of([&] { return make(3, settings); });
    }

    void expect_refused(const Settings &settings, const std::string &words) const
    {
      const std::string message = message_of(settings);
      EXPECT_NE(message.find(words), std::string::npos) << words << "\nis not in\n" << message;
    }

    double error_of(int n, const std::string &method, const std::string &norm,
                    const Settings &more = {}) const
    {
      const auto results = run(make(n, with(more, {{"Methods/names", method}})));
      const Record &record = results.records.front();
      EXPECT_EQ(record.failure, "");
      return record[norm];
    }

    const tests::TextFolder folder_{"hexahedra_of_files"};
  };
} // namespace

TEST_F(ProblemsOnHexahedra, are_exact_for_linear_fields)
{
  const Settings linear = {{"Problem/solution", "3*x + 2*y - z + 1"}};
  EXPECT_LT(error_of(3, "Q1", "nodal Linf | exact", linear), 1e-11);
  EXPECT_LT(error_of(3, "Q1", "averages L2 | exact", linear), 1e-11);
}

TEST_F(ProblemsOnHexahedra, converge_at_rate_2_with_Q1_and_not_with_DGQ0)
{
  const auto rate = [&](const std::string &method, const std::string &norm)
  { return std::log2(error_of(3, method, norm) / error_of(6, method, norm)); };
  EXPECT_NEAR(rate("Q1", "nodal L2 | exact"), 2, .3);
  EXPECT_NEAR(rate("Q1", "averages L2 | exact"), 2, .3);
  EXPECT_LT(rate("DGQ0", "averages L2 | exact"), 1.3);
}

TEST_F(ProblemsOnHexahedra, report_what_the_last_refinement_changes)
{
  const std::string wave = "sin(x + y/2)*cos(z)";
  const auto record_with = [&](const std::string &tolerance, const std::string &solution)
  {
    return run(make(3, {{"Quadrature/tolerance", tolerance}, {"Problem/solution", solution}}))
        .records.front();
  };
  const Record settled = record_with("1e-3", wave), first = record_with("0", wave);
  // relative to u itself, which a constant makes larger
  const Record small = record_with("0.5", wave), large = record_with("0.5", wave + " + 1000");
  EXPECT_EQ(small["outer refinements"], large["outer refinements"]);
  EXPECT_LT(large["outer change"], small["outer change"] / 500);

  EXPECT_GT(settled["outer change"], 0);
  EXPECT_LE(settled["outer change"], 1e-3);
  EXPECT_GT(settled["outer refinements"], 0);
  EXPECT_EQ(first["outer refinements"], 0);
  EXPECT_TRUE(std::any_of(settled.notes.begin(), settled.notes.end(),
                          [](const std::string &note) {
                            return note.find("the last refinement changes the solution by") !=
                                   std::string::npos;
                          }));
  const Record failed =
      run(make(3, {{"Quadrature/tolerance", "1e-14"}, {"Quadrature/max refinements", "1"}}))
          .records.front();
  EXPECT_NE(failed.failure.find("raise Quadrature/max refinements"), std::string::npos)
      << failed.failure;
}

TEST_F(ProblemsOnHexahedra, take_methods_on_tetrahedra_and_meshfree_rules_too)
{
  const Settings linear = {{"Problem/solution", "3*x + 2*y - z + 1"}};
  EXPECT_LT(error_of(3, "P1", "averages L2 | exact", linear), 1e-11);
  EXPECT_LT(error_of(3, "Q1", "nodal Linf | exact",
                     with(linear, {{"Kernel/type", "gaussian"}, {"Kernel/width", ".5"}})),
            1e-11);
  EXPECT_LT(error_of(3, "IPA-AC-R2", "nodal Linf | exact",
                     with(linear, {{"Methods/nodes", "mesh"}, {"Study/m", "1.8"}})),
            1e-10);
}

TEST_F(ProblemsOnHexahedra, move_with_Q1_and_hold_fields_that_are_linear_in_space)
{
  const scene::Scene scene = make(3, {{"Problem/solution", "(1 + x)*sin(2*t) + y - z*t^2"},
                                      {"Methods/names", "Q1, DGQ0"},
                                      {"Study/norms", "nodal L2"},
                                      {"Study/decisive error", "nodal L2 | exact"},
                                      {"Time/final time", "0.5"},
                                      {"Time/schemes", "Runge-Kutta"}});
  const Methods methods = choose_methods(scene, available());
  EXPECT_NO_THROW(check_memory_of_motion(scene, methods, 0));
  const auto records = run_study(transient_analysis({}), scene, methods).records;
  ASSERT_EQ(records.size(), 2u);
  EXPECT_LT(records[0]["nodal L2 | exact"], 1e-9) << records[0].failure;
  EXPECT_GT(records[1]["nodal L2 | exact"], 1e-4) << records[1].failure;
}

TEST_F(ProblemsOnHexahedra, are_refused_where_methods_or_settings_do_not_fit)
{
  EXPECT_EQ(message_of({}), "");
  EXPECT_EQ(message_of({{"Methods/names", "DGQ0"}}), "");
  expect_refused({{"Methods/names", "Q2"}}, "are hexahedra; take Q1, DGQ0");
  expect_refused(
      {{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}, {"Problem/solution", "x, y, z"}},
      "by P1, DGP0, DGP1 and DGQ0; take these");
  EXPECT_EQ(message_of({{"Kernel/type", "gaussian"}, {"Kernel/width", ".5"}}), "");
  expect_refused({{"Methods/names", "FA"}}, "write Methods/nodes = mesh (the centroids");
  // quadrature is that of Q1 alone
  const Settings tight = {{"Quadrature/tolerance", "1e-5"}};
  for (const char *const names : {"Q1", "DGQ0, q1", "all"})
    EXPECT_EQ(message_of(with(tight, {{"Methods/names", names}})), "") << names;
  EXPECT_EQ(message_of(with(tight, {{"Methods/names", "DGQ0"}, {"Reference/method", "Q1"}})), "");
  for (const char *const names : {"DGQ0", "P1, DGP0, DGP1"})
    expect_refused(with(tight, {{"Methods/names", names}}),
                   "Quadrature/tolerance = 1e-5 has no effect here: it needs two dimensions; "
                   "in three dimensions only Q1 on hexahedra has outer quadrature");
  expect_refused({{"Methods/names", "DGQ0"}, {"Quadrature/max refinements", "2"}},
                 "Quadrature/max refinements = 2 has no effect here");
}
