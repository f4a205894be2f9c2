// `plumbline dispersion`: what it says of shipped scenes, and what it refuses.

#include "command.h"
#include "goes_on.h"

#include <nlohmann/json.hpp>

namespace
{
  using namespace plumbline::app;

  std::string scene(const std::string &name)
  {
    return std::string(PLUMBLINE_SCENES) + "/waves/" + name + ".prm";
  }

  void expect_no_waves(const std::string &arguments, const std::string &message)
  {
    expect_refused("dispersion " + arguments, message);
  }
} // namespace

TEST(DispersionCommand, says_by_waves_what_is_proven_by_moments)
{
  for (const std::string name : {"double_well_constant", "double_well_decaying"})
  {
    const fs::path folder = temporary("dispersion");
    const Outcome outcome =
        run("dispersion " + scene(name) + " --json --set Study/m=3 -o " + folder.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = parse_json(outcome.out);
    std::size_t n = 0;
    for (const auto &trend : json["trends"])
    {
      const std::string method = trend["method"], found = trend["verdict"];
      const bool is_compatible = method.find("-R") != std::string::npos || method[0] == 'Q';
      const bool is_qwj = method == "QWJ";
      EXPECT_EQ(found, is_compatible && !is_qwj ? "AC" : "not AC")
          << name << ", " << method << ": " << trend["reason"];
      EXPECT_EQ(found == "AC", trend["proof"]["answer"] == "compatible") << name << ", " << method;
      ++n;
    }
    EXPECT_EQ(n, 12u); // ten methods, Q1 and Q2 with a lumped mass, too
  }
}

TEST(DispersionCommand, writes_a_page_with_tables_and_charts)
{
  const fs::path folder = temporary("dispersion");
  const Outcome outcome = run("dispersion " + scene("diffusion") +
                              " --methods FA,Q1 --levels 2 --angles 0,30 -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "critical step");
  expect_found(outcome.out, "Q1 lumped");
  expect_found(outcome.out, "2 of the 4 levels that a verdict needs");
  expect_found(fs::exists(folder / "dispersion.html") ? read(folder / "dispersion.html") : "",
               "<svg");
  expect_found(read(folder / "dispersion.md"), "30°");
  EXPECT_TRUE(fs::exists(folder / "dispersion/phase_delta-0.2_waves-at-30.svg"));
  EXPECT_TRUE(fs::exists(folder / "dispersion/errors_delta-0.2.csv"));
  EXPECT_EQ(read_json(folder / "dispersion.json")["records"].size(), 6u);
}

TEST(DispersionCommand, takes_directions_however_they_are_separated)
{
  const auto angles = [](const std::string &arguments)
  {
    const Outcome outcome =
        run("dispersion " + scene("diffusion") + " --methods FA --levels 1 --threads 1 --json -o " +
            temporary("dispersion").string() + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << ": " << outcome.err;
    return parse_json(outcome.out)["facts"]["directions"].get<std::string>();
  };
  const std::string expected = "0°, -30.5°, 45°";
  for (const std::string text :
       {"--angles 0,-30.5,45", "--angles 0 -30.5 45", "--angles '0 -30.5 45'",
        "--angles '0; -30.5; 45'", "--angles=0 --angles=-30.5,45", "--angles 0, -30.5 , 45,",
        "--angles 0 -30.5 --angles 45"})
    EXPECT_EQ(angles(text), expected) << text;
  EXPECT_EQ(angles(""), "0°, 22.5°, 45°");
  // before the scene, too
  const Outcome outcome =
      run("dispersion --angles 10 20 " + scene("diffusion") +
          " --methods FA --levels 1 --json -o " + temporary("dispersion").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(DispersionCommand, takes_rules_that_are_infeasible_as_findings)
{
  const fs::path folder = temporary("dispersion");
  const Outcome outcome =
      run("dispersion " + scene("double_well_decaying") +
          " --methods IPA-AC-R4 --set Study/m=2 --levels 1 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "Levels without results");
  expect_found(outcome.out, "are infeasible for m = 2");
}

TEST(DispersionCommand, refuses_what_has_no_waves)
{
  const std::string diffusion = scene("diffusion");
  expect_no_waves(diffusion + " --set Domain/mesh=squares", "Domain/mesh = squares");
  expect_no_waves(diffusion + " --set Solver/model=full", "Solver/model = full");
  expect_no_waves(diffusion + " --angles x", "--angles: 'x' is not a number");
  expect_no_waves(diffusion + " --angles 0,3o", "--angles: '3o' is not a number");
  expect_no_waves(diffusion + " --angles ''", "--angles has no numbers");
  expect_no_waves(std::string(PLUMBLINE_SCENES) + "/state_based/bar.prm", "Domain/boundary = free");
  expect_no_waves(std::string(PLUMBLINE_SCENES) + "/lps/interface_crack.prm", "Domain/mesh");
  expect_no_waves(diffusion + " --methods LOCAL", "Domain/mesh = lattice; take FA");
  expect_no_waves(diffusion + " --methods QWERTY", "QWERTY");
  expect_no_waves(diffusion + " --angles 1e9", "--angles");
  expect_no_waves(diffusion + " --set 'Domain/boxes=0, 0 : 0.1, 0.1' --set Study/h=0.1",
                  "Study/h = 0.1 carries no wave as long as the domain");
  expect_no_waves(diffusion + " --set Kernel/limit=none --set Kernel/constant=-1", "positive");
}

TEST(DispersionCommand, interrupted_keeps_what_is_finished)
{
  const fs::path folder = temporary("dispersion");
  ASSERT_EQ(interrupt_at("dispersion " + scene("diffusion") + " --quiet -o " + folder.string(),
                         folder / "dispersion.jsonl"),
            130);
  const auto json = read_json(folder / "dispersion.json");
  EXPECT_FALSE(json["is_complete"]);
  EXPECT_GE(json["records"].size(), 1u);
  EXPECT_TRUE(fs::exists(folder / "dispersion.jsonl")); // the same command goes on from it
  expect_found(read(folder / "dispersion.html"), "interrupted: what was finished");
  fs::remove_all(folder);
}

TEST(DispersionCommand, killed_goes_on_from_what_is_finished)
{
  expect_to_go_on("dispersion " + scene("diffusion") + " --methods Q1,Q2,FA --levels 3",
                  "dispersion");
}

namespace
{
  const std::string in_space =
      std::string(PLUMBLINE_SCENES) + "/three_d/tensor_delta_convergence.prm";
}

TEST(DispersionCommand, says_by_waves_in_space_what_is_proven_by_moments)
{
  const fs::path folder = temporary("dispersion");
  const Outcome outcome = run("dispersion " + in_space + " --json -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = parse_json(outcome.out);
  EXPECT_EQ(json["facts"]["directions"], "(1, 0, 0), (1, 1, 0), (1, 1, 1)");
  std::size_t n = 0;
  for (const auto &trend : json["trends"])
  {
    const std::string method = trend["method"];
    const bool is_compatible =
        method.find("-R") != std::string::npos || method.find("Q1") == 0 || method == "OPT";
    EXPECT_EQ(trend["verdict"], is_compatible ? "AC" : "not AC") << method << trend["reason"];
    EXPECT_EQ(is_compatible, trend["proof"]["answer"] == "compatible") << method;
    ++n;
  }
  EXPECT_EQ(n, 11u); // ten methods, Q1 with a lumped mass, too
  EXPECT_TRUE(fs::exists(folder / "dispersion/phase_m-3_t1-waves-along-1-1-0.svg"));
  expect_found(read(folder / "dispersion.md"), "T2 waves along (1, 1, 1)");
}

TEST(DispersionCommand, takes_vectors_as_directions_in_space)
{
  const fs::path folder = temporary("dispersion");
  const Outcome outcome = run("dispersion --directions 0,0,1 1 1 -1 " + in_space +
                              " --methods FA --levels 1 --threads 1 --json -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(parse_json(outcome.out)["facts"]["directions"], "(0, 0, 1), (1, 1, -1)");
  expect_no_waves(in_space + " --directions 1,0", "--directions has 2 numbers; give three");
  expect_no_waves(in_space + " --directions 0,0,0", "(0, 0, 0) is not a direction");
  expect_no_waves(in_space + " --angles 45", "--angles is for two dimensions");
  expect_no_waves(scene("diffusion") + " --directions 1,0,0",
                  "--directions is for three dimensions");
}
