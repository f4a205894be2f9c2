// Galerkin methods on tetrahedra, from the scene to verdicts.
#include "method/linear_equations.h"
#include "scene/problem.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
} // namespace

TEST(StaticsOnTetrahedra, are_exact_at_vertices_for_quadratic_fields)
{
  // second moments are those of the local limit on any lattice, whatever the quadrature
  const std::string quadratic = "x^2 - 2*y*z + 3*z^2 + x - 1";
  for (const Settings &settings :
       {Settings{{"Study/m", "2.3"}, {"Kernel/type", "1/r"}},
        Settings{{"Study/m", "2"}, {"Domain/holes", "1/4,1/2,1/2 : 1/2,3/4,1"}}})
  {
    const auto results = run(make_scene(with(
        settings, {{"Methods/names", "P1"}, {"Problem/solution", quadratic}, {"Study/h", "1/8"}})));
    ASSERT_EQ(results.records.front().failure, "");
    EXPECT_LT(results.records.front()["nodal Linf | exact"], 1e-11) << settings.front().value;
  }
}

namespace
{
  const Settings bond_based = {{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}};
  const Settings state_based = {{"Kernel/type", "1/r"},
                                {"Kernel/limit", "Navier"},
                                {"Material/model", "LPS"},
                                {"Material/E", "1"},
                                {"Material/nu", "0.35"}};
} // namespace

TEST(StaticsOnTetrahedra, of_solids_are_exact_at_vertices_for_quadratic_fields)
{
  for (const Settings &solid : {bond_based, state_based})
  {
    const auto results =
        run(make_scene(with(solid, {{"Methods/names", "P1"},
                                    {"Problem/solution", "x^2 + y*z - 1, z^2 - x, x*y + 2*y^2"},
                                    {"Domain/boxes", "0,0,0 : 1,1,1; 0,0,1 : 1/2,1,3/2"},
                                    {"Study/m", "1.5"},
                                    {"Study/h", "1/4"}})));
    ASSERT_EQ(results.records.front().failure, "");
    EXPECT_LT(results.records.front()["nodal Linf | exact"], 1e-11);
  }
}

TEST(StaticsOnTetrahedra, of_solids_have_linear_fields_on_moved_ones_and_errors_like_those_of_cubes)
{
  const Settings moved = {{"Domain/boxes", "0,0,0 : 3/4,3/4,3/4"},
                          {"Methods/names", "P1"},
                          {"Methods/perturbation", "0.2"},
                          {"Problem/solution", "x + 2*y - z, 3*z - y, x"},
                          {"Study/m", "1"},
                          {"Study/h", "1/4"}};
  for (const auto &[solid, method] :
       {std::pair(bond_based, "P1"), {bond_based, "DGP1"}, {state_based, "P1"}})
  {
    const auto results = run(make_scene(with(solid, with(moved, {{"Methods/names", method}}))));
    ASSERT_EQ(results.records.front().failure, "") << method;
    EXPECT_LT(results.records.front()["averages L2 | exact"], 1e-11) << method;
  }
  for (const Settings &solid : {bond_based, state_based})
  {
    const auto records =
        run(make_scene(with(solid, {{"Methods/names", "P1, Q1"},
                                    {"Problem/solution", "x^3*y^2, y^2*z^3, x^2*z + y^3"},
                                    {"Study/m", "1"},
                                    {"Study/h", "1/4"}})))
            .records;
    ASSERT_EQ(records.size(), 2u);
    EXPECT_NEAR(records[0]["averages L2 | exact"] / records[1]["averages L2 | exact"], 1.25, .35);
  }
}

TEST(StaticsOnTetrahedra, refuse_solids_that_they_have_no_entries_of)
{
  const auto message = [](const Settings &solid, const std::string &method)
  {
    try
    {
      run(make_scene(with(solid, {{"Methods/names", method},
                                  {"Problem/solution", "x, y, z"},
                                  {"Study/m", "1"},
                                  {"Study/h", "1/4"}})));
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(
      message(with(state_based, {{"Kernel/type", "constant"}}), "P1").find("Kernel/type = 1/r"),
      std::string::npos);
}

TEST(StaticsOnTetrahedra, have_exact_averages_for_linear_fields)
{
  const auto results = run(make_scene({{"Problem/solution", "3*x + 2*y - z"},
                                       {"Methods/names", "P1"},
                                       {"Study/m", "2"},
                                       {"Study/h", "1/8"}}));
  for (const Record &record : results.records)
    EXPECT_LT(record["averages L2 | exact"], 1e-12);
}

TEST(StaticsOnTetrahedra, converge_like_those_on_cubes)
{
  const auto errors = [](const std::string &methods, const std::string &h, const std::string &error)
  {
    std::map<std::string, std::vector<double>> found;
    for (const Record &record :
         run(make_scene({{"Methods/names", methods}, {"Study/m", "2"}, {"Study/h", h}})).records)
    {
      EXPECT_EQ(record.failure, "");
      found[record.key.method].push_back(record[error]);
    }
    return found;
  };
  const auto linear = errors("P1, Q1", "1/8, 1/16", "nodal Linf | exact");
  EXPECT_NEAR(std::log2(linear.at("P1")[0] / linear.at("P1")[1]), 2, .25);
  EXPECT_NEAR(linear.at("P1")[1] / linear.at("Q1")[1], 1, .5);
  // constants on cells are not compatible on either, and stay far away
  const auto constant = errors("DGP0, DGQ0", "1/6, 1/12", "nodal Linf | exact");
  for (const auto &[method, found] : constant)
    EXPECT_LT(std::log2(found[0] / found[1]), .6) << method;
}

TEST(StaticsOnTetrahedra, may_be_the_reference_with_an_estimate_that_bounds_the_error)
{
  const auto results = run(make_scene({{"Study/regime", "m"},
                                       {"Study/horizon", "1/4"},
                                       {"Study/h", "1/6"},
                                       {"Domain/boxes", "0,0,0 : 1,1,1/2"},
                                       {"Methods/names", "P1"},
                                       {"Reference/method", "P1"},
                                       {"Study/decisive error", "averages L2 | reference"}}));
  ASSERT_EQ(results.references.size(), 1u);
  const double error = results.records.front()["averages L2 | exact"];
  EXPECT_LT(error, results.references.front().estimate);
  EXPECT_GT(error, results.references.front().estimate / 10);
}

TEST(StaticsOnTetrahedra, that_are_discontinuous_and_moved_are_exact_for_linear_fields)
{
  const auto results = run(make_scene({{"Problem/solution", "3*x + 2*y - z + 1"},
                                       {"Methods/names", "DGP1"},
                                       {"Methods/perturbation", "0.15"},
                                       {"Domain/boxes", "0,0,0 : 1/2,1/2,1/2"},
                                       {"Study/m", "1.2"},
                                       {"Study/norms", "nodal Linf, averages L2"},
                                       {"Study/h", "1/4"}}));
  const Record &record = results.records.front();
  ASSERT_EQ(record.failure, "");
  EXPECT_LT(record["nodal Linf | exact"], 1e-11);
  EXPECT_LT(record["averages L2 | exact"], 1e-11);
  EXPECT_TRUE(std::any_of(record.notes.begin(), record.notes.end(),
                          [](const std::string &note) {
                            return note.find("jumps are integrated by Gauss rules") !=
                                   std::string::npos;
                          }));
}

TEST(StaticsOnTetrahedra, say_how_entries_are_made_and_what_theory_says)
{
  const auto results =
      run(make_scene({{"Methods/names", "P1"}, {"Study/m", "2"}, {"Study/h", "1/8"}}));
  const Record &record = results.records.front();
  EXPECT_TRUE(std::any_of(record.notes.begin(), record.notes.end(),
                          [](const std::string &note)
                          { return note.find("exact to round-off") != std::string::npos; }));
}

TEST(StaticsOnTetrahedra, take_kernels_that_are_functions_and_say_so)
{
  const auto results = run(make_scene({{"Problem/solution", "3*x + 2*y - z + 1"},
                                       {"Kernel/type", "exponential"},
                                       {"Kernel/width", ".4"},
                                       {"Methods/names", "P1"},
                                       {"Domain/boxes", "0,0,0 : 1/2,1/2,1/2"},
                                       {"Study/m", "1.2"},
                                       {"Study/h", "1/4"}}));
  const Record &record = results.records.front();
  ASSERT_EQ(record.failure, "");
  EXPECT_LT(record["nodal Linf | exact"], 1e-11);
  EXPECT_TRUE(std::any_of(record.notes.begin(), record.notes.end(),
                          [](const std::string &note)
                          { return note.find("Chebyshev series of") != std::string::npos; }));
}

TEST(MethodsOnTetrahedra, are_refused_where_they_have_no_entries)
{
  const Settings p1 = {{"Methods/names", "P1"}};
  EXPECT_EQ(message_of(p1), "");
  EXPECT_EQ(message_of({{"Methods/names", "DGP0"}}), "");
  const auto message = [&](const Settings &more) { return message_of(with(p1, more)); };
  const auto has = [](const std::string &text, const std::string &part)
  { return text.find(part) != std::string::npos; };
  EXPECT_EQ(message({{"Kernel/type", "gaussian"}, {"Kernel/width", ".5"}}), "");
  for (const std::string name : {"P2", "DGP2", "P1-quadrature", "DGP1-quadrature"})
    EXPECT_TRUE(has(message_of({{"Methods/names", name}}), name)) << name;
}

TEST(MethodsOnTetrahedra, are_not_among_all)
{
  std::vector<std::string> names;
  for (const auto &method : choose_methods(make_scene({{"Methods/names", "all"}}), available()))
    names.push_back(method->name());
  EXPECT_EQ(std::count(names.begin(), names.end(), "Q1"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "P1"), 0);
}

TEST(MethodsOnTetrahedra, have_the_memory_that_is_foretold)
{
  struct Case
  {
    std::string name;
    int n, m;
  };
  for (const auto &[name, n, m] :
       {Case{"P1", 20, 2}, {"DGP0", 10, 2}, {"DGP1", 4, 2}, {"DGP1", 2, 3}})
  {
    const auto scene = make_scene({{"Study/h", "1/" + std::to_string(n)},
                                   {"Study/m", std::to_string(m)},
                                   {"Methods/names", name}});
    method::ProblemSize size;
    size.level = scene.study.series.front().levels.front();
    size.extents = {static_cast<double>(n), static_cast<double>(n)};
    size.depth = n;
    const double expected = find_method(available(), name, "test")->expected_bytes(size),
                 peak = static_cast<double>(run(scene).records.front().cost.peak_bytes);
    EXPECT_GT(expected, peak / 2) << name << " " << m;
    EXPECT_LT(expected, peak * 2) << name << " " << m;
    RecordProperty(name + std::to_string(m), std::to_string(expected / peak));
  }
}

TEST(StaticsOnTetrahedra, that_are_moved_are_exact_for_linear_fields)
{
  const auto results = run(make_scene({{"Problem/solution", "3*x + 2*y - z + 1"},
                                       {"Methods/names", "P1"},
                                       {"Methods/perturbation", "0.15"},
                                       {"Domain/boxes", "0,0,0 : 1,3/4,1/2"},
                                       {"Study/m", "1.5"},
                                       {"Study/norms", "nodal Linf, averages L2"},
                                       {"Study/h", "1/4"}}));
  const Record &record = results.records.front();
  ASSERT_EQ(record.failure, "");
  EXPECT_LT(record["nodal Linf | exact"], 1e-11);
  EXPECT_LT(record["averages L2 | exact"], 1e-11); // of all parts of cells in cubes
  EXPECT_TRUE(std::any_of(record.notes.begin(), record.notes.end(),
                          [](const std::string &note)
                          { return note.find("a sample of entries") != std::string::npos; }));
}

TEST(StaticsOnTetrahedra, that_are_moved_far_have_exact_entries)
{
  for (const std::string method : {"P1", "DGP0"})
  {
    const auto results = run(make_scene({{"Methods/names", method},
                                         {"Methods/perturbation", "0.3"},
                                         {"Domain/boxes", "0,0,0 : 1/2,1/2,1/2"},
                                         {"Study/m", "1.5"},
                                         {"Study/h", "1/4"}}));
    const Record &record = results.records.front();
    ASSERT_EQ(record.failure, "");
    EXPECT_TRUE(std::any_of(record.notes.begin(), record.notes.end(),
                            [](const std::string &note)
                            { return note.find("exact to round-off") != std::string::npos; }));
  }
}

TEST(StaticsOnTetrahedra, that_are_moved_lose_little)
{
  const auto error = [](const std::string &perturbation)
  {
    const auto results = run(make_scene({{"Methods/names", "P1"},
                                         {"Methods/perturbation", perturbation},
                                         {"Domain/boxes", "0,0,0 : 1,3/4,1/2"},
                                         {"Study/m", "1.5"},
                                         {"Study/norms", "nodal L2, averages L2"},
                                         {"Study/decisive error", "averages L2 | exact"},
                                         {"Study/h", "1/4"}}));
    return results.records.front()["averages L2 | exact"];
  };
  const double regular = error("0"), moved = error("0.15");
  EXPECT_NE(regular, moved);
  EXPECT_LT(moved, 1.5 * regular);
}

TEST(StaticsOnTetrahedra, show_their_equations)
{
  const auto scene = make_scene({{"Study/h", "1/4"}, {"Study/m", "1.5"}});
  const auto problem =
      scene::make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
  const auto discretisation = find_method(available(), "P1", "test")->discretise_in_space(problem);
  const auto shown = dynamic_cast<const method::HasLinearEquations<3> *>(discretisation.get());
  ASSERT_NE(shown, nullptr);
  const auto equations = shown->equations(problem);
  EXPECT_EQ(equations.n_free, 27u);
  EXPECT_EQ(equations.rows.n_rows(), 27u);
  EXPECT_EQ(equations.constraint.size(), equations.nodes.size() - 27);
  ASSERT_EQ(equations.load.size(), 27u);
  for (std::size_t row = 0; row < 27; ++row)
  {
    // in rows of linear fields nothing is left, and the local limit of the load's test is h³ b
    double sum = 0;
    for (std::size_t k = equations.rows.start[row]; k < equations.rows.start[row + 1]; ++k)
      sum += equations.rows.value[k] *
             (equations.nodes[equations.rows.column[k]] * dealii::Point<3>(1, 2, 3) + 1);
    EXPECT_NEAR(sum, 0, 1e-13);
    EXPECT_NEAR(equations.load[row] * 64, problem.load(equations.nodes[row], 0), .5);
  }
}
