#include "scene/scene.h"

#include "base/error.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  using Settings = std::vector<Override>;

  Scene solid(Settings settings = {})
  {
    settings.insert(settings.begin(), {{"Study/h", "0.2, 0.1"}, {"Methods/names", "Q1"}});
    return parse_scene("t.prm", scene_template("LPS"), settings);
  }

  Scene bar(const Settings &settings = {})
  {
    return parse_scene("t.prm", scene_template("variational"), settings);
  }

  void expect_error(const std::function<void()> &action, const std::string &fragment)
  {
    try
    {
      action();
      ADD_FAILURE() << "no error: " << fragment;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos)
          << fragment << " is not in: " << error.what();
    }
  }

  void expect_solid_error(const Settings &settings, const std::string &fragment)
  {
    expect_error([&] { (void)solid(settings); }, fragment);
  }

  void expect_bar_error(const Settings &settings, const std::string &fragment)
  {
    expect_error([&] { (void)bar(settings); }, fragment);
  }
} // namespace

TEST(Material, PairsOfConstantsDescribeTheSameSolid)
{
  const Settings none = {{"Material/E", ""}, {"Material/nu", ""}};
  const auto constants = [&](const std::string &first, const std::string &a,
                             const std::string &second, const std::string &b)
  {
    Settings settings = none;
    settings.push_back({"Material/" + first, a});
    settings.push_back({"Material/" + second, b});
    return solid(settings).material.lame()({});
  };
  for (const physics::Lame &lame :
       {constants("E", "2.6", "nu", ".3"), constants("lambda", "1.5", "mu", "1"),
        constants("k", "2.5", "l", "8")})
  {
    EXPECT_NEAR(lame.lambda, 1.5, 1e-14);
    EXPECT_NEAR(lame.mu, 1, 1e-14);
  }
}

TEST(Material, EqualLameConstantsNeedNoDilatationAndHalfTheCollar)
{
  EXPECT_TRUE(solid().has_dilatation());
  EXPECT_EQ(solid().reach(.3), .6);
  const Scene bonds = solid({{"Material/nu", "1/4"}});
  EXPECT_FALSE(bonds.has_dilatation());
  EXPECT_EQ(bonds.reach(.3), .3);
  EXPECT_FALSE(make_problem(bonds, 0, {.1, .3}).dilatation);
  const Scene full = solid({{"Material/nu", "1/4"}, {"Solver/model", "full"}});
  EXPECT_TRUE(full.has_dilatation());
  EXPECT_EQ(full.domain.mesh.name, "squares");
}

TEST(Material, BondsOfAHomogeneousSolidCarryMuAndThoseOfOthersACoefficient)
{
  const Problem homogeneous = make_problem(solid(), 0, {.1, .3});
  const double mu = 1 / 2.6;
  EXPECT_NEAR(homogeneous.kernel.limit().mu, mu, 1e-14);
  EXPECT_FALSE(homogeneous.coefficient);
  ASSERT_TRUE(homogeneous.dilatation);
  EXPECT_TRUE(homogeneous.dilatation->is_symmetric());

  const Problem other = make_problem(
      solid({{"Material/E", "1 + (x > .5)"}, {"Domain/mesh", "squares"}}), 0, {.1, .3});
  EXPECT_NEAR(other.kernel.limit().mu, 1, 1e-14);
  ASSERT_TRUE(other.coefficient && other.dilatation);
  EXPECT_NEAR(other.coefficient->at({.7, .5}), 2 * mu, 1e-14);
  EXPECT_NEAR(other.coefficient->mean(mu, 2 * mu), 4 * mu / 3, 1e-14); // harmonic
  EXPECT_FALSE(other.dilatation->is_symmetric());
  EXPECT_NEAR(geometry::collar_width(*other.mesh()), .6, 1e-12);
}

TEST(Material, ConstantsOfNoSolidAreRefusedByName)
{
  expect_solid_error({{"Material/nu", ".5"}}, "Poisson's ratio nu = 0.5, but it must be larger");
  expect_solid_error({{"Material/nu", "-1"}}, "Poisson's ratio nu = -1");
  expect_solid_error({{"Material/E", "0"}}, "Young's modulus E = 0, but it must be positive");
  expect_bar_error({{"Material/k", "-100"}}, "bulk constant k = -100, but it must be positive");
  expect_bar_error({{"Material/l", "-8"}}, "shear constant l = -8, but it must be positive");
  expect_solid_error({{"Material/E", ""}, {"Material/nu", ""}}, "needs one pair of constants");
  expect_solid_error({{"Material/k", "1"}, {"Material/l", "8"}}, "needs one pair of constants");
  expect_solid_error({{"Material/nu", ""}}, "Material/E needs Material/nu");
  expect_solid_error({{"Material/model", "bond-based"}}, "imply nu = 1/4");
  expect_solid_error({{"Material/E", "1, 2"}}, "must be one expression");
}

TEST(Material, OfBondsHasTheYoungsModulusThatIsGiven)
{
  const double E = 200e9, horizon = .003;
  const Settings tensor = {{"Kernel/type", "bond-tensor"},
                           {"Kernel/limit", "Navier"},
                           {"Problem/solution", "x, y"},
                           {"Study/h", "0.1"},
                           {"Methods/names", "FA"}};
  const auto with = [&](Settings settings)
  {
    settings.insert(settings.begin(), tensor.begin(), tensor.end());
    settings.push_back({"Material/E", "200e9"});
    return parse_scene("t.prm", "", settings);
  };
  const auto mu = [&](const Settings &settings)
  { return make_kernel(with(settings), horizon).limit().mu; };
  EXPECT_NEAR(mu({}), E / 2.5, 1e-12 * E);
  EXPECT_NEAR(mu({{"Material/nu", "0.25"}}), E / 2.5, 1e-12 * E);
  EXPECT_NEAR(mu({{"Material/plane", "stress"}, {"Material/nu", ".333"}}), E * 3 / 8, 1e-12 * E);
  expect_error(
      [&] {
        mu({{"Material/plane", "stress"}, {"Material/nu", "0.25"}});
      },
      "imply nu = 1/3 in plane stress");
  Settings in_space = {{"Domain/dimension", "3"},
                       {"Domain/boxes", "0,0,0 : 1,1,1"},
                       {"Problem/solution", "x, y, z"}};
  EXPECT_NEAR(make_kernel_in_space(with(in_space), horizon).limit().mu, E / 2.5, 1e-12 * E);
  in_space.push_back({"Material/plane", "stress"});
  expect_error([&] { with(in_space); }, "Material/plane = stress has no effect here");
}

TEST(Material, OfDoubleWellsHasTheModulusAndTheToughnessThatAreGiven)
{
  const auto law = [](const Settings &settings, double horizon)
  {
    return make_double_well(parse_scene("t.prm", scene_template("double-well"), settings), horizon);
  };
  const Settings glass = {{"Material/E", "72e9"}, {"Material/toughness", "8"}};
  for (const double horizon : {.001, .2})
    for (const std::string influence : {"constant", "linear-decay"})
    {
      Settings settings = glass;
      settings.push_back({"Kernel/type", influence});
      EXPECT_NEAR(law(settings, horizon).modulus(), 72e9 / 2.5, 1e-12 * 72e9);
      EXPECT_NEAR(law(settings, horizon).toughness(), 8, 1e-12 * 8);
      settings.push_back({"Material/plane", "stress"});
      EXPECT_NEAR(law(settings, horizon).modulus(), 72e9 * 3 / 8, 1e-12 * 72e9);
    }
}

TEST(Material, FieldsAreCheckedEverywhere)
{
  const Settings mesh = {{"Domain/mesh", "squares"}};
  const auto with = [&](const std::string &key, const std::string &value)
  {
    Settings settings = mesh;
    settings.push_back({key, value});
    return settings;
  };
  expect_solid_error({{"Material/E", "1 + x^2"}}, "varies in space with Domain/mesh = lattice");
  expect_error(
      [&] {
        (void)make_problem(solid(with("Material/E", "x")), 0, {.1, .3});
      },
      "Material/E and nu at (");
  expect_error(
      [&] {
        (void)make_problem(solid(with("Material/nu", "-x/10")), 0, {.1, .3});
      },
      "harmonic means need it positive");
  // a phase without its constant
  for (const char *const part :
       {"Material/E and nu at (-0.", "Young's modulus E = 0, but it must be positive",
        "give constants that are admissible at every point, different ones for each phase"})
    expect_error(
        [&] {
          (void)make_problem(solid(with("Material/E", "x > 0.5 ? 87 : 0")), 0, {.1, .3});
        },
        part);
}

TEST(Material, ModelsAndKernelsFit)
{
  expect_solid_error({{"Kernel/type", "bond-tensor"}}, "uses Kernel/type as its influence");
  expect_solid_error({{"Kernel/limit", "-Laplace"}}, "uses Kernel/type as its influence");
  expect_solid_error({{"Problem/solution", "x"}}, "but the solid needs 2");
  expect_solid_error({{"Domain/collar", ".4"}}, "thinner than twice the horizon");
}

TEST(FreeBody, IsAVariationalBoxThatIsHeldSomewhere)
{
  const Scene scene = bar();
  const Problem problem = make_problem(scene, 0, {.05, .05});
  ASSERT_TRUE(problem.body() && problem.mesh() && problem.cells() && problem.coefficient);
  EXPECT_FALSE(problem.lattice());
  // 41 × 21 vertices, those at x = 0, .05 and .1 hold the bar: the cell at .1 begins at .075
  EXPECT_EQ(problem.cells()->size(), 41u * 21u);
  EXPECT_EQ(problem.cells()->n_free, 38u * 21u);

  expect_bar_error({{"Domain/fixed", ""}}, "3 rigid modes");
  expect_bar_error({{"Material/model", "LPS"}}, "Domain/boundary = free; take variational");
  expect_bar_error({{"Methods/nodes", "centres"}}, "needs Methods/nodes = vertices");
  expect_bar_error({{"Domain/holes", "1, .5 : 1.1, .6"}}, "one box");
  expect_bar_error({{"Domain/boxes", "0, 0 : 1, 1; 1, 0 : 2, 0.5"}}, "write squares or triangles");
  expect_bar_error({{"Domain/fixed", "0, 0 : .07, 1"}}, "does not divide the box");
  expect_solid_error({{"Methods/load", "cells"}}, "Methods/load = cells is for free bodies");
  expect_bar_error({{"Domain/boundary", "constrained"}}, "write Domain/boundary = free");
}

TEST(FreeBody, IsOfAnyShapeThatAMeshSays)
{
  const auto area = [](const Settings &settings, double h)
  {
    Settings all = {{"Study/h", "0.1"}, {"Study/horizon", "0.2"}};
    all.insert(all.end(), settings.begin(), settings.end());
    const Problem problem = make_problem(bar(all), 0, {h, .2});
    EXPECT_EQ(problem.body()->h, h);
    EXPECT_LT(problem.cells()->n_free, problem.cells()->size());
    double sum = 0;
    for (std::size_t c = 0; c < problem.mesh()->cells.size(); ++c)
      sum += geometry::area(geometry::view(problem.mesh()->polygon(c)));
    EXPECT_NEAR(std::accumulate(problem.cells()->area.begin(), problem.cells()->area.end(), 0.),
                sum, 1e-12 * sum);
    return sum;
  };
  // an L, whose lattice begins with its boxes; a slanted bar; a disk; the lower half of a square
  EXPECT_NEAR(area({{"Domain/boxes", "0.03, 0 : 1.03, 0.5; 0.03, 0 : 0.53, 1"},
                    {"Domain/fixed", "0.03, 0 : 0.13, 1"},
                    {"Domain/mesh", "triangles"}},
                   .1),
              .75, 1e-12);
  EXPECT_NEAR(area({{"Domain/mesh", "squares"}, {"Domain/map", "x - .3*y, .2*x + y"}}, .1), 2.12,
              1e-12);
  EXPECT_NEAR(area({{"Domain/mesh", "hyper_ball_balanced"},
                    {"Domain/arguments", "0, 0 : 1"},
                    {"Domain/fixed", "-2, -2 : -0.5, 2"}},
                   .1),
              3.14159, .02);
  EXPECT_NEAR(area({{"Domain/mesh", "hyper_cube"},
                    {"Domain/arguments", "0 : 1 : false"},
                    {"Domain/inside", "0.5 - y"},
                    {"Domain/fixed", "0, 0 : 0.1, 2"}},
                   .1),
              .5, 1e-12);
  expect_error(
      [&]
      {
        area(
            {{"Domain/mesh", "squares"}, {"Domain/map", "x, 2*y"}, {"Domain/fixed", "3, 0 : 4, 1"}},
            .1);
      },
      "nothing of the body is fixed");
  expect_error(
      [&]
      {
        area({{"Domain/mesh", "hyper_ball_balanced"},
              {"Domain/arguments", "0, 0 : 1"},
              {"Domain/fixed", "-2, -2 : -0.5, 2; 1.5, 0 : 2, 1"}},
             .1);
      },
      "the fixed box 1.5, 0 : 2, 1 lies beside the body");
}
