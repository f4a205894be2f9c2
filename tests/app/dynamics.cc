// `plumbline run` of scenes that move: what it writes, and what it refuses.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::app;

  const std::string schemes = std::string(PLUMBLINE_SCENES) + "/dynamics/schemes.prm";

  void expect_no_run(const std::string &settings, const std::string &message)
  {
    expect_refused("run " + schemes + " " + settings, message);
  }

  std::string set(const std::string &key, const std::string &value)
  {
    return "--set '" + key + "=" + value + "' ";
  }

  const std::string quick = set("Time/steps", "0.05, 0.025") + set("Expected/orders", "") +
                            set("Time/schemes", "velocity Verlet, implicit Euler");
} // namespace

TEST(DynamicsCommand, writes_a_page_its_numbers_and_frames)
{
  const fs::path folder = temporary("transient");
  const Outcome outcome =
      run("run " + schemes + " " + quick + set("Time/frames", "3") + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "Orders in time");
  const std::string page = read(folder / "dynamics.html");
  for (const std::string part : {"<svg", "toughness of the lattice", "What was left out", "C̄"})
    expect_found(page, part);
  for (const std::string chart : {"orders", "energies", "balance"})
    EXPECT_TRUE(fs::exists(folder / "dynamics" / (chart + ".csv"))) << chart;
  expect_found(read(folder / "dynamics.md"), "velocity Verlet");
  EXPECT_FALSE(fs::exists(folder / "dynamics.jsonl"));

  const auto json = read_json(folder / "dynamics.json");
  ASSERT_EQ(json["records"].size(), 4u);
  const auto &first = json["records"][0], &implicit = json["records"][3];
  EXPECT_EQ(first["key"]["variant"], "velocity Verlet, dt = 0.05");
  const auto scalar = [](const nlohmann::json &record, const std::string &name)
  { return record["scalars"][name]["value"].get<double>(); };
  EXPECT_EQ(scalar(first, "time steps"), 20);
  EXPECT_EQ(scalar(first, "force evaluations"), 21);
  EXPECT_GT(scalar(implicit, "Newton iterations"), 0);
  const double toughness = scalar(first, "toughness of the lattice");
  EXPECT_NEAR(toughness, 4 / M_PI / 3, .1 * 4 / M_PI / 3); // of J = 1 at m = 4: .9375 of it
  // energies: Verlet keeps them but for a swing, implicit Euler loses them
  const auto column = [](const nlohmann::json &record, std::size_t j) -> const nlohmann::json &
  { return record["curves"]["energy"][j]["values"]; }; // time, kinetic, bonds, ...
  const auto stored = [&](const nlohmann::json &record, std::size_t i)
  { return column(record, 1)[i].get<double>() + column(record, 2)[i].get<double>(); };
  const std::size_t last = column(first, 0).size() - 1;
  EXPECT_EQ(column(first, 0)[last], 1);
  const auto &second = json["records"][1];
  const double swing = stored(first, last) - stored(first, 0),
               finer = stored(second, column(second, 0).size() - 1) - stored(second, 0);
  EXPECT_LT(std::abs(swing), 1e-2 * stored(first, 0));
  EXPECT_NEAR(swing / finer, 4, .4); // second order
  EXPECT_LT(stored(implicit, column(implicit, 0).size() - 1), .95 * stored(first, 0));

  const std::string list = read(folder / "frames/pa-ac-u-delta-0.2.pvd");
  expect_found(list, "timestep=\"0.5\"");
  expect_found(list, "_00002.vtu");
  expect_found(read(folder / "frames/pa-ac-u-delta-0.2_00002.vtu"), "NumberOfPoints=\"400\"");
}

TEST(DynamicsCommand, interrupted_keeps_what_is_finished)
{
  // the first level takes a moment, the last one a minute
  const fs::path folder = temporary("transient");
  const std::string settings = set("Time/final time", "4000") + set("Time/steps", "0.02") +
                               set("Expected/orders", "") + set("Time/schemes", "velocity Verlet") +
                               set("Study/h", "0.2, 0.1, 0.05, 0.025");
  const int exit_code =
      interrupt_at("run " + schemes + " " + settings + "--quiet -o " + folder.string(),
                   folder / "dynamics.jsonl");
  EXPECT_EQ(exit_code, 130);
  const auto json = read_json(folder / "dynamics.json");
  EXPECT_FALSE(json["is_complete"]);
  EXPECT_GE(json["records"].size(), 1u);
  EXPECT_LT(json["records"].size(), 4u);
  expect_found(read(folder / "dynamics.html"), "interrupted: what was finished");
}

namespace
{
  /// All numbers of dynamics.json but CPU seconds.
  nlohmann::json untimed(const fs::path &folder)
  {
    auto json = read_json(folder / "dynamics.json");
    json.erase("provenance");
    for (auto &record : json["records"])
    {
      record.erase("cost");
      record["scalars"].erase("reference seconds");
    }
    return json;
  }
} // namespace

TEST(DynamicsCommand, goes_on_after_a_kill_to_the_same_bits)
{
  const fs::path whole = temporary("whole"), killed = temporary("killed");
  const std::string scene = std::string(PLUMBLINE_SCENES) + "/dynamics/double_well.prm";
  const std::string command = "run " + scene + " " + set("Methods/names", "FA, IPA-AC-R2") +
                              set("Study/h", "0.1, 0.05, 0.025") + set("Expected/verdicts", "") +
                              set("Expected/bounds", "") + "-o ";
  ASSERT_EQ(run(command + whole.string()).exit_code, 0);
  const std::string journal = (killed / "dynamics.jsonl").string();
  // as soon as two records are there
  const int status = std::system((std::string(PLUMBLINE_COMMAND) + " " + command + killed.string() +
                                  " >/dev/null 2>&1 & pid=$!; for i in $(seq 3000); do [ $(grep -c "
                                  "'energy imbalance' " +
                                  journal +
                                  " 2>/dev/null || echo 0) -ge 2 ] && break; sleep 0.02; "
                                  "done; kill -9 $pid; wait $pid")
                                     .c_str());
  ASSERT_EQ(WEXITSTATUS(status), 137) << "it had ended";
  std::ofstream(journal, std::ios::app)
      << "{\"key\": {\"method\": \"FA\", \"cut of"; // as a kill may leave it
  ASSERT_FALSE(fs::exists(killed / "dynamics.json"));
  const Outcome resumed = run(command + killed.string());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_found(resumed.err, "continuing: ");
  EXPECT_EQ(untimed(killed), untimed(whole));
  EXPECT_FALSE(fs::exists(journal));

  // what was left by another scene is not taken over
  fs::remove(killed / "dynamics.json");
  std::ofstream(journal) << "{\"version\": 1, \"scene\": \"other\"}\n";
  EXPECT_EQ(run(command + killed.string()).err.find("continuing"), std::string::npos);
  EXPECT_EQ(untimed(killed), untimed(whole));
}

TEST(DynamicsCommand, refuses_what_cannot_be_solved)
{
  expect_no_run(set("Time/steps", "0"), "Time/steps = 0 must be positive");
  expect_no_run(set("Time/density", "-1"), "Time/density = -1 must be positive");
  expect_no_run(set("Material/beta", "0"), "Material/beta = 0 must be positive");
  expect_no_run(set("Time/initial displacement", "log(x-2), 0"), "must be a finite number");
  expect_no_run(set("Time/show blow-up", "false"), "the scheme is unstable at any step");
  expect_no_run(set("Time/frames", "100000") + set("Study/h", "0.001"), "GB are free");
  expect_no_run("--methods DGQ1", "no fixed quadrature resolves");
  expect_no_run("--methods LOCAL", "Domain/mesh = lattice");
  expect_no_run(set("Time/schemes", "leapfrog"), "choose one of: explicit Euler");
  expect_no_run(set("Time/final time", "0"), "needs Problem/solution");
}

TEST(DynamicsCommand, warns_of_critical_steps_of_operators_that_are_not_symmetric)
{
  const fs::path folder = temporary("transient");
  const Outcome outcome = run(
      "run " + std::string(PLUMBLINE_SCENES) + "/dynamics/scattered_wells.prm --levels 1 " +
      "--quiet --methods IPA-AC-R2 " + set("Time/final time", "0.05") + "-o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.err, "warning: IPA-AC-R2: the operator is not symmetric");
  expect_found(read(folder / "dynamics.html"), "that of the symmetric part");
  const auto json = read_json(folder / "dynamics.json");
  EXPECT_EQ(json["warnings"].size(), 1u);
  EXPECT_EQ(json["records"][0]["scalars"]["symmetric"]["value"], 0);
}

// Of 17 Chebyshev points in time none lies in the first pulse, nor of 33 in the second.
TEST(DynamicsCommand, refuses_a_pulse_of_load_wherever_it_lies_in_time)
{
  for (const std::string pulse :
       {"(t > 0.1 ? (t < 0.145 ? 100 : 0) : 0)", "(t > 0.81 ? (t < 0.83 ? 100 : 0) : 0)",
        "100*exp(-((t-0.25)/0.005)^2)"})
    expect_no_run(set("Problem/load", pulse + "*sin(2*pi*x), 0") + set("Problem/solution", "") +
                      set("Study/decisive error", "nodal L2 | reference") +
                      set("Reference/method", "torus") + set("Expected/orders", ""),
                  "65 Chebyshev points up to Time/final time do not resolve it");
}
