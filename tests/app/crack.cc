// `plumbline crack`: what it says of notched strips, that it goes on after a kill, and what it
// refuses.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <sys/resource.h>

namespace
{
  using namespace plumbline::app;

  std::string scene(const std::string &name)
  {
    return std::string(PLUMBLINE_SCENES) + "/griffith/" + name + ".prm";
  }

  nlohmann::json records(const fs::path &folder)
  {
    return read_json(folder / "crack.json")["records"];
  }

  double scalar(const nlohmann::json &record, const std::string &name)
  {
    return record["scalars"][name]["value"];
  }
} // namespace

TEST(CrackCommand, finds_threshold_and_speed_and_draws_them)
{
  const fs::path folder = temporary("crack");
  const Outcome outcome = run("crack " + scene("speed") +
                              " --levels 1 --check --set Time/frames=3 -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "to the last bit");
  const auto json = records(folder);
  ASSERT_EQ(json.size(), 1u);
  const auto &record = json[0];
  EXPECT_NEAR(scalar(record, "W H / G_c,h"), .9489, 6e-5);
  EXPECT_LT(scalar(record, "fastest / c_R"), 1);
  EXPECT_GT(scalar(record, "speed / c_R"), .4);
  EXPECT_LT(scalar(record, "energy drift"), .01);
  EXPECT_EQ(scalar(record, "asymmetry"), 0);
  EXPECT_EQ(record["texts"]["outcome"], "runs");
  EXPECT_EQ(record["curves"]["samples"][0]["values"].size(), 101u);
  const auto &damage = record["fields"]["damage"];
  EXPECT_EQ(damage["n_components"], 6);
  EXPECT_EQ(damage["values"].size(), 3 * damage["points"].size());
  const std::string page = read(folder / "crack.html");
  expect_found(page, "<svg");
  expect_found(page, "What was left out of the model");
  for (const char *const name : {"moments", "tip", "speed", "energies"})
    EXPECT_TRUE(fs::exists(folder / "crack" / (std::string(name) + ".svg"))) << name;
  expect_found(read(folder / "frames/frame.pvd"), "frame_00003.vtu");
  expect_found(read(folder / "frames/frame_00003.vtu"), "damage");
  EXPECT_FALSE(fs::exists(folder / "checkpoint.h5"));
  fs::remove_all(folder);
}

TEST(CrackCommand, finds_the_same_crack_in_other_units)
{
  const double length = .01, shear = 72e9 / 2.5, density = 2440; // of glass.prm; speed.prm: 1
  const double time = length * std::sqrt(density / shear / 6);
  const auto crack = [](const std::string &name, const std::string &settings)
  {
    const fs::path folder = temporary("crack_" + name);
    EXPECT_EQ(run("crack " + scene(name) + " --levels 1 " + settings + " -o " + folder.string())
                  .exit_code,
              0);
    const auto record = records(folder)[0];
    fs::remove_all(folder);
    return record;
  };
  std::ostringstream final_time;
  final_time << std::setprecision(16) << "'Time/final time=" << 3 * time << "'";
  const auto glass = crack("glass", "--set " + final_time.str()),
             unit = crack("speed", "--set 'Time/final time=3'");
  for (const std::string name : {"speed / c_R", "fastest / c_R", "soft energy / G_c,h"})
    EXPECT_NEAR(scalar(glass, name), scalar(unit, name), 1e-6 * scalar(unit, name)) << name;
  EXPECT_GT(scalar(unit, "advance"), .2);
  EXPECT_NEAR(scalar(glass, "advance"), length * scalar(unit, "advance"), 1e-6 * length);
  EXPECT_NEAR(scalar(glass, "c_T"), std::sqrt(shear / density), 1e-6);
  EXPECT_NEAR(scalar(glass, "G_c"), 8, 1e-12 * 8);
  // constant influence: M_2 = 1/3, G_c = 4 c M_2 / pi, mu = c beta M_2 / 2
  EXPECT_NEAR(scalar(glass, "c"), 6 * M_PI, 1e-12 * 6 * M_PI);
  EXPECT_NEAR(scalar(glass, "beta"), shear / M_PI, 1e-12 * shear);
  EXPECT_NEAR(scalar(glass, "softening strain"),
              1 / std::sqrt(2 * shear / M_PI * 4 * .025 * length), 1e-12);
  EXPECT_NEAR(scalar(glass, "speed"), length / time * scalar(unit, "speed"),
              1e-6 * scalar(glass, "speed"));
}

TEST(CrackCommand, says_when_a_crack_does_not_do_what_is_expected)
{
  const fs::path folder = temporary("crack");
  const Outcome outcome =
      run("crack " + scene("speed") +
          " --levels 1 --check --quiet --set Expected/crack=arrests -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.err, "Expected/crack: found runs");
  fs::remove_all(folder);
}

TEST(CrackCommand, fails_with_3_when_the_motion_does)
{
  const fs::path folder = temporary("crack");
  const Outcome outcome = run("crack " + scene("speed") +
                              " --levels 1 --quiet --set Time/steps=0.2 --set 'Time/show "
                              "blow-up=true' --set 'Time/schemes=explicit Euler' --set "
                              "Time/damping=1e6 --set 'Time/final time=40' -o " +
                              folder.string());
  EXPECT_EQ(outcome.exit_code, 3);
  expect_found(outcome.err, "the solution is not finite any more");
  EXPECT_NE(records(folder)[0]["failure"], "");
  EXPECT_FALSE(fs::exists(folder / "crack.jsonl"));
  fs::remove_all(folder);
}

TEST(CrackCommand, goes_on_after_it_was_killed_to_the_same_bits)
{
  const fs::path whole = temporary("whole"), killed = temporary("killed");
  // a second or two, a checkpoint at every sample
  const std::string command = "crack " + scene("speed") +
                              " --quiet --levels 1 --set 'Time/critical fractions=0.1' --set "
                              "Time/damping=0.1 --set 'Crack/checkpoint interval=1' --set "
                              "Time/frames=5 -o ";
  const pid_t first = start(command + whole.string());
  ASSERT_TRUE(kill_at(command + killed.string(), killed / "checkpoint.h5"))
      << "the run had ended before it was killed";
  ASSERT_TRUE(fs::exists(killed / "checkpoint.h5"));
  EXPECT_FALSE(fs::exists(killed / "crack.json"));
  const Outcome resumed = run(command + killed.string());
  waitpid(first, nullptr, 0);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto again = records(killed)[0], at_once = records(whole)[0];
  EXPECT_GT(scalar(again, "resumed at"), 0);
  EXPECT_EQ(scalar(at_once, "resumed at"), 0);
  for (const char *const part : {"curves", "fields", "texts"})
    EXPECT_EQ(again[part], at_once[part]) << part;
  for (const char *const name : {"frames/frame_00005.vtu", "frames/frame_00000.vtu",
                                 "crack/samples.csv", "crack/charts.gp", "crack/pictures.gp"})
    EXPECT_TRUE(read(killed / name) == read(whole / name)) << name;
  fs::remove_all(whole);
  fs::remove_all(killed);
}

TEST(CrackCommand, refuses_what_is_no_notched_strip)
{
  const std::string strip = "crack " + scene("speed") + " --quiet --levels 1 ";
  const auto set = [&](const std::string &setting) { return strip + "--set '" + setting + "'"; };
  expect_refused("crack " + std::string(PLUMBLINE_SCENES) + "/waves/diffusion.prm",
                 "Crack/notch (the notch's length)");
  expect_refused(set("Crack/notch=-1"), "Crack/notch = -1 must be a length > 0");
  expect_refused(set("Crack/notch=0.51"), "Crack/notch = 0.51 is 20.4 mesh sizes");
  expect_refused(set("Crack/notch=3"), "cuts through the strip, which is 3 long");
  expect_refused(set("Crack/load=0"), "Crack/load = 0 must be positive");
  expect_refused(set("Crack/load=50"), "bonds soften everywhere");
  expect_refused(set("Crack/samples=2"), "Crack/samples = '2' is not allowed");
  expect_refused(set("Time/final time=-1"), "Time/final time = -1");
  expect_refused(set("Time/final time=0"), "this is missing: Time/final time (the duration)");
  expect_refused(set("Time/density=-1' --set 'Material/c=1"), "Time/density = -1 must be positive");
  expect_refused(set("Time/steps=0"), "Time/steps = 0 must be positive");
  expect_refused(set("Time/steps=0.2") + " --set Study/h=0.0125",
                 "longer than the critical step 0.0473");
  expect_refused(set("Material/beta=-1"), "Material/beta = -1 must be positive");
  expect_refused(set("Material/c=0"), "Material/c = 0 must be positive");
  expect_refused(set("Material/model=bond-based") + " --set Kernel/type=bond-tensor",
                 "take double well");
  expect_refused(set("Domain/boxes=0, 0 : 3, 1 : 0, 0"), "Domain/boxes");
  expect_refused(set("Domain/boxes=0, 0 : 3, 0.975"), "even number of mesh sizes");
  expect_refused(set("Domain/boxes=0, 0 : 3, 0.3"), "less than four horizons");
  expect_refused(set("Problem/solution=x, y"), "Problem/solution, load and constraint");
  expect_refused(strip + "--methods Q1", "'Q1' is not a meshfree rule");
  expect_refused(strip + "--methods FA,PA-AC", "one meshfree method");
  expect_refused("run " + scene("speed"), "'plumbline crack' simulates it");
}

TEST(CrackCommand, refuses_frames_that_would_fill_the_disk)
{
  const std::string strip =
      "crack " + scene("speed") + " --quiet --levels 1 --set Study/m=2 --set ";
  expect_refused(strip + "Study/h=0.001 --set Time/frames=100000 --set Crack/samples=100000",
                 "Time/frames = 100000: 100000 frames and a checkpoint of");
  expect_refused(strip + "Study/h=0.1 --set Time/frames=101", "is more than Crack/samples = 100");
}

#ifndef __SANITIZE_ADDRESS__ // which takes all of the address space
TEST(CrackCommand, refuses_strips_that_do_not_fit_into_memory)
{
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit little{rlim_t{8} << 30, before.rlim_max}; // whatever this machine has
  setrlimit(RLIMIT_AS, &little);
  expect_refused("crack " + scene("speed") +
                     " --quiet --levels 1 --set Study/m=2 --set Study/h=0.0003 --set "
                     "Crack/notch=0.6 --set 'Domain/boxes=0, 0 : 3, 3'",
                 "a strip of 1e+08 nodes: needs some 73 GB of memory");
  setrlimit(RLIMIT_AS, &before);
}
#endif

TEST(CrackCommand, refuses_a_checkpoint_that_is_none)
{
  const fs::path folder = temporary("crack");
  fs::create_directories(folder);
  std::ofstream(folder / "checkpoint.h5") << "no HDF5";
  const Outcome outcome =
      run("crack " + scene("speed") + " --levels 1 --quiet -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "remove it to begin anew");
  fs::remove_all(folder);
}
