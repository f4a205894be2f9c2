// The command as a user meets it: exit codes, messages on stderr, files.

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
  struct Outcome
  {
    int exit_code;
    std::string out, err;
  };

  std::string read(const fs::path &file)
  {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  fs::path temporary(const std::string &name)
  {
    const fs::path path =
        fs::path(::testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_" + name);
    fs::remove_all(path);
    return path;
  }

  Outcome plumbline(const std::string &arguments)
  {
    const fs::path out = temporary("out"), err = temporary("err");
    const int status = std::system((std::string(PLUMBLINE_COMMAND) + " " + arguments + " >" +
                                    out.string() + " 2>" + err.string())
                                       .c_str());
    return {WEXITSTATUS(status), read(out), read(err)};
  }

  const std::string scene = std::string(PLUMBLINE_SCENES) + "/ipa_ac/scalar_delta_convergence.prm";

  void expect_refusal(const std::string &settings, const std::string &message)
  {
    const fs::path folder = temporary("refused");
    const Outcome outcome = plumbline("run " + scene + " -o " + folder.string() + " " + settings);
    EXPECT_EQ(outcome.exit_code, 2) << settings;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(folder)) << "partial output for " << settings;
  }
} // namespace

TEST(Command, writes_everything_that_a_report_needs)
{
  const fs::path folder = temporary("run");
  const Outcome outcome = plumbline("run " + scene + " -o " + folder.string() +
                                    " --levels 4 --methods IPA-AC,IPA-AC-R2,Q1 --set "
                                    "Output/fields=true --set Expected/verdicts=");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("not AC"), std::string::npos);
  EXPECT_EQ(outcome.err, "");
  for (const std::string file :
       {"results.json", "report.html", "tables/verdicts.csv", "tables/cost.md",
        "charts/work-precision.svg", "fields/case1_m___3_Q1.vtu", "fields/case1_m___3_IPA_AC.vtu"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;

  // the page can be made again from results.json alone
  fs::remove(folder / "report.html");
  EXPECT_EQ(plumbline("report " + folder.string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "report.html"));
}

TEST(Command, check_fails_with_1_when_an_expectation_does_not_hold)
{
  const std::string common = "run " + scene + " -o " + temporary("check").string() +
                             " --levels 4 --methods IPA-AC --set Study/m=3 --set Expected/errors= "
                             "--set Expected/rates= --set Expected/bounds= ";
  EXPECT_EQ(plumbline(common + "--check --set 'Expected/verdicts=IPA-AC: not AC'").exit_code, 0);
  const Outcome wrong = plumbline(common + "--check --set 'Expected/verdicts=IPA-AC: AC'");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.out.find("expected AC, found not AC"), std::string::npos);
  EXPECT_EQ(plumbline(common + "--set 'Expected/verdicts=IPA-AC: AC'").exit_code, 0);
}

TEST(Command, refuses_bad_input_with_2_and_leaves_nothing)
{
  expect_refusal("--set Study/mesh=1", "key 'Study/mesh' is not known");
  expect_refusal("--set Geometry/checks=few", "Geometry/checks = 'few' is not allowed");
  expect_refusal("--set Study/m=0.5", "is smaller than the mesh size");
  expect_refusal("--set Domain/collar=0.01", "Domain/collar = 0.01 is thinner than the horizon");
  expect_refusal("--set Kernel/limit=Navier", "does not fit the scalar kernel");
  expect_refusal("--set 'Problem/solution=x +* y'", "does not parse");
  expect_refusal("--set 'Problem/solution=case1: x; case2: y; case3: log(x)'", "gives");
  expect_refusal("--methods IPA", "method 'IPA' is not known; choose of FA, LAMMPS");
  expect_refusal("--set Study", "has no '='; write --set Section/key=value");
  EXPECT_EQ(plumbline("run no_such_scene.prm").exit_code, 2);
  EXPECT_EQ(plumbline("fly").exit_code, 2);
  EXPECT_EQ(plumbline("list planets").exit_code, 2);
  EXPECT_EQ(plumbline("report " + temporary("nowhere").string()).exit_code, 2);
}

TEST(Command, an_unknown_key_in_a_file_is_refused_with_its_line)
{
  const fs::path file = temporary("typo.prm"), folder = temporary("typo");
  std::ofstream(file) << "subsection Study\n set hh = 0.1\nend\n";
  const Outcome outcome = plumbline("run " + file.string() + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("hh"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("Line <2>"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Command, a_run_on_the_exact_geometry_gives_the_same_numbers)
{
  for (const std::string backend : {"fast", "cgal"})
    EXPECT_EQ(
        plumbline(
            "run " + scene + " -o " + temporary("geometry").string() +
            " --check --levels 4 --methods IPA-AC,Q1 --set Study/m=3 --set Expected/rates= --set "
            "Geometry/backend=" +
            backend +
            " --set 'Expected/verdicts=IPA-AC: not AC' --set 'Expected/errors=IPA-AC, case1: "
            "1.621593e-02 1.421233e-02 1.325684e-02 1.279041e-02'")
            .exit_code,
        0)
        << backend;
}

TEST(Command, a_reference_that_is_no_method_of_the_scene_shows_its_geometry_check_too)
{
  const fs::path folder = temporary("reference");
  const Outcome outcome = plumbline(
      "run " + scene + " -o " + folder.string() +
      " --quiet --levels 1 --methods FA --set Reference/method=Q1 --set Expected/verdicts= "
      "--set Expected/errors= --set Expected/rates= --set Expected/bounds=");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = read(folder / "report.html");
  EXPECT_NE(page.find("runs were recomputed with exact geometry"), std::string::npos);
  EXPECT_EQ(page.find("no cut cell was recomputed"), std::string::npos);
}

TEST(Command, an_output_folder_that_cannot_be_written_is_refused_before_any_work)
{
  const fs::path file = temporary("file");
  std::ofstream(file) << "not a folder";
  const Outcome outcome = plumbline("run " + scene + " -o " + (file / "results").string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("cannot be written; give a writable one with -o"), std::string::npos);
}

TEST(Command, data_that_are_not_finite_at_a_later_level_only_are_found_before_any_work)
{
  const fs::path folder = temporary("later"), file = temporary("later.prm");
  std::ofstream(file) << "subsection Problem\n set solution = sqrt(x + 0.35)\nend\nsubsection "
                         "Methods\n set names = "
                         "FA\nend\nsubsection Study\n set regime = delta-m\n set h = 0.1, 0.05\n "
                         "set m = 2, 10\nend\n";
  const Outcome outcome = plumbline("run " + file.string() + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("must be a finite number"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Command, no_solution_at_all_is_exit_code_3)
{
  const Outcome outcome = plumbline("run " + scene + " -o " + temporary("infeasible").string() +
                                    " --methods OPT --levels 1 --set Study/m=1.5 --set "
                                    "Expected/verdicts= --set Expected/errors=");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("infeasible for m = 1.5"), std::string::npos);
}

TEST(Command, an_interrupted_run_keeps_what_is_finished_and_goes_on)
{
  const fs::path folder = temporary("interrupted");
  const std::string settings = " --methods FA,Q1,Q2,Q3,DGQ1,DGQ2 --set Study/m=3 --set "
                               "Expected/verdicts= --set Expected/errors=";
  const std::string arguments = scene + " -o " + folder.string() + settings;

  // interrupt as soon as the first result is stored
  const pid_t child = fork();
  if (child == 0)
  {
    const std::string command =
        std::string("exec ") + PLUMBLINE_COMMAND + " run " + arguments + " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  for (int i = 0; i < 6000 && !fs::exists(folder / "results.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(read(folder / "results.json").find("\"is_complete\": false"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "report.html"));

  const Outcome rest = plumbline("run " + arguments);
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_NE(rest.err.find("continuing: "), std::string::npos);
  EXPECT_NE(read(folder / "results.json").find("\"is_complete\": true"), std::string::npos);
}

TEST(Command, lists_templates_and_descriptions_help_a_newcomer)
{
  EXPECT_NE(plumbline("list methods").out.find("IPA-AC-R2"), std::string::npos);
  EXPECT_NE(plumbline("list kernels").out.find("bond-tensor"), std::string::npos);
  EXPECT_NE(plumbline("list scenes").out.find("scalar_delta_convergence.prm"), std::string::npos);
  EXPECT_NE(plumbline("describe Study/m").out.find("allowed"), std::string::npos);

  const fs::path file = temporary("template.prm"), folder = temporary("template");
  std::ofstream(file) << plumbline("template tensor").out;
  const Outcome outcome = plumbline("run " + file.string() + " --levels 2 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(Command, json_on_standard_output_is_the_results_file)
{
  const fs::path folder = temporary("json");
  const Outcome outcome =
      plumbline("run " + scene +
                " --json --levels 1 --methods FA --set Expected/verdicts= --set "
                "Expected/errors= -o " +
                folder.string());
  EXPECT_EQ(outcome.out, read(folder / "results.json"));
}
