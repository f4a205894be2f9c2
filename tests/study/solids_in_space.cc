// Static problems in space on unions of boxes with holes: exact polynomials, rates, the cube in
// parts, estimates of references, what is written.
#include "method/box_discretisation.h"
#include "tests/report/fixture.h"
#include "tests/study/space_scene.h"

#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using report::fixture::Folder;

  const Settings l_shape = {{"Domain/boxes", "0,0,0 : 1,1/2,1/2 ; 0,0,0 : 1/2,1,1/2"}};
  const Settings with_cavity = {{"Domain/holes", "1/4,1/2,3/8 : 1/2,3/4,5/8"}};

  StudyResults solve(const Settings &solid, const Settings &more)
  {
    auto results = run(make_scene(with(solid, more)));
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.method;
    return results;
  }

  std::size_t n_found(const std::string &text, const std::string &words)
  {
    std::size_t n = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
      ++n;
    return n;
  }
} // namespace

TEST(SolidsInSpace, have_exact_solutions_where_the_moments_are_those_of_the_field)
{
  const Settings tensor = {{"Kernel/type", "bond-tensor"},
                           {"Kernel/limit", "Navier"},
                           {"Problem/solution", "x^2 + y*z, 2*x*z - y^2, z^2 + x*y"},
                           {"Methods/names", "Q1, IPA-AC-R2"}};
  const Settings fifth = {{"Methods/names", "IPA-AC-R4"}};
  const Settings second = {{"Methods/names", "Q1, IPA-AC-R2"},
                           {"Problem/solution", "x^2 + 2*y^2 - x*z + z^2"}};
  for (const Settings &solid : {l_shape, with_cavity})
    for (const Settings &more : {fifth, second, tensor})
      for (const Record &record : solve(solid, with(more, {{"Study/h", "1/8, 1/16"}})).records)
        EXPECT_LT(record["nodal Linf | exact"], 1e-11)
            << record.key.method << solid.front().value << more.front().value;
}

TEST(SolidsInSpace, count_their_own_cells_alone)
{
  for (const Record &record : solve(l_shape, {{"Methods/names", "FA, Q1"}}).records)
    EXPECT_NEAR(record["area"], 3. / 8, 1e-14);
  for (const Record &record : solve(with_cavity, {{"Methods/names", "FA"}}).records)
  {
    EXPECT_NEAR(record["area"], 1 - 1. / 64, 1e-14);
    EXPECT_EQ(record.cost.n_unknowns, record.key.level == 0 ? 504u : 4032u);
  }
  // the linear field is in both spaces, whose averages are exact up to the faces of the cavity
  for (const Record &record : solve(with_cavity, {{"Problem/solution", "3*x + 2*y - z"},
                                                  {"Methods/names", "Q1, IPA-AC-R2"}})
                                  .records)
    EXPECT_LT(record["averages L2 | exact"], 1e-12) << record.key.method;
}

TEST(SolidsInSpace, made_of_parts_of_a_cube_are_the_cube_bit_for_bit)
{
  const Settings more = {{"Methods/names", "FA, IPA-AC-R2, Q1, DGQ0"}, {"Study/h", "1/8"}};
  const auto whole = solve({}, more),
             parts = solve({{"Domain/boxes", "0,0,0 : 1/2,1,1 ; 1/2,0,0 : 1,1,1"}}, more);
  ASSERT_EQ(whole.records.size(), parts.records.size());
  for (std::size_t i = 0; i < whole.records.size(); ++i)
    for (const std::string error : {"nodal Linf | exact", "averages L2 | exact"})
      EXPECT_EQ(whole.records[i][error], parts.records[i][error]);
}

TEST(SolidsInSpace, that_are_a_horizon_apart_are_solved_each_by_itself)
{
  // two cubes are mirror images, as the field is
  const Settings more = {{"Methods/names", "IPA-AC-R2, Q1"},
                         {"Problem/solution", "(x - 3/2)^4*y^2 + z^4"},
                         {"Study/h", "1/8"}};
  const auto one = solve({}, more),
             two = solve({{"Domain/boxes", "0,0,0 : 1,1,1 ; 2,0,0 : 3,1,1"}}, more);
  for (std::size_t i = 0; i < one.records.size(); ++i)
  {
    const auto ratio = [&](const std::string &error)
    { return two.records[i][error] / one.records[i][error]; };
    EXPECT_NEAR(ratio("nodal Linf | exact"), 1, 1e-7);
    EXPECT_NEAR(ratio("averages L2 | exact"), std::sqrt(2), 1e-7);
  }
}

TEST(SolidsInSpace, are_solved_with_the_order_of_the_rule_in_few_iterations)
{
  constexpr unsigned int most_iterations = 40;
  const auto results = solve(l_shape, {{"Methods/names", "IPA-AC-R2, Q1"},
                                       {"Problem/solution", "sin(3*x + y)*cos(2*z)"},
                                       {"Study/h", "1/8, 1/16, 1/32"}});
  std::map<std::string, std::vector<double>> errors;
  for (const Record &record : results.records)
  {
    errors[record.key.method].push_back(record["nodal Linf | exact"]);
    EXPECT_LT(record.cost.n_iterations, most_iterations) << record.key.method;
  }
  for (const auto &[method, error] : errors)
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2, .25) << method;
  for (const Record &record : solve(with_cavity, {{"Methods/names", "IPA-AC-R2, Q1"}}).records)
    EXPECT_LT(record.cost.n_iterations, 2 * most_iterations) << record.key.method;
}

TEST(SolidsInSpace, need_no_values_further_than_a_horizon_from_them)
{
  // 1/r is infinite in the middle of the cavity, at a vertex
  const std::string r = "sqrt((x-1/2)^2 + (y-1/2)^2 + (z-1/2)^2)";
  for (const Record &record :
       solve({{"Domain/holes", "1/4,1/4,1/4 : 3/4,3/4,3/4"}}, {{"Methods/names", "IPA-AC-R2, Q1"},
                                                               {"Problem/solution", "1/" + r},
                                                               {"Problem/load", "0"},
                                                               {"Study/h", "1/16"},
                                                               {"Study/m", "2"}})
           .records)
    EXPECT_LT(record["nodal Linf | exact"], .05) << record.key.method;
}

TEST(SolidsInSpace, have_references_with_estimates_that_bound_their_errors)
{
  for (const Settings &solid : {l_shape, with_cavity})
    for (const std::string method : {"Q1", "DGQ0"})
    {
      const auto results = solve(solid, {{"Study/regime", "m"},
                                         {"Study/horizon", "1/4"},
                                         {"Study/h", "1/8, 1/16"},
                                         {"Methods/names", method},
                                         {"Reference/method", method},
                                         {"Study/decisive error", "averages L2 | reference"}});
      ASSERT_EQ(results.references.size(), 2u);
      for (const Record &record : results.records)
      {
        const double error = record["averages L2 | exact"],
                     estimate = results.references[record.key.level].estimate;
        EXPECT_LT(error, estimate) << method << solid.front().value;
        EXPECT_GT(error, estimate / 10) << method << solid.front().value;
      }
    }
}

TEST(SolidsInSpace, have_a_grid_of_cell_averages_at_the_centres_of_cells)
{
  // u = x: in 13 x 13 x 1 cells, every second one, which do not fill the body
  const auto results = run(make_scene(
      {{"Domain/boxes", "0,0,0 : 1,1,1/13"}, {"Study/h", "1/13"}, {"Problem/solution", "x"}}));
  ASSERT_EQ(results.solution_grids.size(), 1u);
  const SolutionGrid &grid = results.solution_grids[0];
  EXPECT_EQ(grid.n, (std::array<unsigned int, 3>{7, 7, 1}));
  EXPECT_NEAR(grid.spacing, 2. / 13, 1e-14);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(grid.upper[d], d == 2 ? 1. / 13 : 1, 1e-14);
  for (std::size_t j = 0; j < 7; ++j)
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_NEAR(grid.values.at(7 * j + i), grid.first[0] + i * grid.spacing, 1e-10);
}

TEST(SolidsInSpace, are_drawn_and_written_without_what_is_outside)
{
  const Folder folder;
  StaticsOptions options;
  options.on_finest = [&](const auto &write, const Record &)
  { write((folder.path() / "field").string()); };
  // a column on a plate, whose middle layer is the column's
  const Settings column = {{"Domain/boxes", "0,0,0 : 1,1,1/4 ; 0,0,0 : 1/4,1/4,1"}};
  const auto results = run(make_scene(with(column, {{"Study/h", "1/8"}})), options);
  ASSERT_EQ(results.maps.size(), 3u);
  const auto &map = results.maps[0].values;
  ASSERT_EQ(map.size(), 64u);
  for (std::size_t j = 0; j < 8; ++j)
    for (std::size_t i = 0; i < 8; ++i)
    {
      EXPECT_EQ(std::isnan(map[8 * j + i]), i >= 2 || j >= 2);
      EXPECT_EQ(std::isnan(results.maps[0].solution.at(8 * j + i)), i >= 2 || j >= 2);
    }
  EXPECT_EQ(results.maps[0].n_components, 1u);
  EXPECT_EQ(results.maps[1].axes, "xz"); // through the plate beside the column
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_EQ(std::isnan(results.maps[1].values.at(8 * k + i)), k >= 2);
  ASSERT_EQ(results.solution_grids.size(), 1u);
  const SolutionGrid &grid = results.solution_grids[0];
  EXPECT_EQ(grid.n, (std::array<unsigned int, 3>{8, 8, 8}));
  EXPECT_EQ(grid.spacing, .125);
  for (std::size_t j = 0; j < 8; ++j)
    for (std::size_t i = 0; i < 8; ++i) // the layers of the maps are z = 1/2 and y = 1/2
    {
      const auto same = [](double a, double b)
      { return a == b || (std::isnan(a) && std::isnan(b)); };
      EXPECT_TRUE(same(grid.values.at(8 * (8 * 4 + j) + i), results.maps[0].solution[8 * j + i]));
      EXPECT_TRUE(same(grid.values.at(8 * (8 * j + 4) + i), results.maps[1].solution[8 * j + i]));
      EXPECT_TRUE(same(grid.values.at(8 * (8 * j + i) + 4), results.maps[2].solution[8 * j + i]));
    }
  const std::string written = report::fixture::read(folder.path() / "field.vti");
  EXPECT_EQ(n_found(written, "\n32\n"), 512u - 128 - 24);
  EXPECT_EQ(n_found(written, "nan"), 0u);
  EXPECT_NE(written.find("Name=\"vtkGhostType\""), std::string::npos);
  run(make_scene({{"Study/h", "1/8"}}), options);
  EXPECT_EQ(report::fixture::read(folder.path() / "field.vti").find("vtkGhostType"),
            std::string::npos);
}

TEST(SolidsInSpace, refuse_domains_without_whole_cells_or_free_nodes)
{
  const std::vector<std::pair<Settings, std::string>> refused = {
      {{{"Domain/boxes", "0,0,0 : 1,1,1 ; 1,0,0 : 1.3,1,1"}}, "2.4 along x"},
      {{{"Domain/boxes", "0,0,0 : 1,1,1 ; 1,0,0 : 2,1"}}, "a corner without three coordinates"},
      {{{"Domain/holes", "1/4,1/4,1/4 : 1/2,1/2"}}, "a corner without three coordinates"},
      {{{"Domain/holes", "2,0,0 : 3,1,1"}}, "is outside of Domain/boxes"},
      {{{"Domain/holes", "0,0,0 : 1,1,1"}}, "no cell is left"},
      {{{"Domain/dimension", "2"},
        {"Domain/boxes", "0,0 : 1,1"},
        {"Domain/holes", "0,0,0 : 1,1,1"}},
       "Domain/holes has three coordinates"}};
  for (const auto &[settings, words] : refused)
    EXPECT_NE(message_of(settings).find(words), std::string::npos)
        << settings.back().key << ": " << message_of(settings);
  EXPECT_EQ(message_of(with_cavity), "");

  const auto thin = run(make_scene({{"Domain/boxes", "0,0,0 : 1,1/8,1 ; 0,0,0 : 1/8,1,1"},
                                    {"Methods/names", "Q1"},
                                    {"Study/h", "1/8"}}));
  EXPECT_NE(thin.records.front().failure.find("no vertex is free"), std::string::npos);
}
