// `plumbline grow`: what it says of cracks that grow in equilibrium, that it goes on after a kill,
// and what it refuses.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::app;
  using namespace std::chrono_literals;

  std::string plate()
  {
    return std::string(PLUMBLINE_SCENES) + "/fracture/plate.prm";
  }

  using Json = nlohmann::json;

  Json results(const fs::path &folder)
  {
    return Json::parse(read(folder / "grow.json"));
  }

  /// Of the one growth.
  Json record(const fs::path &folder)
  {
    return results(folder)["records"][0];
  }

  double scalar(const Json &record, const std::string &name)
  {
    EXPECT_TRUE(record["scalars"].contains(name)) << name;
    return record["scalars"][name]["value"];
  }

  std::vector<double> events(const Json &record, const std::string &name)
  {
    for (const Json &column : record["curves"]["events"])
      if (column["name"] == name)
        return column["values"];
    ADD_FAILURE() << name;
    return {};
  }
} // namespace

TEST(GrowCommand, tells_what_breaks_and_draws_it)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome = run("grow " + plate() + " --check -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "bonds break at");
  const auto json = record(folder);
  EXPECT_LT(scalar(json, "imbalance"), 1e-10);
  EXPECT_EQ(scalar(json, "unpaired"), 0);
  EXPECT_NEAR(scalar(json, "G_h / G"), .9158, 5e-5);
  EXPECT_EQ(json["texts"]["connected"], "yes"); // the reaction ended it
  EXPECT_LE(scalar(json, "reaction left"), .05);
  EXPECT_GT(scalar(json, "reaction left"), 0);
  // E = 1, nu = 1/4: lambda + mu = .8
  EXPECT_NEAR(scalar(json, "s0"), std::sqrt(M_PI / (3 * json["key"]["horizon"].get<double>() * .8)),
              1e-12);
  expect_found(results(folder)["scene_text"], "set toughness");
  EXPECT_FALSE(json["scalars"].contains("field seed")); // nothing is random
  EXPECT_LT(scalar(json, "factorisations"), .2 * events(json, "load").size());
  const std::string page = read(folder / "grow.html");
  expect_found(page, "<svg");
  expect_found(page, "What was left out of the model");
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
  const auto json = record(folder);
  EXPECT_EQ(json["curves"]["phases"][0]["values"], Json({1, 2}));
  EXPECT_GT(scalar(json, "L1"), 0);
  const double sum = scalar(json, "L1") + scalar(json, "L2") + scalar(json, "Li");
  // a straight crack breaks 18 bonds a column at m = 3
  EXPECT_NEAR(sum, scalar(json, "broken bonds") * json["key"]["h"].get<double>() / 18, 1e-12);
  const std::string page = read(folder / "grow.html");
  expect_found(page, "Phase 1 has G = 1 and phase 2 has G = 2");
  expect_found(page, "The crack in its microstructure");
  expect_found(read(folder / "grow/pictures.gp"), "$notch with lines");
  expect_found(read(folder / "grow/pictures.gp"), "$crack with lines");
  fs::remove_all(folder);
}

TEST(GrowCommand, tells_what_surface_terms_do)
{
  const fs::path folder = temporary("grow");
  const std::string begins = " --quiet --set 'Fracture/least reaction=0.8' --set Expected/growth= "
                             "-o " +
                             folder.string();
  ASSERT_EQ(run("grow " + plate() + begins).exit_code, 0);
  const auto without = record(folder);
  ASSERT_EQ(run("grow " + std::string(PLUMBLINE_SCENES) + "/fracture/surface_terms.prm" + begins)
                .exit_code,
            0);
  const auto with = record(folder);
  const double ratio = events(with, "load")[0] / events(without, "load")[0];
  EXPECT_GT(ratio, .9); // in a strip the energy that a crack needs is .87 of that without
  EXPECT_LT(ratio, .97);
  EXPECT_FALSE(without["scalars"].contains("iterations"));
  EXPECT_GE(scalar(with, "iterations"), events(with, "load").size());
  EXPECT_GT(scalar(with, "imbalance"), 1e-3);
  EXPECT_EQ(scalar(with, "unpaired"), 0); // mirror images break together
  const std::string page = read(folder / "grow.html");
  expect_found(page, "with surface terms");
  expect_found(page, "the surface terms do not derive from an energy");
  // the words are aliases, and Material's key is taken where Fracture's says nothing
  const std::string scene = "grow " + plate() +
                            " --quiet --set 'Fracture/least reaction=0.999' --set Expected/growth= "
                            "-o " +
                            folder.string();
  std::vector<Json> all;
  for (const char *const keys :
       {" --set 'Fracture/surface terms=yes'", " --set 'Fracture/surface terms=published'",
        " --set 'Material/surface terms=published'", " --set 'Fracture/surface terms=consistent'",
        " --set 'Fracture/surface terms=none'", " --set 'Fracture/surface terms=no'"})
  {
    ASSERT_EQ(run(scene + keys).exit_code, 0) << keys;
    all.push_back(record(folder));
  }
  for (const std::size_t i : {0, 1, 2})
  {
    EXPECT_EQ(all[i]["texts"]["surface terms"], "published");
    EXPECT_EQ(events(all[i], "load")[0], events(with, "load")[0]);
  }
  EXPECT_EQ(all[3]["texts"]["surface terms"], "consistent");
  EXPECT_EQ(all[4]["texts"]["surface terms"], "none");
  EXPECT_EQ(all[5]["texts"]["surface terms"], "uncorrected");
  EXPECT_EQ(events(all[5], "load")[0], events(without, "load")[0]);
  // bonds alone, lambda = mu, have no dilatation to correct
  EXPECT_NEAR(events(all[4], "load")[0] / events(without, "load")[0], 1, 1e-9);
  fs::remove_all(folder);
  expect_refused(
      "grow " + plate() +
          " --set 'Fracture/surface terms=consistent' --set 'Material/surface terms=none'",
      "Fracture/surface terms = consistent contradicts Material/surface terms = none");
  expect_refused("grow " + plate() + " --set 'Fracture/surface terms=perhaps'", "consistent");
  expect_refused("grow " + plate() + " --set 'Material/surface terms=energy'",
                 "Material/surface terms = energy is not implemented for fracture");
}

TEST(GrowCommand, does_without_a_factor)
{
  const fs::path folder = temporary("grow");
  const std::string command = "grow " + plate() +
                              " --quiet --set 'Fracture/least reaction=0.97' --set "
                              "Expected/growth= -o " +
                              folder.string();
  ASSERT_EQ(run(command).exit_code, 0);
  const auto factored = record(folder);
  EXPECT_EQ(factored["texts"]["solver"], "factor"); // it fits
  ASSERT_EQ(run(command + " --set Fracture/solver=multigrid").exit_code, 0);
  const auto iterated = record(folder);
  EXPECT_EQ(iterated["texts"]["solver"], "multigrid");
  EXPECT_GT(events(factored, "load").size(), 5);
  ASSERT_EQ(events(iterated, "load").size(), events(factored, "load").size());
  for (std::size_t i = 0; i < events(factored, "load").size(); ++i)
    EXPECT_NEAR(events(iterated, "load")[i] / events(factored, "load")[i], 1, 1e-9);
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
  const auto json = record(folder);
  const double griffith = std::sqrt(scalar(json, "plane modulus")), // K where G = 1
      first = events(json, "load")[0] / griffith;
  EXPECT_GT(first, 1); // a lattice traps the crack
  EXPECT_LT(first, 1.1);
  EXPECT_NEAR(scalar(json, "K by bonds") / griffith, 1, 1e-12);
  EXPECT_EQ(scalar(json, "unpaired"), 0);
  fs::remove_all(folder);
}

TEST(GrowCommand, calibrates_the_critical_stretch)
{
  const fs::path folder = temporary("grow");
  const std::string command = "grow " + plate() + " --quiet -o " + folder.string();
  ASSERT_EQ(run(command).exit_code, 0);
  const double load = events(record(folder), "load")[0];
  ASSERT_EQ(run(command + " --set Fracture/criterion=calibrated").exit_code, 0);
  const auto json = record(folder);
  const double trapping = scalar(json, "G_peak / G");
  EXPECT_NEAR(trapping, 1.3165, 5e-4);
  EXPECT_NEAR(events(json, "load")[0] / load, 1 / std::sqrt(trapping), 1e-9);
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
    const auto json = record(folder);
    EXPECT_EQ(outcome.err.empty(), json["notes"].empty()) << outcome.err;
    fs::remove_all(folder);
    return json;
  };
  const std::string weak = "--set 'Fracture/toughness=abs(y) < 0.02 ? 0.05 : 1' ";
  const auto uniform = grown("--set Fracture/toughness=1"), unseen = grown(weak),
             least = grown(weak + "--set 'Fracture/toughness of bonds=minimum'"),
             line = grown("--set Fracture/toughness=1 --set 'Fracture/interfaces=-1, 0 : 3, 0' "
                          "--set 'Fracture/interface toughness=0.05'");
  const double peak = scalar(uniform, "peak load");
  // the notch ends on bonds; that is said of each body
  ASSERT_EQ(uniform["notes"].size(), 1u);
  ASSERT_EQ(unseen["notes"].size(), 2u);
  expect_found(unseen["notes"][0], "Fracture/toughness has features between nodes that no node "
                                   "resolves: at h = 0.05 it is 0.05 in ");
  EXPECT_EQ(scalar(unseen, "peak load"), peak);
  // the first bonds that break lie across the line, at √.05 of their stretch
  const auto first = [](const Json &json) { return events(json, "load")[0]; };
  for (const auto &one : {least, line})
  {
    EXPECT_EQ(one["notes"].size(), 1u);
    EXPECT_NEAR(first(one), std::sqrt(.05) * first(uniform), 1e-9);
    EXPECT_LT(scalar(one, "peak load"), .3 * peak);
    EXPECT_NEAR(scalar(one, "G by bonds"), .05, .02);
  }
  EXPECT_EQ(least["curves"], line["curves"]);
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
  expect_found(outcome.err, "broken bonds: found ");
  expect_found(read(folder / "grow.html"), "these do not:");
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
  EXPECT_GT(scalar(record(killed), "resumed"), 0);
  EXPECT_EQ(scalar(record(whole), "resumed"), 0);
  for (const char *const part : {"curves", "fields"})
    EXPECT_TRUE(record(killed)[part] == record(whole)[part]) << part;
  for (const char *const name : {"grow/events.csv", "grow/sides.csv", "grow/pictures.gp"})
    EXPECT_TRUE(read(killed / name) == read(whole / name)) << name;
  fs::remove_all(whole);
  fs::remove_all(killed);
}

TEST(GrowCommand, goes_on_after_it_was_interrupted_between_checkpoints)
{
  const fs::path whole = temporary("whole"), stopped = temporary("stopped");
  const std::string command =
      "grow " + plate() + " --quiet --set 'Fracture/checkpoint interval=200' -o ";
  ASSERT_EQ(run(command + whole.string()).exit_code, 0);
  // some events after the first checkpoint and, of some 600, long before the second
  ASSERT_EQ(interrupt_at(command + stopped.string(), stopped / "checkpoint.h5", 200ms), 130);
  EXPECT_FALSE(results(stopped)["is_complete"]);
  ASSERT_EQ(run(command + stopped.string()).exit_code, 0);
  EXPECT_GT(scalar(record(stopped), "resumed"), 200);
  EXPECT_LT(scalar(record(stopped), "resumed"), 400);
  EXPECT_TRUE(record(stopped)["curves"] == record(whole)["curves"]);
  fs::remove_all(whole);
  fs::remove_all(stopped);
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
  EXPECT_EQ(scalar(record(killed), "resumed"), 0);
  fs::remove_all(killed);
  fs::remove(picture);
}

namespace
{
  /// A plate of 10 x 10 x 3 nodes, m = 2.
  std::string plate_in_space()
  {
    return std::string(PLUMBLINE_SCENES) + "/three_d/notched_plate.prm --set Study/h=0.1 "
                                           "--set 'Domain/boxes=0, 0, 0 : 1, 1, 0.3' "
                                           "--set 'Domain/fixed=0, 0.8 : 1, 1; 0, 0 : 1, 0.2' "
                                           "--set 'Domain/cracks=-0.1, 0.5 : 0.4, 0.5'";
  }
} // namespace

TEST(GrowCommand, follows_a_crack_front_in_space)
{
  const fs::path folder = temporary("grow_in_space");
  const Outcome outcome = run("grow " + plate_in_space() + " --check -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "bonds break at");
  const auto json = record(folder);
  EXPECT_LT(scalar(json, "imbalance"), 1e-10);
  EXPECT_EQ(scalar(json, "unpaired"), 0);
  EXPECT_EQ(scalar(json, "unpaired in z"), 0);
  // E = 1, nu = 1/4: k = 2/3; 5G/(9 k delta)
  EXPECT_NEAR(scalar(json, "s0"), std::sqrt(5 / (9 * 2. / 3 * .2)), 1e-12);
  // the ligament of 6 columns in 3 layers, at whose end the crack may leave the plane of the notch
  EXPECT_GE(scalar(json, "advance min"), .6 - 1e-12);
  EXPECT_NEAR(scalar(json, "area"), .6 * .3, 1e-12);
  const auto way = events(json, "way"), least = events(json, "way min"),
             most = events(json, "way max");
  const auto first = static_cast<std::size_t>(scalar(json, "first advance event"));
  for (std::size_t i = 0; i < way.size(); ++i)
  {
    EXPECT_EQ(most[i] > 0, i >= first) << i;
    EXPECT_GE(least[i], i == 0 ? 0 : least[i - 1]); // a front does not go back
    EXPECT_GE(most[i], i == 0 ? 0 : most[i - 1]);
  }
  EXPECT_EQ(way.back(), scalar(json, "advance"));
  EXPECT_EQ(least.back(), scalar(json, "advance min"));
  EXPECT_EQ(most.back(), scalar(json, "advance max"));
  EXPECT_EQ(json["fields"]["damage"]["points"].size(), 200u); // the layer in the middle
  for (const char *const name : {"grow/front.svg", "grow/front.csv", "grow/moments.svg",
                                 "frames/damage.pvd", "frames/damage_00005.vtu"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  fs::remove_all(folder);
}

TEST(GrowCommand, refuses_in_space_what_is_of_the_plane)
{
  const std::string body = "grow " + plate_in_space() + " --quiet ";
  const auto set = [&](const std::string &setting) { return body + "--set '" + setting + "'"; };
  expect_refused(set("Fracture/surface terms=published"),
                 "Domain/dimension = 3 does not support Fracture/surface terms = published yet; "
                 "write uncorrected");
  expect_refused(set("Fracture/criterion=calibrated"), "write toughness");
  expect_refused(set("Domain/cracks=-0.1, 0.55 : 0.4, 0.55"), "goes through node");
  expect_refused(set("Domain/cracks=-0.1, 0.5 : 3, 0.5"), "no path of bonds joins the grips");
  expect_refused(set("Domain/fixed=0, 5 : 1, 6"), "grip 0 holds no node");
  expect_refused(set("Domain/fixed=0, 0, 0 : 1, 1, 1"), "is not allowed");
  expect_refused(set("Domain/outside=x - 2"), "clear both");
  expect_refused(set("Problem/constraint=0, 1"), "component");
  expect_refused(set("Fracture/toughness=z - 0.1"), "must be positive");
  expect_refused(set("Material/E=1 + x"), "constants that vary in space");
  expect_refused("run " + plate_in_space(), "only 'plumbline grow' uses Fracture/toughness");
}

namespace
{
  /// The plate on a coarse lattice, until its crack has begun.
  std::string coarse_plate()
  {
    return "grow " + plate() +
           " --quiet --set Study/h=0.05 --set 'Fracture/min reaction=0.8' --set "
           "'Domain/fixed=0, 0.35 : 2, 0.5; 0, -0.5 : 2, -0.35' --set Expected/growth= ";
  }

  Json record_of(const std::string &command)
  {
    const fs::path folder = temporary("grow");
    const Outcome outcome = run(command + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json result = record(folder);
    fs::remove_all(folder);
    return result;
  }
} // namespace

TEST(GrowCommand, takes_bond_tensors_as_solids_whose_constants_are_alike)
{
  const Json lps = record_of(coarse_plate() + "--set Kernel/type=conical"),
             tensors = record_of(coarse_plate() +
                                 "--set Material/model=bond-based --set Material/nu= --set "
                                 "'Kernel/type=bond-tensor conical'");
  for (const char *const name : {"s0", "G_h / G", "first break", "first advance", "peak load",
                                 "peak reaction", "K by energy"})
    EXPECT_NEAR(scalar(tensors, name), scalar(lps, name), 1e-9 * scalar(lps, name)) << name;
  // E = 1, nu = 1/4: lambda + mu = .8; β = 2δ/(3π)
  const double delta = lps["key"]["horizon"];
  EXPECT_NEAR(scalar(lps, "s0"), std::sqrt(3 * M_PI / (8 * delta * .8)), 1e-12);
}

TEST(GrowCommand, lets_cracks_grow_on_meshes)
{
  const std::string with_FA = coarse_plate() + "--methods FA ";
  const Json lattice = record_of(with_FA),
             squares = record_of(with_FA + "--set Domain/mesh=squares --set Methods/nodes=mesh"),
             moved = record_of(with_FA + "--set Domain/mesh=squares --set "
                                         "Methods/perturbation=0.2");
  for (const char *const name :
       {"s0", "first advance", "peak load", "peak reaction", "advance", "broken bonds", "width"})
    EXPECT_NEAR(scalar(squares, name), scalar(lattice, name), 1e-6 * scalar(lattice, name)) << name;
  EXPECT_LT(scalar(moved, "imbalance"), 1e-10);
  EXPECT_EQ(scalar(moved, "s0"), scalar(lattice, "s0"));
  EXPECT_NEAR(scalar(moved, "peak load") / scalar(lattice, "peak load"), 1, .15);
  EXPECT_FALSE(moved["scalars"].contains("unpaired")); // no node has a mirror image
  const auto refused = [&](const std::string &settings, const std::string &words)
  { expect_refused(coarse_plate() + "--set Domain/mesh=squares " + settings, words); };
  refused("", "adjusts the weights of whole balls");
  refused("--methods FA --set Methods/nodes=vertices", "Methods/nodes = mesh");
  refused("--methods FA --set Fracture/criterion=calibrated", "Fracture/criterion = toughness");
  refused("--methods FA --set 'Fracture/surface terms=none'",
          "Fracture/surface terms = uncorrected");
  refused("--methods FA --set 'Domain/fixed=0, 5 : 1, 6'", "none lies in its box");
}

TEST(GrowCommand, refuses_what_cannot_grow)
{
  const std::string body = "grow " + plate() + " --quiet ";
  const auto set = [&](const std::string &setting) { return body + "--set '" + setting + "'"; };
  expect_refused("grow " + std::string(PLUMBLINE_SCENES) + "/griffith/run.prm",
                 "these are missing: Fracture/toughness (G_c), Domain/cracks (the notch)");
  expect_refused("run " + plate(), "only 'plumbline grow' uses Fracture/toughness");
  expect_refused("crack " + plate(), "these are missing: Crack/notch (the notch's length)");
  expect_refused(set("Fracture/toughness=-1"), "Fracture/toughness = -1 must be positive");
  expect_refused(set("Fracture/toughness=x - 1"), "Fracture/toughness = -0.9875 at (0.0125");
  expect_refused(set("Fracture/toughness=x < 0.6 ? 1 : 0"), "give a positive value for each phase");
  expect_refused(set("Material/E=x < 0.6 ? 1 : 0"), "Young's modulus E = 0");
  expect_refused(set("Fracture/toughness=x, y"), "one component");
  expect_refused(set("Domain/cracks=-1, 0 : -0.5, 0"), "the notch lies outside of the body");
  expect_refused(set("Domain/cracks=-0.1, 0.0125 : 0.5, 0.0125"), "goes through node");
  expect_refused(set("Domain/cracks=-0.1, 0 : 3, 0"), "no path of bonds joins the grips");
  expect_refused(set("Domain/fixed="), "this is missing: Domain/fixed (the grips)");
  expect_refused(set("Domain/fixed=0, 5 : 1, 6"), "grip 0 holds no node");
  expect_refused(set("Domain/fixed=0, -0.5 : 2, 0.5"), "holds all nodes");
  expect_refused(set("Domain/boundary=constrained"), "Domain/boundary = free");
  expect_refused(set("Problem/constraint=solution"), "the displacement of the grips at load 1");
  expect_refused(set("Problem/load=a: 1, 0; b: 0, 1"), "no more than one load");
  expect_refused(set("Problem/load=1"),
                 "Problem/load = '1' has 1 component(s), but the solid needs 2");
  expect_refused(set("Problem/load=1, 0") + " --set Fracture/solver=multigrid",
                 "because Problem/load is given");
  expect_refused(set("Material/nu=0.6"), "nu");
  expect_refused(set("Material/model=variational"), "take LPS");
  expect_refused(set("Kernel/type=polynomial") + " --set 'Kernel/coefficients=1, -2'",
                 "Kernel/type = polynomial is negative at r = 0.501 horizons");
  expect_refused(set("Kernel/type=conical") + " --set 'Fracture/surface terms=published'",
                 "write uncorrected, none or consistent");
  expect_refused(set("Study/h=0.05, 0.025"), "one Study/h");
  expect_refused(set("Study/h=0.03"), "mesh size h = 0.03 does not divide");
  expect_refused(set("Study/h=0.0005"), "Study/h = 0.0005 gives a body of 8e+06 nodes");
  expect_refused(set("Fracture/breaking=steps"), "Fracture/load step = 0 must be positive");
  expect_refused(set("Fracture/breaking=often"), "Fracture/breaking");
  expect_refused(set("Fracture/largest load=0"), "Fracture/max load = 0 must be positive");
  expect_refused(set("Fracture/ties=-1"), "Fracture/ties");
  expect_refused(set("Expected/growth=holes: 3"), "the quantity one of broken bonds");
  expect_refused(body + "--methods Q1", "'Q1' is not a meshfree rule");
  expect_refused(body + "--methods FA+energy",
                 "'FA+energy' does not support bonds that break; take one of FA, LAMMPS");
}

namespace
{
  std::string branching_plate()
  {
    return "grow " + std::string(PLUMBLINE_SCENES) +
           "/fracture/branching_plate.prm --quiet --set Study/h=0.001 --set "
           "Expected/values= ";
  }

  std::string set(const std::string &setting)
  {
    return " --set '" + setting + "'";
  }
} // namespace

TEST(GrowInMotion, tells_what_becomes_of_the_crack_and_draws_it)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome =
      run(branching_plate() + set("Expected/crack=unknown") + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = record(folder);
  EXPECT_LT(scalar(json, "energy imbalance"), .01);
  EXPECT_EQ(json["texts"]["outcome"], "branches");
  EXPECT_NEAR(scalar(json, "speed / c_R"), .388, .03);
  EXPECT_NEAR(scalar(json, "advance"), .0443, .002);
  EXPECT_GT(scalar(json, "branched"), 4 * 4 * .001); // horizons
  EXPECT_GT(scalar(json, "fastest / c_R"), scalar(json, "speed / c_R"));
  EXPECT_LT(scalar(json, "fastest / c_R"), 1);
  // one step divides 1/120 of the time, and is no longer than half the critical one
  const double step = scalar(json, "time step"), n = 46e-6 / 120 / step;
  EXPECT_NEAR(n, std::round(n), 1e-9);
  EXPECT_LE(step, .5 * scalar(json, "critical step"));
  EXPECT_EQ(scalar(json, "energy gained"), 0); // bonds alone
  EXPECT_NEAR(scalar(json, "overshoot"), .1, .01);
  EXPECT_NEAR(scalar(json, "broken energy / G"), 1.02, .05);
  const std::string page = read(folder / "grow.html");
  expect_found(page, "The crack " + json["texts"]["outcome"].get<std::string>());
  expect_found(page, "crack faces may overlap");
  for (const char *const name : {"moments.svg", "tip.svg", "energies.svg", "samples.csv"})
    EXPECT_TRUE(fs::exists(folder / "grow" / name)) << name;
  fs::remove_all(folder);
}

TEST(GrowInMotion, draws_a_body_that_nothing_moves)
{
  const fs::path folder = temporary("grow");
  const Outcome outcome =
      run(branching_plate() + set("Study/h=0.002") + set("Study/m=3") + set("Problem/load=0, 0") +
          set("Time/final time=5e-6") + set("Expected/crack=unknown") + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "grow" / "energies.svg"));
  expect_found(read(folder / "grow.html"), "No bond breaks");
  const Json json = record(folder);
  EXPECT_FALSE(json["scalars"].contains("speed")); // there is none
  EXPECT_FALSE(json["scalars"].contains("fastest / c_R"));
  fs::remove_all(folder);
}

TEST(GrowInMotion, warns_where_breaking_raises_the_energy)
{
  const std::string plate = "grow " + std::string(PLUMBLINE_SCENES) +
                            "/fracture/kalthoff_winkler.prm --set Study/h=0.005 " +
                            "--set Expected/values= --set Expected/crack=unknown";
  const fs::path folder = temporary("grow");
  const auto outcome = [&](const std::string &nu)
  { return run(plate + set("Material/nu=" + nu) + " -o " + folder.string()); };
  const std::string warning = "the energy of the body rose in some steps";
  const Outcome stiff = outcome("0.45");
  EXPECT_EQ(stiff.exit_code, 0) << stiff.err;
  expect_found(stiff.out + stiff.err, warning);
  const Outcome usual = outcome("0.3");
  EXPECT_EQ((usual.out + usual.err).find(warning), std::string::npos) << usual.err;
  fs::remove_all(folder);
}

TEST(GrowInMotion, warns_where_bonds_break_late)
{
  const std::string warning = "% beyond s0 on average";
  const fs::path folder = temporary("grow");
  const std::string plate = branching_plate() + " -o " + folder.string();
  const Outcome late =
                    run(plate + set("Time/critical fractions=0.9") + set("Expected/crack=unknown")),
                usual = run(plate);
  expect_found(late.out + late.err, warning);
  EXPECT_EQ((usual.out + usual.err).find(warning), std::string::npos) << usual.err;
  fs::remove_all(folder);
}

TEST(GrowInMotion, a_step_that_is_too_long_is_refused_with_the_critical_one)
{
  expect_refused(branching_plate() + set("Time/steps=1e-5"), "is longer than the critical step");
}

TEST(GrowInMotion, refuses_what_has_no_meaning_in_motion)
{
  const std::string plate = branching_plate();
  expect_refused(plate + set("Time/schemes=Runge-Kutta"), "bonds cannot break");
  expect_refused(plate + set("Problem/constraint=0, t"), "Problem/constraint empty");
  expect_refused(plate + set("Domain/fixed=0, 0.0175 : 0.1, 0.02"),
                 "needs Problem/constraint, the displacement of the grips in x, y and t");
  expect_refused(plate + set("Problem/load="), "a cause of motion: Problem/constraint");
  expect_refused(
      plate + set("Problem/load=0, t < 1e-5 ? t : 1e-5"),
      "varies so fast in t that 65 Chebyshev points up to Time/final time do not resolve it");
  // a pulse between the first points that polynomials are found at
  expect_refused(
      plate + set("Problem/load=0, abs(t - 1.22e-5) < 3e-7 ? 1e9*y : 0"),
      "varies so fast in t that 65 Chebyshev points up to Time/final time do not resolve it");
  const std::string grips = plate + set("Domain/fixed=0, 0.019 : 0.1, 0.02");
  expect_refused(grips + set("Problem/constraint=0, 1e-6 + t"),
                 "is (0, 1e-06) at the node (0.0005, 0.0195) of a grip at t = 0");
  expect_refused(plate + set("Domain/cracks=0.02, 0 : 0.0501, 0"),
                 "give it from its mouth to its tip");
  expect_refused(plate + set("Time/density="), "Time/density (the mass per volume");
  expect_refused(plate + set("Time/steps=2e-7"), "into whole steps; write 1.9166667e-07 or");
  expect_refused(plate + set("Time/steps=2e-7, 1e-7"), "one of Time/steps");
  expect_refused(plate + set("Time/critical fractions=0.5, 0.2"), "one of Time/critical fractions");
  expect_refused(plate + set("Time/a priori bounds=true"), "has no effect here");
  expect_refused(plate + set("Time/mass=lumped"), "Time/mass = lumped has no effect here");
  expect_refused(plate + set("Reference/method=Q1"), "Reference/method = Q1 has no effect here");
  expect_refused(plate + set("Fracture/stretch=finite"), "not derive from an energy");
  expect_refused(plate + set("Fracture/min reaction=0.1"),
                 "Fracture/min reaction = 0.1 has no effect");
  expect_refused(plate + set("Time/initial displacement=x, 0"), "initially unstrained");
  expect_refused("grow " + ::plate() + set("Expected/crack=runs"),
                 "Expected/crack = runs has no effect");
}
