#include "scene/scene.h"

#include "base/error.h"
#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  /// A whole scene, of keys that `more` does not give.
  std::string with(const std::string &more)
  {
    const auto unless = [&](const std::string &key, const std::string &text)
    { return more.find("set " + key) == std::string::npos ? text : ""; };
    return unless("solution", "subsection Problem\n set solution = x^2\nend\n") +
           unless("names", "subsection Methods\n set names = Q1\nend\n") + more;
  }

  Scene parse(const std::string &more)
  {
    return parse_scene("test.prm", with(more));
  }

  std::string section(const std::string &name, const std::string &setting)
  {
    return "subsection " + name + "\n set " + setting + "\nend\n";
  }

  void expect_error(const std::string &more, const std::string &message,
                    const std::vector<Override> &overrides = {})
  {
    try
    {
      parse_scene("test.prm", with(more), overrides);
      ADD_FAILURE() << "no error for: " << more;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
          << message << " is not in: " << error.what();
      EXPECT_EQ(std::string(error.what()).find("scene 'test.prm'"), 0u) << error.what();
    }
  }
} // namespace

TEST(Scene, defaults_make_a_delta_convergence_study)
{
  const Scene scene = parse("");
  EXPECT_EQ(scene.name, "test");
  ASSERT_EQ(scene.study.series.size(), 1u);
  EXPECT_EQ(scene.study.series[0].name, "m = 3");
  ASSERT_EQ(scene.study.series[0].levels.size(), 4u);
  EXPECT_DOUBLE_EQ(scene.study.series[0].levels[1].horizon, .15);
  EXPECT_EQ(scene.problem.case_names(), std::vector<std::string>{"u"});
  EXPECT_NEAR(make_kernel(scene, .3).limit().diffusion, .5, 1e-14);
}

TEST(Scene, one_that_nobody_filled_has_the_defaults_of_the_keys)
{
  // in memory that is not zero, so that what is left unset shows
  alignas(Scene) std::array<unsigned char, sizeof(Scene)> memory;
  memory.fill(0xbe);
  const std::unique_ptr<Scene, void (*)(Scene *)> made(::new (memory.data()) Scene,
                                                       [](Scene *scene) { scene->~Scene(); });
  const Scene &scene = *made, read = parse("");
  EXPECT_EQ(scene.domain.is_free_body, read.domain.is_free_body);
  EXPECT_EQ(scene.domain.is_floating, read.domain.is_floating);
  EXPECT_EQ(scene.kernel.structure, read.kernel.structure);
  EXPECT_EQ(scene.kernel.bulk_modulus, read.kernel.bulk_modulus);
  EXPECT_EQ(scene.kernel.constant, read.kernel.constant);
  EXPECT_EQ(scene.solver.is_full_model, read.solver.is_full_model);
  EXPECT_EQ(scene.kernel.symmetrisation, read.kernel.symmetrisation);
  EXPECT_EQ(scene.methods.nodes.perturbation, read.methods.nodes.perturbation);
  EXPECT_EQ(scene.methods.loads_are_averages, read.methods.loads_are_averages);
  EXPECT_EQ(scene.study.regime, read.study.regime);
  EXPECT_EQ(scene.reference.tolerance, read.reference.tolerance);
  EXPECT_EQ(scene.quadrature.exact_entries, read.quadrature.exact_entries);
  EXPECT_EQ(scene.quadrature.tolerance, read.quadrature.tolerance);
  EXPECT_EQ(scene.quadrature.max_refinements, read.quadrature.max_refinements);
  EXPECT_EQ(scene.geometry.backend, read.geometry.backend);
  EXPECT_EQ(scene.geometry.n_checks, read.geometry.n_checks);
  EXPECT_EQ(scene.geometry.seed, read.geometry.seed);
  EXPECT_EQ(scene.solver.is_mixed, read.solver.is_mixed);
  EXPECT_EQ(scene.solver.tolerance, read.solver.tolerance);
  EXPECT_EQ(scene.solver.max_iterations, read.solver.max_iterations);
  EXPECT_EQ(scene.output.fields, read.output.fields);
  EXPECT_EQ(scene.output.points, read.output.points);
  EXPECT_EQ(scene.expected.error_tolerance, read.expected.error_tolerance);
  EXPECT_EQ(scene.expected.rate_tolerance, read.expected.rate_tolerance);
  const Level level;
  EXPECT_EQ(level.h + level.horizon, 0);
}

TEST(Scene, printed_back_parses_to_the_same_scene)
{
  const Scene scene =
      parse(section("Study", "m = 2.5, 3") + section("Expected", "verdicts = Q1: AC") +
            section("Domain", "holes = 0.5, 0.5 : 1, 1"));
  const Scene again = parse_scene("test.prm", scene.text);
  EXPECT_EQ(again.text, scene.text);
  EXPECT_EQ(again.study.series.size(), 2u);
  EXPECT_EQ(again.domain.boxes.exclude.size(), 1u);
  EXPECT_EQ(again.expected.all.at(0).verdict, "AC");
}

TEST(Scene, cases_have_names_and_components)
{
  const Scene scene = parse_scene("t.prm", "subsection Kernel\n set type = bond-tensor\n set limit "
                                           "= Navier\nend\nsubsection Problem\n set "
                                           "solution = a: max(x, y), y; b: x > 0 ? 1 : 2, "
                                           "x\nend\nsubsection Methods\n set names = Q1\nend\n");
  ASSERT_EQ(scene.problem.solutions.size(), 2u);
  EXPECT_EQ(scene.problem.solutions[0].name, "a");
  EXPECT_EQ(scene.problem.solutions[0].expression, "max(x, y), y");
  EXPECT_EQ(scene.problem.solutions[1].expression, "x > 0 ? 1 : 2, x");
}

TEST(Scene, methods_may_be_called_by_their_other_names_wherever_they_are_named)
{
  const Scene scene = parse("subsection Methods\n set names = HHB, Q1, HHB-2\nend\n" +
                            section("Reference", "method = HHB") +
                            "subsection Expected\n set verdicts = HHB: AC; Q1: AC\n set errors = "
                            "HHB: 1 2\n set rates = HHB, m = 3: 2\n set bounds = HHB, u: 1\n "
                            "set monotone = HHB: yes\n set jitter = HHB: 0 1\n set stability = "
                            "HHB: stable\nend\n");
  EXPECT_EQ(scene.methods.names, (std::vector<std::string>{"QWJ", "Q1", "HHB-2"}));
  EXPECT_EQ(scene.reference.method, "QWJ");
  EXPECT_EQ(scene.expected.all.at(1).method, "Q1");
  EXPECT_EQ(scene.expected.all.size(), 8u);
  for (const Expected &one : scene.expected.all)
    if (one.method != "Q1")
    {
      EXPECT_EQ(one.method, "QWJ") << one.text;
      EXPECT_EQ(one.text.substr(0, 3), "HHB"); // as it was given
    }
}

TEST(Scene, published_names_stand_for_one_method_or_are_refused_with_the_choice)
{
  EXPECT_EQ(parse("subsection Methods\n set names = pa-hhb, PV-PDLAMMPS, PDLAMMPS, FV, "
                  "GFDM\nend\n")
                .methods.names,
            (std::vector<std::string>{"QWJ", "LAMMPS", "LAMMPS", "FA", "GFD"}));
  for (const std::string name : {"PV", "pa", "partial volume"})
    try
    {
      parse("subsection Methods\n set names = FA, " + name + "\nend\n");
      FAIL() << name;
    }
    catch (const InputError &error)
    {
      for (const std::string part :
           {"Methods/names", name.c_str(), "several rules", "PA-AC, QWJ, LAMMPS"})
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(Scene, overrides_win_over_the_file_and_json_is_read_too)
{
  EXPECT_EQ(parse_scene("t.prm", with(""), {{"Study/m", "5"}}).study.series[0].name, "m = 5");
  const std::string file = ::testing::TempDir() + "scene_test.json";
  std::ofstream(file)
      << R"({"Problem": {"solution": "x"}, "Methods": {"names": "Q1"}, "Study": {"m": "4"}})";
  EXPECT_EQ(read_scene(file).study.series[0].name, "m = 4");
}

TEST(Scene, templates_parse_and_describe_knows_every_section)
{
  for (const std::string model : {"scalar", "tensor", "LPS", "variational"})
    EXPECT_NO_THROW(parse_scene("template.prm", scene_template(model)));
  EXPECT_THROW(scene_template("fluid"), InputError);
  EXPECT_NE(describe("Study/m").find("horizon / h"), std::string::npos);
  EXPECT_NE(describe("Kernel").find("Kernel/bulk modulus"), std::string::npos);
  try
  {
    (void)describe("Kernel/size");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("Kernel/type"), std::string::npos);
  }
}

TEST(SceneErrors, unknown_keys_and_wrong_types)
{
  expect_error(section("Study", "mesh = 0.1"), "mesh");
  expect_error("subsection Sudy\n set h = 1\nend\n",
               "key 'Sudy/h' is not known: there is no section 'Sudy'; the sections are "
               "Domain, Random, Kernel");
  expect_error(section("Geometry", "checks = many"), "checks");
  expect_error(section("Kernel", "type = gauss"), "linear-decay");
  expect_error(
      section("Study", "h = 0.1, fine"),
      "Study/h = '0.1, fine' is not allowed, for 'fine' in it; write numbers above 0 such as 0.05 "
      "or 1e-3, separated by ','");
  expect_error("", "key 'Study/hh' is not known; write one of: Study/regime, Study/h",
               {{"Study/hh", "1"}});
  expect_error("", "Solver/tolerance = 'small' is not allowed", {{"Solver/tolerance", "small"}});
}

TEST(SceneErrors, levels_that_do_not_fit)
{
  expect_error(section("Study", "m = 0.5"), "the horizon 0.05 is smaller than the mesh size 0.1");
  expect_error(section("Study", "h = 0.3"), "h = 0.3 does not divide the box");
  expect_error(section("Study", "h = -0.1"), "write numbers above 0");
  expect_error(section("Domain", "collar = 0.1"),
               "Domain/interaction domain = 0.1 is thinner than the horizon 0.3");
  expect_error(section("Study", "regime = delta-m"), "Study/m has 1 values and Study/h has 4");
  expect_error(section("Domain", "boxes = 0, 0 : 1"),
               "'0, 0 : 1' is not allowed, for '1' in it; write boxes");
  expect_error(section("Domain", "boxes = 1, 1 : 0, 2"), "is empty; its second corner");
}

TEST(SceneErrors, kernels_and_models_that_do_not_fit)
{
  expect_error(section("Kernel", "limit = Navier"),
               "Navier does not fit the scalar kernel 'linear-decay'");
  expect_error(section("Kernel", "type = bond-tensor"), "does not fit the bond tensor");
  expect_error("subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n",
               "has 1 component(s), but the bond tensor needs 2");
  expect_error(section("Problem", "solution = x, y"),
               "has 2 component(s), but the scalar kernel needs 1");
  expect_error(section("Kernel", "type = polynomial"), "needs a profile; give Kernel/coefficients");
  expect_error(section("Kernel", "coefficients = 1, 2"),
               "is for polynomial, bond-tensor polynomial");
  expect_error(section("Kernel", "type = gaussian"), "needs a profile; give Kernel/width");
  expect_error(section("Kernel", "type = gaussian\n set width = 0"),
               "Kernel/width = 0 horizons must be 0.05 or more");
  expect_error(section("Kernel", "type = gaussian\n set width = wide"), "Kernel/width");
  expect_error(section("Kernel", "width = 1"), "Kernel/width is for gaussian, exponential, bond-");
  expect_error(section("Kernel", "type = table"), "give Kernel/table file");
  expect_error(section("Kernel", "type = table\n set table file = none.csv"), "none.csv");
}

TEST(SceneErrors, tables_of_kernels_name_file_and_row)
{
  const auto file = std::filesystem::path(testing::TempDir()) / "rho.csv";
  const auto expect = [&](const std::string &rows, const std::string &message)
  {
    std::ofstream(file) << "t, rho\n" << rows;
    expect_error(section("Kernel", "type = table\n set table file = " + file.string()), message);
  };
  expect("0, 1\n", "rho.csv: kernel: the table of the radial profile has 1 rows; give 2 to 1000");
  expect("0, 1\n.5, .4\n.5, .3\n1, 0\n", "row 3 of the table of the radial profile has t = 0.5");
  expect("0, 1\n.9, 0\n", "the last t must be 1");
  expect("0, 1\n1, inf\n", "rho.csv");
  expect_error(section("Kernel", "type = table\n set table file = none.csv"),
               "Kernel/table file = ");
}

TEST(SceneErrors, expressions_and_targets)
{
  expect_error(section("Problem", "solution = x^^2"), "Problem/solution = 'x^^2' does not parse");
  expect_error(section("Problem", "solution = sin(z)"),
               "write a muParser expression in x, y, pi, delta");
  expect_error(section("Problem", "solution ="), "needs Problem/solution");
  const std::string load = section("Problem", "solution =\n set load = 1\n set constraint = 0");
  expect_error(load,
               "nodal Linf | exact' needs Problem/solution, which is empty; give the solution");
  expect_error(
      load + section("Reference", "method = Q1"),
      "write Study/norms = averages L2 and Study/decisive error = averages L2 | reference");
  expect_error(section("Study", "norms = H1"), "'H1' is not a norm");
  expect_error(section("Study", "decisive error = nodal Linf"), "must be 'norm | target'");
  expect_error(section("Study", "decisive error = averages L2 | reference"),
               "Reference/method, which is none");
  expect_error(section("Reference", "mesh size = 0.01"),
               "Reference/mesh size = 0.01 needs Reference/method");
  expect_error(section("Reference", "mesh size = 0.01\n set method = Q1") +
                   section("Domain", "mesh = hyper_ball"),
               "Reference/mesh size = 0.01 needs a mesh of Domain/boxes");
  expect_error(section("Methods", "names ="), "Methods/names is empty");
  expect_error(section("Expected", "verdicts = Q1 AC"), "has no ':'");
  expect_error(section("Expected", "errors = Q1, case9: 1"),
               "'case9' in 'Q1, case9: 1' is neither a case");
}

TEST(SceneErrors, what_would_merge_or_mislead_silently)
{
  expect_error(section("Study", "h = 0.05, 0.1"),
               "Study/h must be strictly decreasing (series 'm = 3'); write the coarsest level "
               "first, such as 0.1");
  expect_error(section("Study", "h = 0.1, 0.1, 0.05"), "strictly decreasing");
  expect_error(section("Study", "m = 3, 3"), "the series 'm = 3' occurs twice");
  expect_error(
      "subsection Study\n set regime = horizon\n set h = 0.1\n set horizon = 0.2, 0.4\nend\n",
      "Study/horizon must be strictly decreasing");
  expect_error(section("Problem", "solution = x; y"), "two cases are called 'u'");
  expect_error(section("Problem", "solution = y = x"), "has a single '='");
  expect_error(section("Study", "decisive error = nodal Linf | local"),
               "needs Problem/local solution");
  expect_error(section("Study", "h = 1e-6"), "cells along a side, more than 10000");
  expect_error(section("Expected", "verdicts = Q1: fine"), "'fine' is not a verdict");
  expect_error(section("Expected", "errors = Q1:"), "has no numbers");
  expect_error("", "Solver/tolerance = '2' is not allowed", {{"Solver/tolerance", "2"}});
  EXPECT_NO_THROW(parse(section("Problem", "solution = x >= 0.5 ? 1 : y")));
}

TEST(SceneErrors, a_file_that_is_not_there)
{
  try
  {
    (void)read_scene("no/such/scene.prm");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(std::string(error.what()),
              "scene 'no/such/scene.prm' is not there: no such file in '" +
                  (std::filesystem::current_path() / "no/such").string() +
                  "'; give a .prm or .json file");
  }
}

TEST(Materials, are_those_of_the_cells_and_of_nothing_outside)
{
  // a square of steel and one of wood beside it, with a gap of .5 to one more
  const geometry::Mesh mesh{
      {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {2.5, 0}, {3, 0}, {3, 1}, {2.5, 1}},
      {{{0, 1, 4, 3}, 4, true, 1}, {{1, 2, 5, 4}, 4, false, 0}, {{6, 7, 8, 9}, 4, false, 1}},
      {"wood", "steel"},
      {}};
  Scene scene = parse("");
  scene.kernel.materials = {{"steel", 200}, {"wood", 12}};
  const auto coefficient = make_coefficient(scene, mesh);
  ASSERT_TRUE(coefficient);
  EXPECT_EQ(coefficient->at({.5, .5}), 200);
  EXPECT_EQ(coefficient->at({1.5, .9}), 12);
  EXPECT_EQ(coefficient->at({2.9, .1}), 200);
  EXPECT_EQ(coefficient->at({1, .3}), 200); // where the domain meets its collar: the domain's
  try
  {
    (void)coefficient->at({2.25, .5});
    ADD_FAILURE() << "a material in the gap";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("(2.25, 0.5) lies outside"), std::string::npos)
        << error.what();
  }
}

TEST(Scene, keeps_a_file_whose_keys_an_override_makes_useless)
{
  const auto file = [](const std::string &regime)
  {
    return "subsection Study\n  set regime = " + regime + "\n  set horizon = 0.2\n" +
           "  set h = 0.1, 0.05\nend\nsubsection Problem\n  set solution = x\nend\n" +
           "subsection Methods\n  set names = FA\nend\n";
  };
  const Scene scene = parse_scene("t.prm", file("m"), {{"Study/regime", "delta"}});
  EXPECT_EQ(scene.study.regime, Regime::delta);
  // its text is that of a scene that stands by itself
  EXPECT_EQ(parse_scene("t.prm", scene.text).study.regime, Regime::delta);
  const auto expect_refused = [](const std::string &text, const std::vector<Override> &overrides)
  {
    try
    {
      (void)parse_scene("t.prm", text, overrides);
      ADD_FAILURE() << "not refused";
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("Study/horizon = 0.2 has no effect here"),
                std::string::npos)
          << error.what();
    }
  };
  expect_refused(file("delta"), {});
  expect_refused(file("delta"), {{"Study/h", "0.1"}});
  expect_refused(scene.text, {{"Study/horizon", "0.2"}});
}
