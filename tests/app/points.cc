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
    const std::size_t n = method == "Q2" ? 6 : 5; // x, y, u, exact, error, estimate
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
      }
    }
  }
  fs::remove_all(folder);
}

TEST(Points, outside_of_the_domain_are_refused_by_their_line_before_anything_is_solved)
{
  const std::string file = write("outside.csv", "x,y\n\n0.5,0.5\n1.5,0.5\n");
  expect_refused("run " + scene_at(file),
                 "'" + file +
                     "', line 4: (1.500000, 0.500000) lies outside of the domain; take it out");
  expect_refused("run " + scene_at(file, "subsection Domain\n set mesh = squares\nend\n"),
                 "'" + file + "', line 4: (1.500000, 0.500000) lies outside");
}

TEST(Points, need_a_file_with_points)
{
  expect_refused("run " + scene_at("/no-such.csv"), "Output/points = /no-such.csv: ");
  expect_refused("run " + scene_at(write("none.csv", "x,y\n")), "has no points");
  expect_refused("run " + scene_at(write("words.csv", "x,y\n0.5,here\n")), "line 2");
}
