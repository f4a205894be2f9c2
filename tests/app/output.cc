// What cannot be written is said, and the exit code is not 0.
#include "command.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace
{
  using namespace plumbline::app;

  std::string small_scene()
  {
    return write("small.prm", "subsection Problem\n set solution = x^2 + y^2\nend\n"
                              "subsection Methods\n set names = FA, IPA-AC-R2, Q1\nend\n"
                              "subsection Study\n set h = 0.1, 0.05\nend\n");
  }

  /// The command by a shell, which takes what is redirected in it.
  Outcome shell(const std::string &command)
  {
    const fs::path err = temporary("shell_err");
    const int status = std::system(
        ("{ " + std::string(PLUMBLINE_COMMAND) + " " + command + " ; } 2>" + err.string()).c_str());
    const Outcome outcome{WEXITSTATUS(status), "", read(err)};
    fs::remove(err);
    return outcome;
  }
} // namespace

TEST(Output, that_a_full_disk_swallows_is_no_success)
{
  const fs::path folder = temporary("full");
  for (const std::string &command :
       {std::string("list methods"), std::string("template scalar"), std::string("describe Study"),
        std::string("--help"), "run " + small_scene() + " -o " + folder.string()})
  {
    const Outcome outcome = shell(command + " >/dev/full");
    EXPECT_EQ(outcome.exit_code, 3) << command;
    expect_found(outcome.err,
                 "standard output cannot be written (No space left on device); the output is "
                 "incomplete. Free some disk space or redirect it",
                 command);
  }
  EXPECT_NO_THROW(std::ignore = read_json(folder / "results.json"));
  expect_found(read(folder / "report.html"), "</html>");
  fs::remove_all(folder);
}

TEST(Output, files_that_are_not_whole_are_named_and_results_and_page_stay)
{
  const fs::path folder = temporary("short");
  ASSERT_EQ(run("run " + small_scene() + " --quiet -o " + folder.string()).exit_code, 0);
  const std::string page = read(folder / "report.html");
  // what is written to FILE goes through FILE.part, which leads to a full disk here
  const auto fill = [&](const std::string &name)
  {
    fs::create_symlink("/dev/full", folder / (name + ".part"));
    const Outcome outcome = run("report " + folder.string());
    EXPECT_EQ(outcome.exit_code, 2) << name;
    expect_found(outcome.err, "output file '" + (folder / name).string() +
                                  "' cannot be written (No space left on device); free some space");
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder / (name + ".part")))) << name;
    EXPECT_EQ(read_json(folder / "results.json").at("records").size(), 6u);
  };
  fill("report.html");
  EXPECT_EQ(read(folder / "report.html"), page);
  fs::remove(folder / "report.html");
  fill("charts/charts.gp");
  expect_found(read(folder / "report.html"), "</html>");
  fill("results.json");
  fs::remove_all(folder);
}

TEST(Output, has_the_net_force_of_surface_terms_at_each_level)
{
  const fs::path folder = temporary("tips");
  const std::string over_root = "F / sqrt(horizon)";
  const std::string scene = "run " + std::string(PLUMBLINE_SCENES) +
                            "/lps/crack_mode_2.prm --set 'Solver/linear solver=direct' -o " +
                            folder.string();
  const auto last = [&] // columns by name
  {
    const auto results = read_json(folder / "results.json");
    std::map<std::string, std::vector<double>> columns;
    for (const auto &column : results.at("records").back().at("curves").at("tip forces"))
      columns[column.at("name")] = column.at("values").get<std::vector<double>>();
    return columns;
  };
  const Outcome whole = run(scene + " --levels 3");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  expect_found(whole.err, "the surface terms exert a net force at the tip (0, 0); the order "
                          "tends to 1/2");
  const auto published = last();
  ASSERT_EQ(published.at(over_root).size(), 1u);
  EXPECT_GT(published.at(over_root)[0], .1);
  expect_found(read(folder / "report.html"), "Net force of the surface terms about crack tips");
  expect_found(read(folder / "tables/tip_forces.csv"), "F / sqrt(horizon)");
  fs::remove_all(folder);
  const std::string one_level = " --levels 1 --quiet";
  for (const std::string &variant : {std::string(" --set Solver/dilatation=kept"),
                                     std::string()}) // another system, the same force
  {
    ASSERT_EQ(run(scene + one_level + variant).exit_code, 0);
    const auto found = last();
    ASSERT_EQ(found.at(over_root).size(), 1u);
    EXPECT_NEAR(found.at(over_root)[0] / published.at(over_root)[0], 1, .05) << variant;
    fs::remove_all(folder);
  }
  ASSERT_EQ(run(scene + one_level + " --set 'Material/surface terms=consistent'").exit_code, 0);
  const auto balanced = last();
  ASSERT_EQ(balanced.at("F").size(), 1u);
  EXPECT_LT(balanced.at("F")[0], 1e-9 * balanced.at("sum of norms")[0]);
  fs::remove_all(folder);
  expect_refused("run " + small_scene() + " --set 'Material/surface terms=none'",
                 "Material/surface terms = none has no effect");
}
