// Static solutions in space on many ranks: errors, estimates, maps, values and files are those of
// one rank.
#include "study/memory_estimate.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using base::Communicator;

  constexpr double rounding = 1e-12;

  struct Found
  {
    StudyResults results;
    std::vector<double> at_points;
    std::vector<double> fields; ///< numbers of VTK files, on the first rank
  };

  /// Numbers of a file.
  void read_numbers(const std::string &file, std::vector<double> &numbers)
  {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
    {
      std::istringstream words(line);
      for (double value; words >> value;)
        numbers.push_back(value);
    }
  }

  Found find(const Settings &settings, const Communicator &ranks)
  {
    Found found;
    const scene::Scene scene =
        make_scene(with({{"Solver/tolerance", "1e-14"}, {"Study/h", "1/4, 1/6"}}, settings));
    const std::string stem =
        (std::filesystem::temp_directory_path() / ("distributed_" + std::to_string(getpid())))
            .string();
    StaticsOptions options;
    options.ranks = ranks;
    options.points_in_space = [](const problem::Problem<3> &) {
      return std::vector<dealii::Point<3>>{{.3, .2, .1}, {.5, .25, .75}, {0, .5, 1}};
    };
    options.on_values = [&](const ValuesAtPoints &values, const Record &)
    {
      for (const auto *list : {&values.values, &values.estimate, &values.gradient})
        found.at_points.insert(found.at_points.end(), list->begin(), list->end());
    };
    options.on_finest =
        [&](const std::function<void(const std::string &)> &write_field, const Record &)
    {
      if (ranks.rank() != 0)
        return;
      write_field(stem);
      read_numbers(stem + ".vti", found.fields);
      std::filesystem::remove(stem + ".vti");
    };
    const Methods all = available();
    RunControl control;
    control.ranks = ranks;
    found.results =
        run_study(statics_analysis(all, options), scene, choose_methods(scene, all), control);
    return found;
  }

  void expect_equal(const std::vector<double> &found, const std::vector<double> &expected,
                    double size, const std::string &what)
  {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const double difference = std::abs(found[i] - expected[i]);
      EXPECT_TRUE(difference < rounding * size || (std::isnan(found[i]) && std::isnan(expected[i])))
          << what << ", " << i << ": " << found[i] << ", " << expected[i];
    }
  }

  void expect_equal(const ErrorEstimate &found, const ErrorEstimate &expected)
  {
    EXPECT_NEAR(found.h_change, expected.h_change, rounding);
    EXPECT_NEAR(found.coarse_change, expected.coarse_change, rounding);
    EXPECT_NEAR(found.estimate, expected.estimate, rounding);
  }

  /// @param distributed  the methods whose work is shared
  void expect_same_on_all_ranks(const Settings &settings, const std::string &distributed)
  {
    const Found together = find(settings, Communicator::all());
    if (Communicator::all().rank() != 0)
      return; // numbers are reduced, and files written by the first rank
    const Found alone = find(settings, Communicator::alone());
    ASSERT_EQ(together.results.records.size(), alone.results.records.size());
    for (std::size_t i = 0; i < alone.results.records.size(); ++i)
    {
      const Record &found = together.results.records[i], &expected = alone.results.records[i];
      ASSERT_EQ(found.failure, "");
      ASSERT_EQ(expected.failure, "");
      ASSERT_EQ(found.scalars.size(), expected.scalars.size());
      for (const auto &[name, scalar] : expected.scalars)
        EXPECT_NEAR(found[name], scalar.value, rounding * std::max(1., std::abs(scalar.value)))
            << found.key.method << ", " << name;
      EXPECT_EQ(found.cost.n_unknowns, expected.cost.n_unknowns);
      EXPECT_EQ(found.cost.n_bonds, expected.cost.n_bonds);
      EXPECT_EQ(found.cost.n_iterations, expected.cost.n_iterations);
      const bool is_shared = Communicator::all().n_ranks() > 1 &&
                             distributed.find(found.key.method + ";") != std::string::npos;
      EXPECT_EQ(found.text("operator"), expected.text("operator") + (is_shared ? " in slabs" : ""));
    }
    ASSERT_EQ(together.results.references.size(), alone.results.references.size());
    for (std::size_t i = 0; i < alone.results.references.size(); ++i)
      expect_equal(together.results.references[i], alone.results.references[i]);
    ASSERT_EQ(together.results.maps.size(), alone.results.maps.size());
    for (std::size_t i = 0; i < alone.results.maps.size(); ++i)
    {
      expect_equal(together.results.maps[i].values, alone.results.maps[i].values, 1, "map");
      expect_equal(together.results.maps[i].solution, alone.results.maps[i].solution, 1,
                   "map of u");
    }
    EXPECT_FALSE(alone.at_points.empty());
    expect_equal(together.at_points, alone.at_points, 10, "points");
    EXPECT_FALSE(alone.fields.empty());
    expect_equal(together.fields, alone.fields, 10, "VTK file");
  }
} // namespace

TEST(DistributedStatics, have_the_numbers_of_one_rank)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, IPA-AC-R2, Q1, DGQ0"},
                            {"Reference/method", "Q1"},
                            {"Study/norms", "nodal Linf, nodal L2, averages Linf, averages L2"}},
                           "FA; IPA-AC-R2; Q1; DGQ0;");
}

TEST(DistributedStatics, are_for_solids_on_any_box)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Domain/boxes", "0,0,0 : 1,3/4,5/4"},
                            {"Study/h", "1/4"},
                            {"Kernel/type", "bond-tensor"},
                            {"Kernel/limit", "Navier"},
                            {"Problem/solution", "x^2 + y*z, z^2, x*y"}},
                           "FA; Q1;");
}

TEST(DistributedStatics, are_for_state_based_solids)
{
  expect_same_on_all_ranks({{"Methods/names", "IPA-AC-R2, Q1"},
                            {"Reference/estimate", "none"},
                            {"Study/h", "1/4"},
                            {"Kernel/type", "1/r"},
                            {"Kernel/limit", "Navier"},
                            {"Material/model", "LPS"},
                            {"Material/E", "2"},
                            {"Material/nu", "0.4"},
                            {"Problem/solution", "x^2 + y*z^3, z^2, x*y"}},
                           "IPA-AC-R2; Q1;");
}

TEST(DistributedStatics, are_beside_methods_whose_work_is_repeated)
{
  expect_same_on_all_ranks({{"Methods/names", "Q1, Q2"}, {"Study/h", "1/4"}}, "Q1;");
}

TEST(DistributedStatics, take_the_memory_that_is_estimated)
{
  // within a factor of 2, see Method::expected_bytes, where it is not little
  const Communicator ranks = Communicator::all();
  for (const std::string boxes : {"0,0,0 : 1,1,1", "0,0,0 : 1,1,1/2; 0,0,0 : 1/2,1,1"})
  {
    const scene::Scene scene = make_scene({{"Methods/names", "Q1"},
                                           {"Domain/boxes", boxes},
                                           {"Problem/solution", "x^2 + y*z"},
                                           {"Study/h", "1/80"},
                                           {"Study/norms", "nodal Linf"}});
    const Methods all = available(), methods = choose_methods(scene, all);
    StaticsOptions options;
    options.ranks = ranks;
    RunControl control;
    control.ranks = ranks;
    const StudyResults results = run_study(statics_analysis(all, options), scene, methods, control);
    const double measured = static_cast<double>(results.records.front().cost.peak_bytes);
    const auto estimated = [&](unsigned int n_ranks)
    { return estimate_memory(scene, methods, 0, n_ranks).front().largest.bytes; };
    EXPECT_LT(estimated(ranks.n_ranks()), 2 * measured) << boxes;
    EXPECT_GT(estimated(ranks.n_ranks()), measured / 2) << boxes;
    for (const unsigned int n_ranks : {2u, 4u, 8u})
      EXPECT_LT(estimated(n_ranks), .65 * estimated(n_ranks / 2)) << boxes; // halves, and halos
  }
}

TEST(DistributedStatics, have_the_memory_of_their_rows_of_meshes_estimated)
{
  const Communicator ranks = Communicator::all();
  const Methods all = available();
  for (const std::string name : {"P1", "FA"})
  {
    const scene::Scene scene = scene::parse_scene(
        "test.prm", "subsection Domain\n set mesh = triangles\nend\nsubsection Problem\n set "
                    "solution = x^2 + y\nend\nsubsection Methods\n set names = " +
                        name +
                        "\n set nodes = mesh\nend\nsubsection Study\n set m = 5\n set h = 1/90\n "
                        "set norms = nodal "
                        "Linf\nend\n");
    const Methods methods = choose_methods(scene, all);
    StaticsOptions options;
    options.ranks = ranks;
    RunControl control;
    control.ranks = ranks;
    const StudyResults results = run_study(statics_analysis(all, options), scene, methods, control);
    ASSERT_EQ(results.records.front().failure, "");
    const double measured = static_cast<double>(results.records.front().cost.peak_bytes);
    const auto estimated = [&](unsigned int n_ranks)
    { return estimate_memory(scene, methods, 0, n_ranks).front().largest.bytes; };
    EXPECT_LT(estimated(ranks.n_ranks()), 2 * measured) << name; // 1.34 at most
    EXPECT_GT(estimated(ranks.n_ranks()), measured / 2) << name;
    // the cells stay, and of rows there are halos
    EXPECT_LT(estimated(4), .7 * estimated(1)) << name;
    EXPECT_LT(estimated(16), estimated(4)) << name;
  }
}

TEST(DistributedStatics, count_scattered_nodes_once)
{
  expect_same_on_all_ranks({{"Methods/names", "FA"},
                            {"Methods/perturbation", "0.1"},
                            {"Study/h", "1/4"},
                            {"Study/norms", "nodal Linf, nodal L2, averages L2"}},
                           "");
}

TEST(DistributedStatics, are_for_unions_of_boxes)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, IPA-AC-R2, Q1, DGQ0"},
                            {"Domain/boxes", "0,0,0 : 1,1,1/2; 0,0,0 : 1/2,1,1"},
                            {"Reference/method", "Q1"},
                            {"Study/norms", "nodal Linf, nodal L2, averages Linf, averages L2"}},
                           "FA; IPA-AC-R2; Q1; DGQ0;");
}

TEST(DistributedStatics, are_for_solids_with_cavities)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Domain/boxes", "0,0,0 : 1,1,3/2"},
                            {"Domain/holes", "1/2,1/4,3/4 : 3/4,1/2,1"},
                            {"Study/h", "1/8"},
                            {"Kernel/type", "bond-tensor"},
                            {"Kernel/limit", "Navier"},
                            {"Reference/estimate", "none"},
                            {"Problem/solution", "x^2 + y*z, z^2, x*y"}},
                           "FA; Q1;");
}

TEST(DistributedStatics, are_on_unions_of_boxes_beside_methods_whose_work_is_repeated)
{
  // of the first box, two cells thick, Q1 has one row of vertices in each plane
  expect_same_on_all_ranks({{"Methods/names", "Q1, Q2"},
                            {"Domain/boxes", "0,0,0 : 1,1/2,1; 0,0,1/2 : 1/2,1,1"},
                            {"Study/h", "1/4"}},
                           "Q1;");
}
