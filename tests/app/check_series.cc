// `plumbline check` of a series of files, one pair for each mesh size, and of stiffnesses in place
// of weights.

#include "given_files.h"
#include "scene/values.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <sys/stat.h>
#include <thread>

namespace
{
  using namespace plumbline::app;

  std::string text_of(double h)
  {
    return plumbline::scene::short_number(h);
  }

  /// nodes_{h}.csv and bonds_{h}.csv of a rule in a folder; the names with {h}.
  class CheckSeries : public testing::Test
  {
  protected:
    CheckSeries() : folder_(temporary("check_series")) { fs::create_directories(folder_); }
    ~CheckSeries() override { fs::remove_all(folder_); }

    void write_level(const std::string &rule, double h) const
    {
      const Files files = files_of(example_weights(rule, 0, {{"Study/h", text_of(h)}}));
      fs::rename(files.nodes, folder_ / ("nodes_" + text_of(h) + ".csv"));
      fs::rename(files.bonds, folder_ / ("bonds_" + text_of(h) + ".csv"));
    }

    Outcome check_all(const std::string &more) const
    {
      return check("'" + (folder_ / "nodes_{h}.csv").string() + "'",
                   "'" + (folder_ / "bonds_{h}.csv").string() + "'", more);
    }

    fs::path folder_;
    const std::vector<double> sizes_ = {.125, .0625, .03125, .015625};
  };
} // namespace

TEST_F(CheckSeries, gives_rates_and_the_verdict_of_compatible_weights)
{
  for (const double h : sizes_)
    write_level("IPA-AC-R2", h);
  const fs::path out = folder_ / "out";
  const Outcome outcome = check_all("-o " + out.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(without_progress(outcome.err), "");
  expect_found(outcome.out, "wave, nodal Linf | exact: AC; ");
  expect_found(outcome.out, "\nas required\n");
  const auto json = read_json(out / "check.json");
  ASSERT_EQ(json["levels"].size(), sizes_.size());
  EXPECT_EQ(json["complaints"].size(), 0u);
  for (const auto &level : json["levels"])
    EXPECT_EQ(level["rule"]["name"], "IPA-AC-R2");
  EXPECT_EQ(json["study"]["advice"].size(), 0u);
  std::size_t n_trends = 0;
  for (const auto &trend : json["study"]["trends"])
    if (trend["method"] == "given weights" && trend["error"] == "nodal Linf | exact")
    {
      ++n_trends;
      EXPECT_NEAR(trend["rate"], 2, .1); // of the paper, with moments of degree 2 exact
      EXPECT_EQ(trend["verdict"], "AC");
    }
  EXPECT_EQ(n_trends, 1u);
  const std::string page = read(out / "report.html");
  expect_found(page, "id=\"convergence\"");
  expect_found(page, "<b>✓ Converge: given weights"); // the answer, before the verdicts
  EXPECT_LT(page.find("✓ Converge: given weights"), page.find("<h2>Verdicts"));
  for (const std::string cost :
       {"Work and precision", "setup CPU s"}) // of this program, not of theirs
    EXPECT_EQ(page.find(cost), std::string::npos) << cost;
  std::vector<double> errors, rates; // the last two columns of each level
  std::istringstream table(read(out / "levels.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line.substr(line.rfind("rule")), "rule,error of wave,rate of wave");
  while (std::getline(table, line))
  {
    const auto last = line.rfind(','), before = line.rfind(',', last - 1);
    errors.push_back(std::stod(line.substr(before + 1)));
    rates.push_back(last + 1 < line.size() ? std::stod(line.substr(last + 1)) : 0);
  }
  ASSERT_EQ(errors.size(), sizes_.size());
  for (std::size_t k = 1; k < errors.size(); ++k)
    EXPECT_NEAR(rates[k], std::log2(errors[k - 1] / errors[k]), 1e-12) << k;
  for (const double h : sizes_)
    EXPECT_TRUE(fs::exists(out / ("h_" + text_of(h)) / "report.html")) << h;
}

// the bonds of the first level come late
TEST_F(CheckSeries,
       tells_the_level_that_takes_longer_than_a_second_and_ends_after_it_if_interrupted)
{
  for (const double h : {.125, .0625})
    write_level("FA", h);
  const fs::path bonds = folder_ / "bonds_0.125.csv", err = folder_ / "err", out = folder_ / "out";
  const std::string rows = read(bonds);
  fs::remove(bonds);
  ASSERT_EQ(mkfifo(bonds.c_str(), 0600), 0);
  const std::string base = folder_.string();
  for (const bool is_interrupted : {false, true})
  {
    const pid_t child = start("check " + base + "/nodes_{h}.csv " + base +
                                  "/bonds_{h}.csv --scene " + scene_file + " -o " + out.string(),
                              err.string());
    std::ofstream pipe(bonds);
    std::this_thread::sleep_for(std::chrono::milliseconds(is_interrupted ? 0 : 1500));
    if (is_interrupted)
      kill(child, SIGINT);
    pipe << rows;
    pipe.close();
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), is_interrupted ? 130 : 1) << read(err);
    expect_found(read(err), is_interrupted ? "starts again from the beginning"
                                           : "  0 %  check, m = 3, h = 0.125: problem, ");
    const auto json = read_json(out / "check.json");
    EXPECT_EQ(json["levels"].size(), is_interrupted ? 1u : 2u);
    EXPECT_EQ(json["study"]["is_complete"], !is_interrupted);
  }
}

TEST_F(CheckSeries, goes_on_after_a_kill_between_levels_to_the_same_bits)
{
  for (const double h : sizes_)
    write_level("IPA-AC-R2", h);
  const fs::path whole = folder_ / "whole", killed = folder_ / "killed";
  const std::string base = folder_.string(), command = "check '" + base + "/nodes_{h}.csv' '" +
                                                       base + "/bonds_{h}.csv' --scene " +
                                                       scene_file + " -o ";
  ASSERT_EQ(run(command + whole.string()).exit_code, 0);
  EXPECT_FALSE(fs::exists(whole / "check.jsonl"));
  ASSERT_TRUE(kill_at(command + killed.string(), killed / "check.jsonl"))
      << "the check had ended before it was killed";
  const Outcome resumed = run(command + killed.string());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_found(resumed.err, "continuing: ");
  auto one = read_json(whole / "check.json"), other = read_json(killed / "check.json");
  for (auto *json : {&one, &other})
  {
    (*json)["study"].erase("provenance");
    for (auto &level : (*json)["levels"])
      level.erase("provenance");
  }
  EXPECT_EQ(one, other);
  EXPECT_EQ(read(whole / "levels.csv"), read(killed / "levels.csv"));
  // weights that have changed are checked anew
  ASSERT_TRUE(kill_at(command + killed.string(), killed / "check.jsonl"));
  write_level("FA", .125);
  EXPECT_EQ(run(command + killed.string()).err.find("continuing"), std::string::npos);
}

TEST_F(CheckSeries, leaves_out_levels_that_a_budget_does_not_allow)
{
  for (const double h : sizes_)
    write_level("IPA-AC-R2", h);
  const fs::path out = folder_ / "out";
  check_all("--budget 1e-9 -o " + out.string());
  const auto json = read_json(out / "check.json");
  EXPECT_EQ(json["levels"].size(), 1u);
  EXPECT_EQ(json["study"]["left_out"].size(), sizes_.size() - 1);
  check_all("--budget 1e9 -o " + out.string());
  const auto all = read_json(out / "check.json");
  EXPECT_EQ(all["levels"].size(), sizes_.size());
  EXPECT_EQ(all["study"]["left_out"].size(), 0u);
  for (const std::string budget : {"-3", "0"})
  {
    const Outcome refused = check_all("--budget " + budget);
    EXPECT_EQ(refused.exit_code, 2);
    expect_found(refused.err, "--budget = " + budget +
                                  " is not positive; give CPU seconds of one "
                                  "level, or leave it out");
  }
  const Outcome alone = check(nodes_file, bonds_file, "--budget 1e9");
  EXPECT_EQ(alone.exit_code, 2);
  expect_found(alone.err, "--budget is for a series of files; give names with {h}");
}

TEST_F(CheckSeries, says_that_errors_stall)
{
  for (const double h : sizes_)
    write_level("FA", h);
  const Outcome outcome = check_all("");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "h = 0.125: required ac: second moments are off by ");
  expect_found(outcome.out, "wave, nodal Linf | exact: not AC; ");
  // where moments may be off by so much, the errors still stall
  const Outcome loose = check_all("--json --require moments=0.2");
  EXPECT_EQ(loose.exit_code, 0) << loose.out;
  EXPECT_EQ(parse_json(loose.out)["complaints"].size(), 0u);
  const auto json = parse_json(check_all("--json").out);
  EXPECT_EQ(json["complaints"].size(), sizes_.size() + 1);
  expect_found(json["complaints"].back(), "required ac: wave, nodal Linf | exact: ");
}

TEST_F(CheckSeries, names_what_is_missing)
{
  const auto expect_refusal = [](const Outcome &outcome, const std::string &words)
  {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    expect_found(outcome.err, words);
  };
  write_level("FA", .125);
  expect_refusal(check_all(""), "two levels of Study/h at least, but there is no '" +
                                    (folder_ / "nodes_0.0625.csv").string());
  expect_refusal(check("'" + (folder_ / "nodes_{h}.csv").string() + "'", bonds_file),
                 "write {h} in both names");
  write_level("FA", .0625);
  expect_refusal(check_all("--set Study/m=2,3"), "give one value of Study/m");
  const Outcome outcome = check_all("");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.err, "levels without files are left out: there is no '" +
                                (folder_ / "nodes_0.03125.csv").string());
  expect_found(outcome.out, "undecided"); // of two levels
}

TEST(Check, takes_stiffnesses_and_force_constants)
{
  for (const std::string rule : {"IPA-AC-R2", "FA", "PA-AC"})
    for (const double perturbation : {0., .1})
      for (const bool are_forces : {false, true})
      {
        Weights weights = example_weights(rule, perturbation, {{"Kernel/type", "constant"}});
        for (std::size_t i = 0; i < weights.families.size(); ++i)
          for (Bond<2> &bond : weights.families[i].bonds)
            bond.weight *= plumbline::meshfree::radial_value(weights.problem.kernel, bond) *
                           (are_forces ? weights.volumes[i] : 1);
        const Files files = files_of(weights);
        const std::string kind = are_forces ? "'force constants'" : "stiffness";
        const Outcome right =
            check(files.nodes, files.bonds,
                  "--set Kernel/type=constant --require moments=0.3 --json --bonds-are " + kind);
        EXPECT_EQ(right.exit_code, 0) << rule << perturbation << kind << right.out << right.err;
        const auto json = parse_json(right.out);
        EXPECT_EQ(json["rule"]["name"], rule) << perturbation << kind;
        if (are_forces) // which are of the size of weights here: 4 / (81 pi h^2) times them
          continue;
        const Outcome plain = check(files.nodes, files.bonds,
                                    "--set Kernel/type=constant --require moments=0.3 --quiet");
        EXPECT_EQ(plain.exit_code, 1) << rule << perturbation;
      }
  const Outcome word = check(nodes_file, bonds_file, "--bonds-are forces");
  EXPECT_EQ(word.exit_code, 2);
  expect_found(word.err,
               "--bonds-are = 'forces' is not known; choose one of 'weights', 'stiffness'");
  Weights wide = example_weights("PA-AC", 0); // has bonds where the kernel is 0
  const Files files = files_of(wide);
  const Outcome beyond = check(files.nodes, files.bonds, "--bonds-are stiffness");
  EXPECT_EQ(beyond.exit_code, 2) << beyond.out;
  expect_found(beyond.err, "the kernel is 0 at a bond (line ");
}
