#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

using namespace plumbline::app;
using Json = nlohmann::json;

namespace
{
  Json records(const std::string &arguments)
  {
    const Outcome outcome = run("moduli --json " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out).at("records");
  }

  double scalar(const Json &record, const std::string &name)
  {
    return record.at("scalars").at(name).at("value");
  }
} // namespace

// by hand: whole cells at the nodes in the ball, bonds c ξ⊗ξ/|ξ|³ with c = 9E/(πδ³) in plane stress
TEST(ModuliCommand, says_what_modulus_a_rule_has)
{
  const Json found = records("--state stress --m 3.015 --E 200 --rules FA,IPA-AC-R2");
  ASSERT_EQ(found.size(), 2u);
  double along = 0, across = 0;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      if (const double r = std::hypot(i, j); r > 0 && r <= 3.015)
      {
        along += .5 * std::pow(i, 4) / (r * r * r);
        across += .5 * i * i * j * j / (r * r * r);
      }
  const double c = 9 * 200 / (M_PI * std::pow(3.015, 3));
  EXPECT_NEAR(scalar(found[0], "C1111"), c * along, 1e-10);
  EXPECT_NEAR(scalar(found[0], "C1212"), c * across, 1e-10);
  EXPECT_NEAR(scalar(found[0], "E"), 209.7, .05);
  EXPECT_NEAR(scalar(found[0], "nu"), .318, .0005);
  EXPECT_NEAR(scalar(found[0], "shear along axes"), 74.3, .05);
  EXPECT_NEAR(scalar(found[0], "shear across axes"), 79.5, .06);
  EXPECT_NEAR(scalar(found[1], "E"), 200, 1e-10);
  EXPECT_NEAR(scalar(found[1], "nu"), 1. / 3, 1e-12);
  const Json published = records("--m 3 --E 200 --rules pa-hhb,FV"),
             ours = records("--m 3 --E 200 --rules QWJ,FA");
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_EQ(scalar(published[i], "E"), scalar(ours[i], "E"));
}

TEST(ModuliCommand, takes_the_words_of_scenes)
{
  const std::string same = " --m 3.015 --rules FA";
  EXPECT_EQ(run("moduli --state stress" + same).out,
            run("moduli --state 'plane stress'" + same).out);
  EXPECT_EQ(run("moduli --state strain" + same).out,
            run("moduli --state 'plane strain'" + same).out);
  // the state is that of scenes, and told
  EXPECT_EQ(run("moduli" + same).out, run("moduli --state strain" + same).out);
  expect_found(run("moduli" + same).out, "plane strain");
}

TEST(ModuliCommand, knows_three_dimensions)
{
  const Json found = records("--state 3D --m 3 --E 200 --rules FA,OPT");
  // C1212 and C1111 are those of isotropic bonds times 1 + C(m) - 1 of the rule
  EXPECT_NEAR(scalar(found[0], "C1212") / 80, 1.218, .0006);
  EXPECT_NEAR(scalar(found[0], "C1111") / 240, 1.056, .0006);
  EXPECT_NEAR(scalar(found[0], "neighbours"), 122, 0);
  EXPECT_NEAR(scalar(found[1], "E"), 200, 1e-9);
  EXPECT_NEAR(scalar(found[1], "nu"), .25, 1e-12);
}

// GFD and R2c have exact second moments, of tensors at the centroid too
TEST(ModuliCommand, knows_rules_that_all_leaves_out)
{
  for (const std::string state : {"strain", "3D"})
  {
    const Json found = records("--state " + state + " --m 3 --E 200 --rules gfd,IPA-AC-R2c,GFDM");
    ASSERT_EQ(found.size(), 3u);
    for (const Json &one : found)
      EXPECT_NEAR(scalar(one, "E"), 200, 1e-8) << one;
  }
  const Json all = records("--m 3");
  for (const Json &one : all)
    EXPECT_NE(one.at("key").at("method"), "GFD");
}

TEST(ModuliCommand, says_which_rule_has_no_weights)
{
  const Json found = records("--state 3D --m 1.5 --rules OPT,FA");
  EXPECT_NE(found[0].at("failure").get<std::string>().find("infeasible"), std::string::npos);
  EXPECT_GT(scalar(found[1], "E"), 1);
}

TEST(ModuliCommand, refuses_what_it_cannot_take)
{
  const auto expect = [](const std::string &arguments, const std::string &message)
  {
    const Outcome outcome = run("moduli " + arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    expect_found(outcome.err, message);
  };
  expect("--kernel constant", "has no elastic constants of its own; choose bond-tensor");
  expect("--kernel nope", "choose one of");
  expect("--m 0.5", "must be between 1");
  expect("--m nan", "--m");
  expect("--m 3,015", "looks like a number with a decimal comma; write 3.015");
  expect("--rules XY", "choose all or some of FA, LAMMPS");
  expect("--rules XY", "GFD, PDDO, GMLS, MC, IPA-AC-R2c");
  for (const std::string rule : {"PDDO", "gmls"})
    expect("--rules FA," + rule, "supports scalar kernels only, which have no elastic "
                                 "constants; take GFD or IPA-AC-R2");
  expect("--state solid", "choose 'plane stress', 'plane strain' or 3D");
  expect("--E 0", "give a number above 0");
}

TEST(WeightsCommand, prints_the_family_of_a_rule)
{
  const auto rows_of = [](const std::string &text)
  {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line))
    {
      std::istringstream row(line);
      rows.emplace_back();
      for (std::string value; std::getline(row, value, ',');)
        rows.back().push_back(std::stod(value));
    }
    return rows;
  };
  const Outcome plane = run("weights FA --m 2 --h 0.5");
  EXPECT_EQ(plane.exit_code, 0) << plane.err;
  expect_found(plane.out, "x,y,weight,qx,qy,area\n");
  EXPECT_EQ(rows_of(plane.out).size(), 12u); // lattice points within 2 h
  for (const auto &row : rows_of(plane.out))
    EXPECT_EQ(row.at(2), .25);
  // linear decay, c = 45 / (2 pi delta^5) for diffusion 1/2: sum of w C x^2 is 1
  const Outcome space = run("weights IPA-AC-R2 --m 2.5 --dimension 3");
  expect_found(space.out, "x,y,z,weight,qx,qy,qz,volume\n");
  double moment = 0;
  for (const auto &row : rows_of(space.out))
  {
    const double r = std::hypot(row.at(4), row.at(5), row.at(6)) / 2.5;
    moment +=
        row.at(3) * 45 / (2 * M_PI * std::pow(2.5, 5)) * std::max(0., 1 - r) * row[0] * row[0];
  }
  EXPECT_NEAR(moment, 1, 1e-12);
  for (const std::string bad : {"weights FB", "weights FA --m 0.5", "weights FA --dimension 4",
                                "weights FA --h 0", "weights FA --kernel table"})
    EXPECT_EQ(run(bad).exit_code, 2) << bad;
}
