// `plumbline strip`: what it writes, and what it refuses.

#include "command.h"
#include "goes_on.h"

#include <nlohmann/json.hpp>

namespace
{
  using namespace plumbline::app;

  std::string scene()
  {
    return std::string(PLUMBLINE_SCENES) + "/fracture/strip.prm";
  }
} // namespace

TEST(StripCommand, charts_a_tip_by_both_sides)
{
  const fs::path folder = temporary("strip");
  const Outcome outcome = run("strip " + scene() + " --methods DGQ0,PA-AC -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "W1 (delta = 0.3) of 2 methods: limits between");
  const auto json = read_json(folder / "strip.json");
  ASSERT_EQ(json["records"].size(), 8u);
  EXPECT_NEAR(json["records"][0]["scalars"]["tip energy"]["value"], .67459, 1e-5);
  EXPECT_EQ(json["records"][0]["curves"]["opening"][1]["values"].size(), 24u);
  const std::string page = read(folder / "strip.html");
  expect_found(page, "<svg");
  expect_found(page, "Energy and opening at the crack tip");
  for (const char *const name : {"tip-energy.svg", "tip-energy.csv", "profile.svg", "w1.svg"})
    EXPECT_TRUE(fs::exists(folder / "strip" / name)) << name;
  fs::remove_all(folder);
}

TEST(StripCommand, interrupted_keeps_what_is_finished)
{
  // the first level takes a moment, the last one minutes
  const fs::path folder = temporary("strip");
  EXPECT_EQ(interrupt_at("strip " + std::string(PLUMBLINE_SCENES) +
                             "/fracture/strip_growth_narrow.prm --quiet -o " + folder.string(),
                         folder / ".plumbline"),
            130);
  const auto json = read_json(folder / "strip.json");
  EXPECT_FALSE(json["is_complete"]);
  EXPECT_LT(json["records"].size(), 4u);
  expect_found(read(folder / "strip.html"), "interrupted: what was finished");
}

TEST(StripCommand, killed_goes_on_from_what_is_finished)
{
  expect_to_go_on("strip " + scene() + " --methods PA-AC,Q1 --levels 2", "strip");
}

TEST(StripCommand, charts_a_crack_in_its_own_field)
{
  const fs::path folder = temporary("strip");
  const Outcome outcome =
      run("strip " + std::string(PLUMBLINE_SCENES) +
          "/fracture/k_field_strip.prm --methods Q1,OPT --levels 2 -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "G E'/K^2");
  const auto json = read_json(folder / "strip.json");
  EXPECT_EQ(json["facts"]["edges"], "K field");
  EXPECT_NEAR(json["records"][0]["scalars"]["K^2/E'"]["value"], .375, 1e-15); // of mu = 1
  EXPECT_FALSE(json["records"][0]["scalars"].contains("tip energy"));
  expect_found(read(folder / "strip.html"), "over K²/E");
  for (const char *const name : {"g.svg", "g.csv", "profile.svg", "opening.svg"})
    EXPECT_TRUE(fs::exists(folder / "strip" / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "strip" / "tip-energy.svg"));
  fs::remove_all(folder);
}

TEST(StripCommand, lets_cracks_grow_by_rules)
{
  const fs::path folder = temporary("strip");
  const std::string command =
      "strip " + std::string(PLUMBLINE_SCENES) + "/fracture/strip_growth.prm --levels 1";
  const Outcome outcome = run(command + " --methods OPT,DGQ0 -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "growth peak");
  const auto json = read_json(folder / "strip.json");
  const auto growth = [&](const std::string &what) -> double
  { return json["records"][0]["scalars"]["growth " + what]["value"]; };
  EXPECT_NEAR(growth("peak"), 1.994, .006);  // of a prototype, at a horizon of 1/16
  EXPECT_NEAR(growth("bonds"), .7854, 5e-5); // all bonds across a straight line, pi/4 here
  EXPECT_GT(growth("released"), growth("bonds"));
  EXPECT_FALSE(json["records"][1]["scalars"].contains("growth peak")); // of Galerkin methods
  EXPECT_TRUE(fs::exists(folder / "strip/growth-peak.svg"));
  fs::remove_all(folder);
  expect_refused(command + " --set Strip/length=6", "after its growth");
  expect_refused(command + " --set 'Strip/edges=K field'", "needs Strip/edges = grips");
}

TEST(StripCommand, says_what_is_not_as_expected)
{
  const fs::path folder = temporary("strip");
  const std::string command = "strip " + scene() + " --levels 1 --methods PA-AC --quiet -o " +
                              folder.string() + " --check --set ";
  EXPECT_EQ(run(command + "'Expected/strip=PA-AC, tip energy: 0.46131'").exit_code, 0);
  const Outcome outcome = run(command + "'Expected/strip=PA-AC, tip energy: 0.47'");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.err, "found 0.4613");
  fs::remove_all(folder);
}

TEST(StripCommand, refuses_what_is_no_strip)
{
  struct Bad
  {
    std::string arguments, message;
  };
  const std::string strip = "strip " + scene();
  for (const Bad &bad :
       {Bad{"run " + scene(), "Strip/length is for 'plumbline strip'"},
        {"strip " + std::string(PLUMBLINE_SCENES) + "/fracture/plate.prm", "Strip/length is 0"},
        {strip + " --methods DGP1", "DGP1 is not for lattices"},
        {strip + " --set Strip/length=-1", "Strip/length = -1 must be a length"},
        {strip + " --set Strip/crack=8", "Strip/crack = 8 must end in the strip"},
        {strip + " --set Strip/crack=3.62", "mesh sizes"},
        {strip + " --set Strip/height=2.45", "even multiple"},
        {strip + " --set Study/horizon=0.8", "less than four horizons"},
        {strip + " --set Material/nu=0.3", "lambda = mu"},
        {strip + " --set Kernel/type=constant", "Kernel/type = 1/r"},
        {strip + " --set Domain/mesh=squares", "needs the default values of Domain"},
        {strip + " --set Problem/load=0,0", "Problem/solution, load and constraint empty"},
        {strip + " --set Study/h=0.01", "available"},
        {strip + " --set Study/h=0.0006", "more than 10000 along a side"},
        {"stability " + scene(), "Strip/length is for 'plumbline strip'"},
        {strip + " --set Time/final\\ time=1", "Time/final time = 1"}})
    expect_refused(bad.arguments, bad.message);
}
