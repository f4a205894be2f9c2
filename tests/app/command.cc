// The command as a user meets it: exit codes, messages on stderr, files.

#include "command.h"
#include "base/progress_line.h"
#include "report/view.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <sys/stat.h>
#include <thread>

namespace
{
  using namespace plumbline::app;

  const std::string scene = std::string(PLUMBLINE_SCENES) + "/ipa_ac/scalar_delta_convergence.prm";

  void expect_refusal(const std::string &settings, const std::string &message)
  {
    expect_refused("run " + scene + " " + settings, message);
  }

  std::string summary_of(const plumbline::study::StudyResults &results)
  {
    return study_summary(plumbline::report::statics_view(results), results, "out");
  }
} // namespace

TEST(Command, writes_everything_that_a_report_needs)
{
  const fs::path folder = temporary("run");
  const Outcome outcome = run("run " + scene + " -o " + folder.string() +
                              " --levels 4 --methods IPA-AC,IPA-AC-R2,Q1 --set "
                              "Output/fields=true --set Expected/verdicts=");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "not AC");
  EXPECT_EQ(without_progress(outcome.err), "");
  for (const std::string file :
       {"results.json", "report.html", "tables/verdicts.csv", "tables/cost.md",
        "charts/work-precision.svg", "fields/case1_m___3_Q1.vtu", "fields/case1_m___3_IPA_AC.vtu"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;

  // the page can be made again from results.json alone
  fs::remove(folder / "report.html");
  EXPECT_EQ(run("report " + folder.string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "report.html"));
}

TEST(Command, check_fails_with_1_when_an_expectation_does_not_hold)
{
  const std::string common = "run " + scene + " -o " + temporary("check").string() +
                             " --levels 4 --methods IPA-AC --set Study/m=3 --set Expected/errors= "
                             "--set Expected/rates= --set Expected/bounds= ";
  EXPECT_EQ(run(common + "--check --set 'Expected/verdicts=IPA-AC: not AC'").exit_code, 0);
  const Outcome wrong = run(common + "--check --set 'Expected/verdicts=IPA-AC: AC'");
  EXPECT_EQ(wrong.exit_code, 1);
  expect_found(wrong.out, "expected AC, found not AC");
  EXPECT_EQ(run(common + "--set 'Expected/verdicts=IPA-AC: AC'").exit_code, 0);
}

TEST(Command, a_solution_that_contradicts_its_load_is_warned_of)
{
  const fs::path folder = temporary("contradiction");
  const std::string command = "run " + std::string(PLUMBLINE_SCENES) +
                              "/lps/cracked_plate.prm --methods FA --set Study/h=0.125,0.0625 -o " +
                              folder.string();
  EXPECT_EQ(run(command).err.find("contradict"), std::string::npos); // no solution is given
  const Outcome outcome = run(command + " --set 'Problem/solution=0, y - 0.5'");
  EXPECT_EQ(outcome.exit_code, 0);
  expect_found(outcome.err, "warning: u: solution and load contradict each other: at 32 points");
  expect_found(read(folder / "results.json"), "solution and load contradict each other");
  expect_found(read(folder / "report.html"), "solution and load contradict each other");
  fs::remove_all(folder);
}

TEST(Command, expectations_take_the_other_name_of_a_method)
{
  const std::string common = "run " + scene + " -o " + temporary("check").string() +
                             " --levels 4 --set Study/m=3 --set Expected/errors= "
                             "--set Expected/rates= --set Expected/bounds= --check ";
  for (const std::string name : {"HHB", "QWJ"})
    for (const std::string other : {"HHB", "QWJ"})
    {
      const auto expect = [&](const std::string &verdict)
      {
        return run(common + "--methods " + name + " --set 'Expected/verdicts=" + other + ": " +
                   verdict + "'");
      };
      const Outcome good = expect("not AC");
      EXPECT_EQ(good.exit_code, 0) << name << ", " << other << good.err << good.out;
      const Outcome wrong = expect("AC");
      EXPECT_EQ(wrong.exit_code, 1) << name << ", " << other << wrong.err;
      expect_found(wrong.out, "expected AC, found not AC");
    }
  expect_refusal("--set 'Expected/verdicts=HBB: AC'", "Expected: method 'HBB' is not known");
}

TEST(Command, takes_names_of_methods_in_any_case)
{
  const fs::path out = temporary("any_case");
  const Outcome outcome =
      run("run " PLUMBLINE_SCENES "/check/check.prm --levels 1 --methods fa,hhb,Ipa-Ac-r2,q1 --set "
          "'Expected/verdicts=ipa-ac-R2: undecided' --set Reference/method=q2 --json -o " +
          out.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = parse_json(outcome.out);
  std::vector<std::string> names;
  for (const auto &record : json["records"])
    names.push_back(record["key"]["method"]);
  EXPECT_EQ(names, (std::vector<std::string>{"FA", "QWJ", "IPA-AC-R2", "Q1"}));
  ASSERT_EQ(json["expectations"].size(), 1u);
  EXPECT_TRUE(json["expectations"][0]["holds"]);
  EXPECT_EQ(json["references"][0]["method"], "Q2");
  // a reference that is one of the methods is not estimated a second time
  const Outcome twice =
      run("run " PLUMBLINE_SCENES "/check/check.prm --levels 1 --methods q1 --set "
          "Expected/verdicts= --set Reference/method=q1 --set Reference/estimate=every --json -o " +
          out.string());
  EXPECT_EQ(twice.exit_code, 0) << twice.err;
  EXPECT_EQ(parse_json(twice.out)["references"].size(), 1u);
  EXPECT_EQ(parse_json(twice.out)["estimates"].size(), 0u);
}

TEST(Command, refuses_bad_input_with_2_and_leaves_nothing)
{
  expect_refusal("--set Study/mesh=1", "key 'Study/mesh' is not known");
  expect_refusal("--set Geometry/checks=few", "Geometry/checks = 'few' is not allowed");
  expect_refusal("--set Study/m=0.5", "is smaller than the mesh size");
  expect_refusal("--set Domain/collar=0.01",
                 "Domain/interaction domain = 0.01 is thinner than the horizon");
  expect_refusal("--set Kernel/limit=Navier", "does not fit the scalar kernel");
  expect_refusal("--set 'Problem/solution=x +* y'", "does not parse");
  expect_refusal("--set 'Problem/solution=case1: x; case2: y; case3: log(x)'", "gives");
  expect_refusal("--methods IPA", "method 'IPA' is not known; choose one of FA, LAMMPS");
  expect_refusal("--budget -1", "--budget is negative");
  expect_refusal("--ranks 64", "--ranks = 64 applies only to --estimate, which runs nothing; add "
                               "--estimate, or run on that many ranks by mpirun -np 64");
  expect_refusal("--estimate --json",
                 "--estimate prints a text table and cannot be combined with --json");
  expect_refusal("--set Domain/mesh=no.geo", "Domain/mesh: mesh file");
  expect_refusal("--set Study", "has no '='; write --set Section/key=value");
  EXPECT_EQ(run("run no_such_scene.prm").exit_code, 2);
  EXPECT_EQ(run("fly").exit_code, 2);
  EXPECT_EQ(run("list planets").exit_code, 2);
  EXPECT_EQ(run("report " + temporary("nowhere").string()).exit_code, 2);
}

TEST(Command, an_unknown_key_in_a_file_is_refused_with_its_line)
{
  const fs::path folder = temporary("typo");
  const std::string file = write("typo.prm", "subsection Study\n set hh = 0.1\nend\n");
  const Outcome outcome = run("run " + file + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "hh");
  expect_found(outcome.err, "line 2: key 'Study/hh' is not known; write one of: Study/regime");
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Command, a_run_on_the_exact_geometry_gives_the_same_numbers)
{
  for (const std::string backend : {"fast", "cgal"})
    EXPECT_EQ(
        run("run " + scene + " -o " + temporary("geometry").string() +
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
  const Outcome outcome =
      run("run " + scene + " -o " + folder.string() +
          " --quiet --levels 1 --methods FA --set Reference/method=Q1 --set Expected/verdicts= "
          "--set Expected/errors= --set Expected/rates= --set Expected/bounds=");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = read(folder / "report.html");
  expect_found(page, "runs were recomputed with exact geometry");
  EXPECT_EQ(page.find("no cut cell was recomputed"), std::string::npos);
}

TEST(Command, an_output_folder_that_cannot_be_written_is_refused_before_any_work)
{
  const std::string file = write("file", "not a folder");
  const Outcome outcome = run("run " + scene + " -o " + file + "/results");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "cannot be written; give a writable one with -o");
}

TEST(Command, data_that_are_not_finite_at_a_later_level_only_are_found_before_any_work)
{
  const fs::path folder = temporary("later");
  const std::string file = write(
      "later.prm", "subsection Problem\n set solution = sqrt(x + 0.35)\nend\n"
                   "subsection Methods\n set names = FA\nend\n"
                   "subsection Study\n set regime = delta-m\n set h = 0.1, 0.05\n set m = 2, 10\n"
                   "end\n");
  const Outcome outcome = run("run " + file + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "must be a finite number");
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Command, no_solution_at_all_is_exit_code_3)
{
  const Outcome outcome = run("run " + scene + " -o " + temporary("infeasible").string() +
                              " --methods OPT --levels 1 --set Study/m=1.5 --set "
                              "Expected/verdicts= --set Expected/errors=");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_found(outcome.err, "infeasible for m = 1.5");
}

TEST(Command, an_interrupted_run_keeps_what_is_finished_and_goes_on)
{
  const fs::path folder = temporary("interrupted");
  const std::string settings = " --methods FA,Q1,Q2,Q3,DGQ1,DGQ2 --set Study/m=3 --set "
                               "Expected/verdicts= --set Expected/errors=";
  const std::string arguments = scene + " -o " + folder.string() + settings;

  // interrupt as soon as the first result is stored
  const fs::path err = temporary("interrupted_err");
  const pid_t child = start("run " + arguments, err.string());
  for (int i = 0; i < 6000 && !fs::exists(folder / "results.jsonl"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const std::string said = read(err);
  expect_found(said, "\ninterrupted: ends after the current solve");
  EXPECT_LT(said.find("Ctrl-C again: ends now"), said.find("the same command continues"));
  fs::remove(err);
  expect_found(read(folder / "results.json"), "\"is_complete\": false");
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  // what was concluded is not lost where the page is made again
  const std::string interrupted = read(folder / "results.json");
  EXPECT_EQ(run("report " + folder.string()).exit_code, 0);
  EXPECT_EQ(read(folder / "results.json"), interrupted);

  const Outcome rest = run("run " + arguments);
  EXPECT_EQ(rest.exit_code, 0);
  expect_found(rest.err, "continuing: ");
  expect_found(read(folder / "results.json"), "\"is_complete\": true");
  EXPECT_FALSE(fs::exists(folder / "results.jsonl"));
}

TEST(Command, interrupted_twice_ends_at_once_and_keeps_what_is_finished)
{
  const fs::path folder = temporary("interrupted_twice"), err = temporary("interrupted_twice_err");
  const std::string file =
      write("long.prm", "set Problem/solution = x^3 + y^2\nset Methods/names = "
                        "DGQ2\nset Study/h = 0.1, 0.00125\n");
  const pid_t child = start("run " + file + " -o " + folder.string(), err.string());
  for (int i = 0; i < 6000 && !fs::exists(folder / "results.jsonl"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  for (const int signal : {SIGINT, SIGTERM}) // the second solve takes half a minute
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(child, signal);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  const std::string said = read(err);
  expect_found(said, "Ctrl-C again: ends now, finished results are kept");
  expect_found(said, "interrupted again: ended at once; finished results are kept");
  fs::remove(err);
  const Outcome outcome = run("report " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(read(folder / "results.json"), "DGQ2");
  fs::remove_all(folder);
}

// while it waits for a file that is a pipe
TEST(Command, interrupted_before_its_first_solve_ends_with_a_message)
{
  const std::string check = std::string(PLUMBLINE_SCENES) + "/check/";
  const fs::path pipe = temporary("pipe.prm"), err = temporary("pipe_err");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string &arguments :
       {"run " + pipe.string(), "stability " + pipe.string(),
        "check " + pipe.string() + " " + check + "bonds.csv --scene " + check + "check.prm"})
  {
    const pid_t child = start(arguments, err.string());
    int writing = -1; // it cannot be opened before the command reads
    for (int i = 0; i < 6000 && writing < 0; ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      writing = open(pipe.c_str(), O_WRONLY | O_NONBLOCK);
    }
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    close(writing);
    EXPECT_TRUE(WIFSIGNALED(status)) << arguments;
    expect_found(read(err), "\ninterrupted: results are missing or incomplete\n", arguments);
  }
  fs::remove(pipe);
  fs::remove(err);
}

// c = 72 kappa / (5 pi delta^4) for rho = 1/t, kappa = 2 E / 3 in plane strain
TEST(Command, prints_the_micromodulus_that_follows_from_E)
{
  const std::string file = write("tensor.prm", run("template tensor").out);
  const fs::path folder = temporary("micromodulus");
  const Outcome outcome = run("run " + file +
                              " --levels 1 --methods FA --set Material/E=3 --set "
                              "Study/h=0.1 --set Study/m=3 -o " +
                              folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string name = "micromodulus c, C = c ρ(|ξ|/δ) ξ⊗ξ/|ξ|²";
  expect_found(outcome.out, "\n" + name + ": ");
  const auto json = read_json(folder / "results.json");
  const std::string value = json.at("facts").at(name);
  const double c = 72 * 2 / (5 * M_PI * std::pow(.3, 4));
  EXPECT_NEAR(std::stod(value), c, 1e-5 * c);
  expect_found(value, " [force/length^6] at δ = 0.3, proportional to δ^-4");
  expect_found(read(folder / "report.html"), "force/length^6");
  fs::remove_all(folder);
}

TEST(ProgressLine, is_printed_after_a_second_and_then_rarely)
{
  testing::internal::CaptureStderr(); // a file, no terminal
  {
    plumbline::base::ProgressLine line(true);
    line.show("level 1 of 2", .25);
    std::this_thread::sleep_for(std::chrono::milliseconds(3500));
  }
  const std::string text = testing::internal::GetCapturedStderr();
  expect_found(text, " 25 %  level 1 of 2, ");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(ProgressLine, tells_the_time_left_by_the_steps_before)
{
  EXPECT_EQ(plumbline::base::time_left(10, 3, .25), "; some 27 s left");
  EXPECT_EQ(plumbline::base::time_left(10, 31, .25),
            "; longer than expected from the steps before");
  EXPECT_EQ(plumbline::base::time_left(0, 5, .25), ""); // resumed: the quarter took no time
  EXPECT_EQ(plumbline::base::time_left(10, 3, 0), "");
}

TEST(Command, a_killed_run_has_lost_nothing_that_is_finished)
{
  const fs::path folder = temporary("killed"), journal = folder / "results.jsonl";
  const std::string arguments = scene + " -o " + folder.string() +
                                " --methods FA,PA-AC,Q1,Q2,Q3,DGQ1,DGQ2 --set Study/m=3 --set "
                                "Expected/verdicts= --set Expected/errors=";
  const auto n_finished = [&]
  {
    const std::string text = fs::exists(journal) ? read(journal) : "";
    return std::count(text.begin(), text.end(), '\n');
  };
  const pid_t child = start("run " + arguments);
  for (int i = 0; i < 30000 && n_finished() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_GE(n_finished(), 2);
  EXPECT_FALSE(fs::exists(folder / "results.json"));

  EXPECT_EQ(run("report " + folder.string()).exit_code, 0);
  expect_found(read(folder / "results.json"), "\"is_complete\": false");
  const Outcome rest = run("run " + arguments);
  EXPECT_EQ(rest.exit_code, 0);
  expect_found(rest.err, "continuing: ");
  expect_found(read(folder / "results.json"), "\"is_complete\": true");
  EXPECT_FALSE(fs::exists(journal));
}

TEST(Command, lists_templates_and_descriptions_help_a_newcomer)
{
  expect_found(run("list methods").out, "IPA-AC-R2");
  expect_found(run("list methods").out, "also known as HHB, PA-HHB, PV-HHB\n");
  expect_found(run("list kernels").out, "bond-tensor");
  expect_found(run("list scenes").out, "scalar_delta_convergence.prm");
  expect_found(run("describe Study/m").out, "allowed");

  const fs::path folder = temporary("template");
  const std::string file = write("template.prm", run("template tensor").out);
  const Outcome outcome = run("run " + file + " --levels 2 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

// tests/docs/site.py compares it with the documentation, cell by cell
TEST(Command, what_methods_can_do_is_a_table)
{
  const std::string table = run("list methods --matrix").out;
  expect_found(table, "| lattice | meshes | quadrilaterals |");
  EXPECT_EQ(run("list kernels --matrix").exit_code, 2);
}

TEST(Command, a_summary_is_short_and_ends_in_the_answer)
{
  const Outcome many =
      run("run " + (fs::path(PLUMBLINE_SCENES) / "ipa_ac/constant_kernel.prm").string() + " -o " +
          temporary("summary").string());
  ASSERT_EQ(many.exit_code, 0) << many.err;
  std::istringstream lines(many.out);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);)
  {
    all.push_back(line);
    const auto n_characters =
        std::count_if(line.begin(), line.end(),
                      [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    EXPECT_LE(n_characters, 120) << line;
  }
  EXPECT_LE(all.size(), 25u);
  const auto cheapest =
      std::find_if(all.begin(), all.end(),
                   [](const std::string &line)
                   { return line.rfind("Cheapest to a relative error of 0.01: ", 0) == 0; });
  ASSERT_GE(cheapest - all.begin(), 2) << many.out;
  EXPECT_EQ(cheapest[-2], "✓ Converge: IPA-AC-R2, IPA-AC-R4, Q1, Q2, Q3, DGQ1, DGQ2.");
  EXPECT_EQ(cheapest[-1], "✗ Stall, however fine the mesh: FA, LAMMPS, QWJ, PA-AC, IPA-AC, DGQ0.");
  // costs take a second line where two methods cost the same within the clock's resolution; then
  // the table leaves out two of its 13 rows to make room for that line and for saying so
  if (all.end() - cheapest == 1)
    expect_found(many.out, "\nDGQ2 ");
  else
  {
    EXPECT_EQ(all.end() - cheapest, 2) << "the answer is not last:\n" << many.out;
    expect_found(many.out, "\nDGQ0 ");
    expect_found(many.out, "\n... 2 more rows in the report\n");
  }
}

TEST(Command, a_summary_without_advice_ends_in_the_estimated_error)
{
  plumbline::study::StudyResults results;
  results.decisive_error = "averages L2 | reference";
  plumbline::study::ErrorEstimate coarse, fine;
  coarse.problem = fine.problem = "u";
  coarse.series = fine.series = "m = 3";
  coarse.method = fine.method = "Q2";
  coarse.estimate = 1e-3;
  fine.level = 1;
  fine.h = .05;
  fine.estimate = 2e-5;
  fine.field_estimate = 3e-4;
  fine.certified_digits = 4;
  results.references = {coarse, fine};
  const std::string said = summary_of(results);
  expect_found(said, "Estimated error of Q2, u, m = 3, h = 0.05: 2e-05 (averages, L2), 0.0003 "
                     "(field, L2); 4 certified digits\n");
  EXPECT_EQ(said.find("0.001 (averages"), std::string::npos);
}

TEST(Command, a_summary_puts_methods_into_the_worst_of_their_classes)
{
  plumbline::study::StudyResults results;
  results.decisive_error = "nodal Linf | exact";
  using plumbline::study::Outcome;
  for (const auto &[problem, outcome] :
       {std::pair("u", Outcome::converges), std::pair("v", Outcome::stalls),
        std::pair("w", Outcome::converges)})
  {
    plumbline::study::Trend trend;
    trend.method = "FA";
    trend.problem = problem;
    trend.error = results.decisive_error;
    trend.outcome = outcome;
    results.trends.push_back(trend);
  }
  const std::string said = summary_of(results);
  expect_found(said, "✗ Stall in some cases: FA (1 of 3).\n");
  EXPECT_EQ(said.find("Converge"), std::string::npos);
}

TEST(Command, json_on_standard_output_is_the_results_file)
{
  const fs::path folder = temporary("json");
  const Outcome outcome = run("run " + scene +
                              " --json --levels 1 --methods FA --set Expected/verdicts= --set "
                              "Expected/errors= -o " +
                              folder.string());
  EXPECT_EQ(outcome.out, read(folder / "results.json"));
}
