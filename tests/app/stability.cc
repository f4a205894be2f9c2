// `plumbline stability`, and failures that are refused instead of computed.

#include "command.h"
#include "goes_on.h"

#include <nlohmann/json.hpp>

namespace
{
  using namespace plumbline::app;

  std::string scene(const std::string &name)
  {
    return std::string(PLUMBLINE_SCENES) + "/failures/" + name + ".prm";
  }

  void expect_end(const std::string &arguments, int exit_code, const std::string &message)
  {
    const fs::path folder = temporary("stability");
    const Outcome outcome = run(arguments + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << '\n' << outcome.err;
    expect_found(outcome.err, message);
  }
} // namespace

TEST(StabilityCommand, says_and_writes_where_a_rule_breaks)
{
  const fs::path folder = temporary("stability");
  const Outcome outcome =
      run("stability " + scene("too_few_neighbours") + " --levels 1 --check -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "OPT        conditionally stable  m >= 2.24");
  expect_found(outcome.out, "IPA-AC-R2  stable");
  expect_found(read(folder / "stability.md"), "| 12/18 |");
  expect_found(read(folder / "stability.json"), "\"verdict\": \"conditionally stable\"");
  EXPECT_TRUE(fs::exists(folder / "stability/ipa-ac-r2_m-3.vtu"));
  EXPECT_TRUE(fs::exists(folder / "stability/lowest-modes_m-3.svg"));
  expect_found(read(folder / "stability.html"), "m &gt;= 2.24");
}

// The same in three dimensions, where modes are for ParaView alone.
TEST(StabilityCommand, says_in_space_where_rules_break)
{
  const fs::path folder = temporary("stability");
  const Outcome outcome =
      run("stability " + std::string(PLUMBLINE_SCENES) +
          "/three_d/small_families.prm --levels 1 --check -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "OPT        conditionally stable  m >= 2");
  const auto records = read_json(folder / "stability.json")["records"];
  EXPECT_EQ(records.at(0)["fields"]["mode 1"]["z"].size(), 64u);
  expect_found(read(folder / "stability/ipa-ac-r2_m-2.vtu"), "0.125 0.125 0.375\n");
  EXPECT_FALSE(fs::exists(folder / "stability/lowest-modes_m-2.svg"));
}

TEST(StabilityCommand, interrupted_keeps_what_is_finished)
{
  // the finest level of FA at m = 3 is there, those of DGQ1 and of m = 4 and 5 take a minute
  const fs::path folder = temporary("stability");
  EXPECT_EQ(interrupt_at("stability " + std::string(PLUMBLINE_SCENES) +
                             "/ipa_ac/scalar_delta_convergence.prm --methods FA,DGQ1,Q1 --quiet "
                             "--set Expected/rates= --set Expected/verdicts= -o " +
                             folder.string(),
                         folder / "stability/fa_m-3.vtu"),
            130);
  const auto json = read_json(folder / "stability.json");
  EXPECT_FALSE(json["is_complete"]);
  EXPECT_GE(json["records"].size(), 10u);
  EXPECT_EQ(json["verdicts"].size(), 3u);
  expect_found(read(folder / "stability.html"), "interrupted: what was finished");
}

TEST(StabilityCommand, leaves_out_what_exceeds_the_budget_and_says_so)
{
  const fs::path folder = temporary("stability");
  const std::string command = "stability " + scene("too_few_neighbours") +
                              " --methods OPT --set Study/m=3 -o " + folder.string();
  const Outcome outcome = run(command + " --budget 1e-9");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "left out by the budget: OPT, m = 3, h = ");
  const auto json = read_json(folder / "stability.json");
  EXPECT_EQ(json["records"].size(), 1u); // the first level has nothing before it to judge by
  EXPECT_GE(json["left_out"].size(), 1u);
  EXPECT_EQ(run(command + " --budget -1").exit_code, 2);
}

TEST(StabilityCommand, killed_goes_on_from_what_is_finished)
{
  expect_to_go_on("stability " + std::string(PLUMBLINE_SCENES) +
                      "/ipa_ac/scalar_delta_convergence.prm --methods IPA-AC-R2,DGQ1 --levels 3 "
                      "--set Study/m=3,4 --set Expected/rates= --set Expected/verdicts=",
                  "stability");
}

TEST(StabilityCommand, refuses_levels_that_do_not_fit_into_memory)
{
  expect_end("stability " + scene("too_few_neighbours") +
                 " --methods DGQ3 --set Study/h=0.1,0.0001",
             2, "DGQ3 at h = 0.0001, horizon = ");
}

TEST(StabilityCommand, fails_with_1_when_a_verdict_is_not_as_expected)
{
  expect_end("stability " + scene("too_few_neighbours") +
                 " --levels 1 --check --set 'Expected/stability=OPT: stable'",
             1, "OPT: stable: found conditionally stable");
  expect_end("stability " + scene("too_few_neighbours") +
                 " --levels 1 --methods HHB --check --set 'Expected/stability=HHB: unstable'",
             1, "HHB: unstable: found stable");
  expect_end("stability " + scene("too_few_neighbours") +
                 " --levels 1 --methods QWJ --check --set 'Expected/stability=HHB: stable'",
             0, "");
}

TEST(Failures, that_are_refused)
{
  // families of nothing but their own node
  expect_end("run " + scene("stall_in_delta") + " --set Study/m=0.9", 2, "Study/m");
  expect_end("run " + scene("stall_in_delta") + " --set Study/regime=m --set Study/horizon=0.05", 2,
             "horizon");
  // a body that can move as a whole
  expect_end("run " + std::string(PLUMBLINE_SCENES) + "/state_based/bar.prm --set Domain/fixed=", 2,
             "3 rigid modes");
  // incompressible
  expect_end("run " + scene("incompressible") + " --set Material/nu=0.5", 2, "nu");
  // an outer rule that is known to be too coarse
  expect_end("run " + scene("coarse_outer_rule") +
                 " --set Quadrature/tolerance=1e-9 --set 'Quadrature/max refinements=1' --levels 1",
             3, "outer quadrature");
}
