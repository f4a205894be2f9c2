// Scenes that move: what their keys mean, and what is refused.

#include "base/error.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  using Settings = std::vector<Override>;

  Scene torus(const Settings &settings = {})
  {
    return parse_scene("t.prm", scene_template("double-well"), settings);
  }

  /// A scalar wave with data in the collar.
  Scene wave(Settings settings = {})
  {
    settings.insert(settings.begin(), {{"Time/final time", "1"},
                                       {"Problem/solution", "sin(t)*x^2"},
                                       {"Study/norms", "nodal L2"},
                                       {"Study/decisive error", "nodal L2 | exact"}});
    return parse_scene("t.prm", scene_template("scalar"), settings);
  }

  void expect_refused(const Settings &settings, const std::string &fragment, bool is_torus = true)
  {
    try
    {
      (void)(is_torus ? torus(settings) : wave(settings));
      ADD_FAILURE() << "no error: " << fragment;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos)
          << fragment << " is not in: " << error.what();
    }
  }
} // namespace

TEST(Motion, template_is_a_torus_of_double_wells)
{
  const Scene scene = torus({{"Material/c", "2"}, {"Material/beta", "3"}});
  EXPECT_TRUE(scene.domain.is_periodic && scene.time.is_dynamic() && scene.is_vector());
  EXPECT_FALSE(scene.has_dilatation());
  const physics::DoubleWell law = make_double_well(scene, .2);
  EXPECT_EQ(law.stiffness(), 6);
  const physics::LocalLimit limit = make_kernel(scene, .2).limit();
  EXPECT_NEAR(limit.mu, law.modulus(), 1e-14);
}

TEST(Motion, double_wells_have_any_potential)
{
  const Scene scene = torus({{"Material/c", "2"},
                             {"Material/beta", "3"},
                             {"Material/potential", "5*r/(1 + 2*r)"}}); // 5 c beta r, to 5/2 c
  const physics::DoubleWell law = make_double_well(scene, .2);
  EXPECT_NEAR(law.stiffness(), 30, 1e-13);
  EXPECT_NEAR(law.c(), 5, 1e-14);
  EXPECT_NEAR(law.potential(.7), 2 * 5 * 2.1 / 5.2, 1e-12);
  const physics::DoubleWell glass =
      make_double_well(torus({{"Material/E", "72e9"},
                              {"Material/toughness", "8"},
                              {"Material/potential", "5*r/(1 + 2*r)"}}),
                       1e-3);
  EXPECT_NEAR(glass.toughness(), 8, 1e-12);
  EXPECT_NEAR(glass.modulus(), .4 * 72e9, 1e-2);
  expect_refused({{"Material/potential", "ln(1 + r)"}},
                 "Material/potential: f = 'ln(1 + r)' has no finite limit as r grows");
  expect_refused({{"Material/potential", "c*r/(1 + r)"}}, "there is an unknown name 'c'");
}

TEST(Motion, expressions_have_the_time_in_them)
{
  const Scene scene = wave();
  EXPECT_FALSE(scene.is_steady());
  EXPECT_TRUE(wave({{"Problem/solution", "x^2"}}).is_steady());
  const Problem problem = make_problem(scene, 0, {.1, .3}, .5);
  EXPECT_NEAR(problem.solution->value({.3, .1}, 0), std::sin(.5) * .09, 1e-15);
  EXPECT_NEAR(problem.load.value({.3, .1}, 0), -std::sin(.5), 1e-12); // -1/2 Laplace of x²
  expect_refused({{"Time/final time", "0"}}, "unknown name or sign 't'", false);
}

TEST(Motion, double_wells_are_loaded_by_their_own_force)
{
  const Scene scene = torus({{"Problem/solution", "0.1*sin(2*pi*x)*cos(t), 0"}});
  const Problem problem = make_problem(scene, 0, {.1, .2}, 1);
  const Problem weak =
      make_problem(torus({{"Problem/solution", "1e-4*sin(2*pi*x)*cos(t), 0"}}), 0, {.1, .2}, 1);
  // small strains see the symbol, see tests/reference/torus_force.cc; larger ones softer bonds
  const double rigid = 1e-4 * std::cos(1.) * std::sin(.6 * M_PI) * 4.7235952;
  EXPECT_NEAR(weak.load.value({.3, .7}, 0), rigid, 1e-6 * rigid);
  EXPECT_LT(problem.load.value({.25, .7}, 0), 999 * weak.load.value({.25, .7}, 0));
}

TEST(Motion, refuses_by_key_value_and_remedy)
{
  expect_refused({{"Time/steps", "0.1, 0"}}, "Time/steps = 0 must be positive");
  expect_refused({{"Time/steps", "0.1, 0.2"}}, "write steps in decreasing order");
  expect_refused({{"Time/critical fractions", "-1"}}, "Time/critical fractions = -1");
  expect_refused({{"Time/density", "0"}}, "Time/density = 0 must be positive");
  expect_refused({{"Time/damping", "-1"}}, "Time/damping = -1 must not be negative");
  expect_refused({{"Time/final time", "-1"}}, "Time/final time = -1 must be positive and finite");
  expect_refused({{"Material/c", "0"}}, "Material/c = 0 must be positive");
  expect_refused({{"Material/beta", "-2"}}, "Material/beta = -2 must be positive");
  expect_refused({{"Kernel/type", "1/r"}}, "it must be bounded");
  expect_refused({{"Time/initial displacement", ""}}, "needs initial data or a load");
  expect_refused({{"Time/initial displacement", "x"}}, "1 component");
  expect_refused({{"Problem/solution", "x, 0"}}, "with the periods 1 and 1");
  expect_refused({{"Material/boundary function", "smoothstep"}}, "there is no boundary");
  expect_refused({{"Domain/boxes", "0, 0 : 2, 1"}}, "needs a square");
  expect_refused({{"Domain/boundary", "constrained"}}, "needs Domain/boundary = periodic");
  expect_refused({{"Domain/mesh", "squares"}},
                 "Domain/boundary = periodic needs Domain/mesh = lattice: other nodes have no "
                 "neighbours across the sides");
  expect_refused(
      {{"Domain/boundary", "constrained"},
       {"Domain/mesh", "hyper_cube"},
       {"Domain/arguments", "0 : 1"},
       {"Domain/inside", "1"},
       {"Reference/method", "none"},
       {"Study/decisive error", "nodal L2 | exact"},
       {"Material/boundary function", "smoothstep"}},
      "which Domain/mesh = hyper_cube need not have; write Material/boundary function = one, or");
  expect_refused({{"Study/norms", "averages L2"}}, "compared at nodes");
  expect_refused({{"Reference/method", "Q2"}}, "transient analyses use torus");
  expect_refused({{"Domain/boundary", "periodic"}}, "take double well, or write constrained",
                 false);
}

TEST(Motion, on_a_line_is_of_x_alone)
{
  const Settings line = {{"Domain/dimension", "1"},
                         {"Time/initial displacement", "0.1*sin(2*pi*x)"}};
  const auto refuse = [&](const Settings &settings, const std::string &fragment)
  {
    Settings all = line;
    all.insert(all.end(), settings.begin(), settings.end());
    expect_refused(all, fragment);
  };
  Settings loaded = line;
  loaded.push_back({"Problem/solution", "1e-4*sin(2*pi*x)*cos(t)"});
  const Problem problem = make_problem(torus(loaded), 0, {.025, .1}, 0);
  EXPECT_EQ(problem.n_components, 1u);
  EXPECT_EQ(problem.lattice()->n_cells(), (std::array<int, 2>{40, 1}));
  const double rigid =
      1e-4 * std::sin(.6 * M_PI) * 13.0304043; // see tests/reference/torus_force.cc
  EXPECT_NEAR(problem.load.value({.3, 0}, 0), rigid, 1e-6 * rigid);

  refuse({{"Time/initial displacement", "0.1*sin(2*pi*y)"}}, "depends on y, which a line");
  refuse({{"Problem/load", "y"}}, "Problem/load = 'y' depends on y");
  refuse({{"Time/initial displacement", "sin(2*pi*x), 0"}}, "but the line needs 1");
  refuse({{"Domain/boundary", "constrained"}}, "needs Domain/boundary = periodic");
  refuse({{"Domain/dimension", "3"}}, "Domain/dimension");
  expect_refused({{"Domain/dimension", "1"}},
                 "Domain/dimension = 1 does not support transient analyses", false);
}

TEST(Motion, of_meshes_has_no_room_for_a_dilatation_without_mass)
{
  EXPECT_NO_THROW((void)wave({{"Domain/mesh", "squares"}}));
  const auto solid = [](const std::string &dilatation)
  {
    return parse_scene("t.prm", scene_template("LPS"),
                       {{"Domain/mesh", "squares"},
                        {"Solver/dilatation", dilatation},
                        {"Methods/names", "IPA-AC"},
                        {"Reference/method", "none"},
                        {"Time/final time", "1"},
                        {"Study/norms", "nodal L2"},
                        {"Study/decisive error", "nodal L2 | exact"}});
  };
  EXPECT_NO_THROW((void)solid("eliminated"));
  try
  {
    (void)solid("kept");
    ADD_FAILURE() << "not refused";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("a dilatation unknown has no mass"), std::string::npos)
        << error.what();
  }
}
