// Output/points: values of every solution at points, in full precision.
#include "command.h"

#include <cmath>
#include <map>

namespace
{
  using namespace plumbline::app;

  std::string scene_at(const std::string &points, const std::string &more = "")
  {
    return write("points.prm", "subsection Problem\n set solution = x^2 + y^2\nend\n"
                               "subsection Methods\n set names = FA, Q2\nend\n"
                               "subsection Study\n set h = 0.1, 0.05\nend\n"
                               "subsection Output\n set points = " +
                                   points + "\nend\n" + more);
  }

  /// Columns by name.
  std::map<std::string, std::vector<double>> table(const fs::path &file)
  {
    std::istringstream lines(read(file));
    std::string line, word;
    std::getline(lines, line);
    std::vector<std::string> names;
    std::istringstream header(line);
    while (std::getline(header, word, ','))
      names.push_back(word);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(lines, line))
    {
      std::istringstream row(line);
      for (const std::string &name : names)
      {
        std::getline(row, word, ',');
        columns[name].push_back(std::stod(word));
      }
    }
    return columns;
  }
} // namespace

TEST(Points, have_values_errors_and_changes_in_full_precision)
{
  const std::string file = write("at.csv", "x,y\n0.31,0.73\n0.5,0.1\n1,1\n");
  const fs::path folder = temporary("points");
  const Outcome outcome = run("run --quiet " + scene_at(file) + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const std::string method : {"FA", "Q2"})
  {
    const auto coarse = table(folder / "points" / ("u_m___3_" + method + "_level1.csv")),
               fine = table(folder / "points" / ("u_m___3_" + method + "_level2.csv"));
    const std::size_t n = method == "Q2" ? 8 : 5; // x, y, u, exact, error, estimate, u_x, u_y
    ASSERT_EQ(coarse.size(), n) << method;
    ASSERT_EQ(fine.size(), n + 1) << method;
    ASSERT_EQ(fine.at("u").size(), 3u);
    EXPECT_EQ(fine.at("x"), (std::vector<double>{.31, .5, 1}));
    for (unsigned int k = 0; k < 3; ++k)
    {
      const double x = fine.at("x")[k], y = fine.at("y")[k], u = fine.at("u")[k];
      EXPECT_NEAR(fine.at("exact")[k], x * x + y * y, 1e-13);
      EXPECT_EQ(fine.at("error")[k], u - fine.at("exact")[k]); // read back to the same bits
      EXPECT_EQ(fine.at("change")[k], u - coarse.at("u")[k]);
      EXPECT_LT(std::abs(fine.at("error")[k]), method == "Q2" ? 1e-3 : .2);
      if (method == "Q2")
      {
        EXPECT_LE(std::abs(fine.at("error")[k]), fine.at("estimate")[k]);
        EXPECT_NEAR(fine.at("u_x")[k], 2 * x, .02);
        EXPECT_NEAR(fine.at("u_y")[k], 2 * y, .02);
      }
    }
  }
  fs::remove_all(folder);
}

TEST(Points, have_values_of_the_reference)
{
  const std::string file = write("of_reference.csv", "x,y\n0.31,0.73\n0.5,0.1\n");
  const fs::path folder = temporary("of_reference");
  for (const std::string estimate : {"automatic", "none"})
  {
    const Outcome outcome = run("run --quiet " +
                                scene_at(file, "subsection Reference\n set method = Q2\n"
                                               " set estimate = " +
                                                   estimate + "\nend\n") +
                                " -o " + folder.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string level : {"1", "2"})
    {
      const std::string begin = (folder / "points" / "u_m___3_").string(),
                        end = "_level" + level + ".csv";
      const auto reference = table(begin + "reference" + end), same = table(begin + "Q2" + end);
      for (const std::string name : {"x", "y", "u", "exact", "error", "u_x", "u_y"})
        EXPECT_EQ(reference.at(name), same.at(name)) << name;
      EXPECT_EQ(reference.count("estimate"), estimate == "none" ? 0u : 1u);
      EXPECT_EQ(reference.count("change"), level == "1" ? 0u : 1u);
    }
  }
  fs::remove_all(folder);
}

TEST(Points, have_values_on_a_line)
{
  const std::string file = write("on_line.csv", "x\n0.31\n0.5\n1\n");
  const fs::path folder = temporary("points_on_line");
  const Outcome outcome =
      run("run --quiet " + scene_at(file) +
          " --set Domain/dimension=1 --set 'Domain/boxes=0 : 1' --set Problem/solution=x^2 -o " +
          folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const std::string method : {"FA", "Q2"})
  {
    const auto coarse = table(folder / "points" / ("u_m___3_" + method + "_level1.csv")),
               fine = table(folder / "points" / ("u_m___3_" + method + "_level2.csv"));
    ASSERT_EQ(fine.size(), method == "Q2" ? 6u : 5u) << method; // and the change, and the estimate
    EXPECT_EQ(fine.at("x"), (std::vector<double>{.31, .5, 1}));
    for (unsigned int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(fine.at("error")[k], fine.at("u")[k] - fine.at("exact")[k]);
      EXPECT_EQ(fine.at("change")[k], fine.at("u")[k] - coarse.at("u")[k]);
      EXPECT_LT(std::abs(fine.at("error")[k]), method == "Q2" ? 1e-9 : .2); // Q2 has quadratics
      if (method == "Q2")
      {
        EXPECT_LE(std::abs(fine.at("error")[k]), fine.at("estimate")[k]);
      }
    }
  }
  fs::remove_all(folder);
}

TEST(Points, have_the_same_files_after_a_kill)
{
  const std::string file = write("resumed.csv", "x,y\n0.31,0.73\n0.5,0.1\n"),
                    command = "run " +
                              scene_at(file, "subsection Reference\n set method = Q2\n"
                                             "end\n") +
                              " --set Study/h=0.2,0.1,0.05";
  const fs::path whole = temporary("points_whole"), folder = temporary("points_resumed");
  ASSERT_EQ(run(command + " --quiet -o " + whole.string()).exit_code, 0);
  ASSERT_TRUE(kill_at(command + " --quiet -o " + folder.string(),
                      folder / "points" / "u_m___3_FA_level2.csv"));
  const Outcome next = run(command + " -o " + folder.string());
  ASSERT_EQ(next.exit_code, 0) << next.err;
  expect_found(next.err, "continuing: ");
  std::size_t n = 0;
  for (const auto &one : fs::directory_iterator(whole / "points"))
  {
    EXPECT_EQ(read(folder / "points" / one.path().filename()), read(one.path())) << one.path();
    ++n;
  }
  EXPECT_EQ(n, 9u);
  fs::remove_all(whole);
  fs::remove_all(folder);
}

TEST(Points, outside_of_the_domain_are_refused_by_their_line_before_anything_is_solved)
{
  const std::string file = write("outside.csv", "x,y\n\n0.5,0.5\n1.5,0.5\n");
  expect_refused("run " + scene_at(file),
                 "'" + file + "', line 4: (1.5, 0.5) lies outside of the domain; take it out");
  expect_refused("run " + scene_at(file, "subsection Domain\n set mesh = squares\nend\n"),
                 "'" + file + "', line 4: (1.5, 0.5) lies outside");
  const std::string solid = write("solid.csv", "x,y,z\n0.5,0.5,0\n0.5,0.2,0.1\n");
  expect_refused("run " + scene_at(solid),
                 "'" + solid + "', line 3: z = 0.1, but the scene has two dimensions; take out");
}

TEST(Points, in_space_have_values_and_estimates)
{
  const auto scene_of = [](const std::string &solution, const std::string &points)
  {
    return write("space_points.prm",
                 "subsection Domain\n set dimension = 3\n"
                 " set boxes = 0,0,0 : 1,1/2,1/2 ; 0,0,0 : 1/2,1,1/2\nend\n"
                 "subsection Problem\n set solution = " +
                     solution +
                     "\nend\nsubsection Methods\n set names = FA, Q1\nend\n"
                     "subsection Study\n set h = 1/8, 1/16\n set norms = nodal Linf\n"
                     " set decisive error = nodal Linf | exact\nend\n"
                     "subsection Output\n set points = " +
                     points + "\nend\n");
  };
  // in cells, on a vertex at the re-entrant edge, on the upper side, in a corner
  const std::string inside =
      write("at_z.csv", "x,y,z\n0.31,0.73,0.2\n0.5,0.5,0.25\n0.9,0.5,0.1\n1,0.5,0.5\n");
  const fs::path folder = temporary("space_points");
  const std::string of_trilinear = "x + 2*y - z + x*y*z", of_sine = "sin(3*x)*y^2 + cos(2*z)";
  for (const std::string &solution : {of_trilinear, of_sine})
  {
    const Outcome outcome =
        run("run --quiet " + scene_of(solution, inside) + " -o " + folder.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string method : {"FA", "Q1"})
    {
      const auto fine = table(folder / "points" / ("u_m___3_" + method + "_level2.csv"));
      // x, y, z, u, exact, error, change; estimate, u_x, u_y, u_z
      ASSERT_EQ(fine.size(), method == "Q1" ? 11u : 7u);
      ASSERT_EQ(fine.at("u").size(), 4u);
      EXPECT_EQ(fine.at("z"), (std::vector<double>{.2, .25, .1, .5}));
      for (unsigned int k = 0; k < 4; ++k)
      {
        const double x = fine.at("x")[k], y = fine.at("y")[k], z = fine.at("z")[k],
                     error = std::abs(fine.at("error")[k]);
        EXPECT_NEAR(fine.at("exact")[k],
                    solution == of_trilinear ? x + 2 * y - z + x * y * z
                                             : std::sin(3 * x) * y * y + std::cos(2 * z),
                    1e-13);
        EXPECT_LT(error, method == "FA" ? .2 : solution == of_trilinear ? 1e-11 : 1e-2);
        if (method == "Q1")
        {
          EXPECT_LE(error, fine.at("estimate")[k] + 1e-11) << k;
          EXPECT_LT(fine.at("estimate")[k], .05);
          const bool is_trilinear = solution == of_trilinear;
          const double tolerance = is_trilinear ? 1e-10 : .3;
          EXPECT_NEAR(fine.at("u_x")[k], is_trilinear ? 1 + y * z : 3 * std::cos(3 * x) * y * y,
                      tolerance);
          EXPECT_NEAR(fine.at("u_y")[k], is_trilinear ? 2 + x * z : 2 * std::sin(3 * x) * y,
                      tolerance);
          EXPECT_NEAR(fine.at("u_z")[k], is_trilinear ? x * y - 1 : -2 * std::sin(2 * z),
                      tolerance);
        }
      }
    }
  }
  fs::remove_all(folder);
  const std::string outside = write("outside_z.csv", "x,y,z\n0.2,0.2,0.2\n0.75,0.75,0.2\n");
  expect_refused("run " + scene_of(of_sine, outside),
                 "line 3: (0.75, 0.75, 0.2) lies outside of the domain");
  expect_refused("run " + scene_of(of_sine, write("plane.csv", "x,y\n0.5,0.2\n")), "no column z");
}

TEST(Points, need_a_file_with_points)
{
  expect_refused("run " + scene_at("/no-such.csv"), "Output/points = /no-such.csv: ");
  expect_refused("run " + scene_at(write("none.csv", "x,y\n")), "has no points");
  expect_refused("run " + scene_at(write("words.csv", "x,y\n0.5,here\n")), "line 2");
}

TEST(Points, may_be_written_in_the_scene)
{
  const fs::path folder = temporary("points_inline");
  const std::string more = " --set 'Output/points=0.31, 0.73 : 0.5, 0.1' --methods FA --levels 1";
  const Outcome outcome =
      run("run --quiet " + scene_at("none.csv") + more + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(table(folder / "points" / "u_m___3_FA_level1.csv").at("y"),
            (std::vector<double>{.73, .1}));
  fs::remove_all(folder);
  const auto refused = [](const std::string &points, const std::string &message)
  { expect_refused("run " + scene_at(points), message); };
  refused("0.5, 0.1 : 7, 7", "point 2: (7, 7) lies outside of the domain");
  refused("0.5, 0.1 : 0.2", "the point '0.2' has 1 coordinates, but the scene has 2 dimensions");
}
