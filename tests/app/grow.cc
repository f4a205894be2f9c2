// `plumbline grow`: what it says of cracks that grow in equilibrium, that it goes on after a kill,
// and what it refuses.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::app;

  std::string plate()
  {
    return std::string(PLUMBLINE_SCENES) + "/fracture/plate.prm";
  }

  nlohmann::json results(const fs::path &folder)
  {
    return nlohmann::json::parse(read(folder / "grow.json"));
  }
} // namespace

TEST(GrowCommand, tells_what_breaks_and_draws_it)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome = run("grow " + plate() + " --check -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "bonds break at");
  const auto json = results(folder);
  EXPECT_LT(json["energy_imbalance"], 1e-10);
  EXPECT_EQ(json["n_unpaired"], 0);
  EXPECT_NEAR(json["lattice_toughness"], .9158, 5e-5);
  EXPECT_TRUE(json["is_connected"]); // the reaction ended it
  EXPECT_LE(json["reaction_left"], .05);
  EXPECT_GT(json["reaction_left"], 0);
  expect_found(json["scene_text"], "set toughness");
  EXPECT_TRUE(json["field_seed"].is_null()); // nothing is random
  EXPECT_LT(json["n_factorisations"].get<double>(), .2 * json["events"].size());
  const std::string page = read(folder / "grow.html");
  expect_found(page, "<svg");
  expect_found(page, "what was left out");
  for (const char *const name : {"moments.svg", "load.svg", "energies.svg", "tip.svg", "events.csv",
                                 "sides.csv", "load.csv"})
    EXPECT_TRUE(fs::exists(folder / "grow" / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "grow/microstructure.svg")); // there is none
  EXPECT_FALSE(fs::exists(folder / "checkpoint.h5"));
  fs::remove_all(folder);
}

// Its peak load is 6 % higher where a notch that is longer by a fiftieth of h cuts these bonds.
TEST(GrowCommand, warns_of_bonds_through_the_notch_s_tip)
{
  const std::string coarse = "grow " + plate() +
                             " --set Study/h=0.05 --set 'Fracture/least reaction=0.9' --set "
                             "'Domain/fixed=0, 0.35 : 2, 0.5; 0, -0.5 : 2, -0.35' --set "
                             "Expected/growth= ";
  for (const bool is_on_bonds : {true, false})
  {
    const fs::path folder = temporary("grow");
    const Outcome outcome =
        run(coarse + "--set 'Domain/cracks=-0.1, 0 : " + (is_on_bonds ? "0.5" : "0.501") +
            ", 0' -o " + folder.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string words = "6 bonds pass through the end (0.5, 0) of crack 0";
    EXPECT_EQ(outcome.err.find(words) != std::string::npos, is_on_bonds) << outcome.err;
    EXPECT_EQ(read(folder / "grow.html").find(words) != std::string::npos, is_on_bonds);
    EXPECT_EQ(results(folder)["warnings"].size(), is_on_bonds ? 1u : 0u);
    fs::remove_all(folder);
  }
}

TEST(GrowCommand, measures_the_crack_in_each_phase)
{
  const fs::path folder = temporary("grow");
  ASSERT_EQ(run("grow " + plate() +
                " --quiet --set 'Fracture/toughness=x < 0.6 ? 1 : 2' --set "
                "'Fracture/least reaction=0.8' --set Expected/growth= -o " +
                folder.string())
                .exit_code,
            0);
  const auto json = results(folder);
  EXPECT_EQ(json["phases"], nlohmann::json({1, 2}));
  EXPECT_GT(json["L1"], 0);
  const double sum = json["L1"].get<double>() + json["L2"].get<double>() + json["Li"].get<double>();
  // a straight crack breaks 18 bonds a column at m = 3
  EXPECT_NEAR(sum, json["n_broken"].get<double>() * json["h"].get<double>() / 18, 1e-12);
  const std::string page = read(folder / "grow.html");
  expect_found(page, "Phase 1 has G = 1 and phase 2 has G = 2");
  expect_found(page, "The crack in its microstructure");
  expect_found(read(folder / "grow/microstructure.gp"), "$notch with lines");
  expect_found(read(folder / "grow/microstructure.gp"), "$crack with lines");
  fs::remove_all(folder);
}

TEST(GrowCommand, tells_what_surface_terms_do)
{
  const fs::path folder = temporary("grow");
  const std::string begins = " --quiet --set 'Fracture/least reaction=0.8' --set Expected/growth= "
                             "-o " +
                             folder.string();
  ASSERT_EQ(run("grow " + plate() + begins).exit_code, 0);
  const auto without = results(folder);
  ASSERT_EQ(run("grow " + std::string(PLUMBLINE_SCENES) + "/fracture/surface_terms.prm" + begins)
                .exit_code,
            0);
  const auto with = results(folder);
  const double ratio =
      with["events"][0]["load"].get<double>() / without["events"][0]["load"].get<double>();
  EXPECT_GT(ratio, .9); // in a strip the energy that a crack needs is .87 of that without
  EXPECT_LT(ratio, .97);
  EXPECT_EQ(without["n_iterations"], 0);
  EXPECT_GE(with["n_iterations"].get<double>(), with["events"].size());
  EXPECT_GT(with["energy_imbalance"], 1e-3);
  EXPECT_EQ(with["n_unpaired"], 0); // mirror images break together
  const std::string page = read(folder / "grow.html");
  expect_found(page, "with surface terms");
  expect_found(page, "no energy has the forces of surface terms");
  // the words are aliases, and Material's key is taken where Fracture's says nothing
  const std::string scene = "grow " + plate() +
                            " --quiet --set 'Fracture/least reaction=0.999' --set Expected/growth= "
                            "-o " +
                            folder.string();
  std::vector<nlohmann::json> all;
  for (const char *const keys :
       {" --set 'Fracture/surface terms=yes'", " --set 'Fracture/surface terms=published'",
        " --set 'Material/surface terms=published'", " --set 'Fracture/surface terms=consistent'",
        " --set 'Fracture/surface terms=none'", " --set 'Fracture/surface terms=no'"})
  {
    ASSERT_EQ(run(scene + keys).exit_code, 0) << keys;
    all.push_back(results(folder));
  }
  for (const std::size_t i : {0, 1, 2})
  {
    EXPECT_EQ(all[i]["surface_terms"], "published");
    EXPECT_EQ(all[i]["events"][0]["load"], with["events"][0]["load"]);
  }
  EXPECT_EQ(all[3]["surface_terms"], "consistent");
  EXPECT_EQ(all[4]["surface_terms"], "none");
  EXPECT_EQ(all[5]["surface_terms"], "uncorrected");
  EXPECT_EQ(all[5]["events"][0]["load"], without["events"][0]["load"]);
  // bonds alone, lambda = mu, have no dilatation to correct
  EXPECT_NEAR(all[4]["events"][0]["load"].get<double>() /
                  without["events"][0]["load"].get<double>(),
              1, 1e-9);
  fs::remove_all(folder);
  expect_refused(
      "grow " + plate() +
          " --set 'Fracture/surface terms=consistent' --set 'Material/surface terms=none'",
      "Fracture/surface terms = consistent contradicts Material/surface terms = none");
  expect_refused("grow " + plate() + " --set 'Fracture/surface terms=perhaps'", "consistent");
}

TEST(GrowCommand, does_without_a_factor)
{
  const fs::path folder = temporary("grow");
  const std::string command = "grow " + plate() +
                              " --quiet --set 'Fracture/least reaction=0.97' --set "
                              "Expected/growth= -o " +
                              folder.string();
  ASSERT_EQ(run(command).exit_code, 0);
  const auto factored = results(folder);
  EXPECT_EQ(factored["solver"], "factor"); // it fits
  ASSERT_EQ(run(command + " --set Fracture/solver=multigrid").exit_code, 0);
  const auto iterated = results(folder);
  EXPECT_EQ(iterated["solver"], "multigrid");
  EXPECT_GT(factored["events"].size(), 5);
  ASSERT_EQ(iterated["events"].size(), factored["events"].size());
  for (std::size_t i = 0; i < factored["events"].size(); ++i)
    EXPECT_NEAR(iterated["events"][i]["load"].get<double>() /
                    factored["events"][i]["load"].get<double>(),
                1, 1e-9);
  expect_found(read(folder / "grow.html"), "of conjugate gradients, at most");
  fs::remove_all(folder);
  for (const char *const other : {"Fracture/stretch=finite", "\"Fracture/surface terms=yes\""})
    expect_refused("grow " + plate() + " --set Fracture/solver=multigrid " + other,
                   "write Fracture/solver = factor");
}

TEST(GrowCommand, lets_a_crack_grow_in_its_own_field)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome = run("grow " + std::string(PLUMBLINE_SCENES) +
                              "/fracture/k_field.prm --check -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = results(folder);
  const double griffith = std::sqrt(json["plane_modulus"].get<double>()), // K where G = 1
      first = json["events"][0]["load"].get<double>() / griffith;
  EXPECT_GT(first, 1); // a lattice traps the crack
  EXPECT_LT(first, 1.1);
  EXPECT_NEAR(json["K_by_bonds"].get<double>() / griffith, 1, 1e-12);
  EXPECT_EQ(json["n_unpaired"], 0);
  fs::remove_all(folder);
}

TEST(GrowCommand, calibrates_the_critical_stretch)
{
  const fs::path folder = temporary("grow");
  const std::string command = "grow " + plate() + " --quiet -o " + folder.string();
  ASSERT_EQ(run(command).exit_code, 0);
  const double load = results(folder)["events"][0]["load"];
  ASSERT_EQ(run(command + " --set Fracture/criterion=calibrated").exit_code, 0);
  const auto json = results(folder);
  const double trapping = json["trapping"];
  EXPECT_NEAR(trapping, 1.3165, 5e-4);
  EXPECT_NEAR(json["events"][0]["load"].get<double>() / load, 1 / std::sqrt(trapping), 1e-9);
  expect_found(read(folder / "grow.html"), "criterion = calibrated");
  fs::remove_all(folder);
}

TEST(GrowCommand, warns_of_what_nodes_do_not_see_and_takes_weak_lines)
{
  const std::string body =
      "grow " + plate() +
      " --quiet --set Study/h=0.05 --set 'Domain/fixed=0, 0.35 : 2, 0.5; 0, -0.5 : 2, -0.35' ";
  const auto grown = [&](const std::string &settings)
  {
    const fs::path folder = temporary("weak");
    const Outcome outcome = run(body + settings + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = results(folder);
    EXPECT_EQ(outcome.err.empty(), json["warnings"].empty()) << outcome.err;
    fs::remove_all(folder);
    return json;
  };
  const std::string weak = "--set 'Fracture/toughness=abs(y) < 0.02 ? 0.05 : 1' ";
  const auto uniform = grown("--set Fracture/toughness=1"), unseen = grown(weak),
             least = grown(weak + "--set 'Fracture/toughness of bonds=minimum'"),
             line = grown("--set Fracture/toughness=1 --set 'Fracture/interfaces=-1, 0 : 3, 0' "
                          "--set 'Fracture/interface toughness=0.05'");
  const double peak = uniform["peak_load"];
  // the notch ends on bonds; that is said of each body
  ASSERT_EQ(uniform["warnings"].size(), 1u);
  ASSERT_EQ(unseen["warnings"].size(), 2u);
  expect_found(unseen["warnings"][0], "Fracture/toughness has features between nodes that no node "
                                      "resolves: at h = 0.05 it is 0.05 in ");
  EXPECT_EQ(unseen["peak_load"], peak);
  // the first bonds that break lie across the line, at √.05 of their stretch
  const auto first = [](const nlohmann::json &json)
  { return json["events"][0]["load"].get<double>(); };
  for (const auto &one : {least, line})
  {
    EXPECT_EQ(one["warnings"].size(), 1u);
    EXPECT_NEAR(first(one), std::sqrt(.05) * first(uniform), 1e-9);
    EXPECT_LT(one["peak_load"].get<double>(), .3 * peak);
    EXPECT_NEAR(one["G_by_bonds"].get<double>(), .05, .02);
  }
  EXPECT_EQ(least["events"], line["events"]);
}

TEST(GrowCommand, says_what_is_not_as_expected)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome =
      run("grow " + plate() +
          " --check --quiet --set Study/h=0.05 --set 'Domain/fixed=0, 0.35 : 2, 0.5; 0, -0.5 : 2, "
          "-0.35' --set 'Expected/growth=broken bonds: 1' -o " +
          folder.string());
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.err, "Expected/growth = 'broken bonds: 1', but it is");
  expect_found(read(folder / "grow.html"), "EXPECTED");
  fs::remove_all(folder);
}

TEST(GrowCommand, goes_on_after_it_was_killed_to_the_same_bits)
{
  const fs::path whole = temporary("whole"), killed = temporary("killed");
  const std::string command =
      "grow " + plate() + " --quiet --set 'Fracture/checkpoint interval=7' -o ";
  const pid_t first = start(command + whole.string());
  ASSERT_TRUE(kill_at(command + killed.string(), killed / "checkpoint.h5"))
      << "the run had ended before it was killed";
  EXPECT_FALSE(fs::exists(killed / "grow.json"));
  const Outcome resumed = run(command + killed.string());
  waitpid(first, nullptr, 0);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_GT(results(killed)["n_resumed"], 0);
  EXPECT_EQ(results(whole)["n_resumed"], 0);
  EXPECT_TRUE(results(killed)["events"] == results(whole)["events"]);
  for (const char *const name : {"grow/events.csv", "grow/sides.csv", "grow/moments.gp"})
    EXPECT_TRUE(read(killed / name) == read(whole / name)) << name;
  fs::remove_all(whole);
  fs::remove_all(killed);
}

TEST(GrowCommand, begins_anew_when_a_picture_has_changed)
{
  const fs::path killed = temporary("killed");
  const std::string picture = write("picture.csv", "1,0\n0,1\n");
  const std::string command = "grow " + plate() +
                              " --quiet --set 'Fracture/checkpoint interval=7' --set "
                              "Random/field=files --set Random/files=" +
                              picture + " -o " + killed.string();
  ASSERT_TRUE(kill_at(command, killed / "checkpoint.h5"))
      << "the run had ended before it was killed";
  std::ofstream(picture) << "0,1\n1,0\n";
  const Outcome again = run(command);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(results(killed)["n_resumed"], 0);
  fs::remove_all(killed);
  fs::remove(picture);
}

TEST(GrowCommand, refuses_what_cannot_grow)
{
  const std::string body = "grow " + plate() + " --quiet ";
  const auto set = [&](const std::string &setting) { return body + "--set '" + setting + "'"; };
  expect_refused("grow " + std::string(PLUMBLINE_SCENES) + "/griffith/run.prm",
                 "Fracture/toughness is empty, so that nothing breaks");
  expect_refused("run " + plate(), "Fracture/toughness is for 'plumbline grow'");
  expect_refused("crack " + plate(), "Crack/notch = 0");
  expect_refused(set("Fracture/toughness=-1"), "Fracture/toughness = -1 must be positive");
  expect_refused(set("Fracture/toughness=x - 1"), "Fracture/toughness = -0.9875 at (0.0125");
  expect_refused(set("Fracture/toughness=x < 0.6 ? 1 : 0"), "give a positive value for each phase");
  expect_refused(set("Material/E=x < 0.6 ? 1 : 0"), "Young's modulus E = 0");
  expect_refused(set("Fracture/toughness=x, y"), "one component");
  expect_refused(set("Domain/cracks="), "needs an initial notch in Domain/cracks");
  expect_refused(set("Domain/cracks=-1, 0 : -0.5, 0"), "the notch lies outside of the body");
  expect_refused(set("Domain/cracks=-0.1, 0.0125 : 0.5, 0.0125"), "goes through node");
  expect_refused(set("Domain/cracks=-0.1, 0 : 3, 0"), "no path of bonds joins the grips");
  expect_refused(set("Domain/fixed="), "Domain/fixed, the grips");
  expect_refused(set("Domain/fixed=0, 5 : 1, 6"), "grip 0 holds no node");
  expect_refused(set("Domain/fixed=0, -0.5 : 2, 0.5"), "holds all nodes");
  expect_refused(set("Domain/boundary=constrained"), "Domain/boundary = free");
  expect_refused(set("Problem/constraint=solution"), "the displacement of the grips at load 1");
  expect_refused(set("Problem/load=1, 0"), "neither solution nor load");
  expect_refused(set("Material/nu=0.6"), "nu");
  expect_refused(set("Material/model=variational"), "take LPS");
  expect_refused(set("Kernel/type=constant"), "Kernel/type = 1/r");
  expect_refused(set("Study/h=0.05, 0.025"), "one Study/h");
  expect_refused(set("Study/h=0.03"), "mesh size h = 0.03 does not divide");
  expect_refused(set("Study/h=0.0005"), "Study/h = 0.0005 gives a body of 8e+06 nodes");
  expect_refused(set("Fracture/breaking=steps"), "Fracture/load step = 0 must be positive");
  expect_refused(set("Fracture/breaking=often"), "Fracture/breaking");
  expect_refused(set("Fracture/largest load=0"), "Fracture/max load = 0 must be positive");
  expect_refused(set("Fracture/ties=-1"), "Fracture/ties");
  expect_refused(set("Expected/growth=holes: 3"), "the quantity one of broken bonds");
  expect_refused(body + "--methods Q1", "'Q1' is no meshfree rule");
}
