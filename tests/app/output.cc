// What cannot be written is said, and the exit code is not 0.
#include "command.h"

#include <nlohmann/json.hpp>

#include <tuple>

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
                 "standard output cannot be written (No space left on device), what "
                 "was printed is not whole; free some space, or send it elsewhere",
                 command);
  }
  EXPECT_NO_THROW(std::ignore = nlohmann::json::parse(read(folder / "results.json")));
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
    EXPECT_EQ(nlohmann::json::parse(read(folder / "results.json")).at("runs").size(), 6u);
  };
  fill("report.html");
  EXPECT_EQ(read(folder / "report.html"), page);
  fs::remove(folder / "report.html");
  fill("charts/charts.gp");
  expect_found(read(folder / "report.html"), "</html>");
  fill("results.json");
  fs::remove_all(folder);
}
