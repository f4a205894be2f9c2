// Waves on strained double wells: the symbol, the local criterion and motions; critical time steps.

#include "study/strain_growth.h"
#include "method/discretisation.h"

#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/preflight.h"
#include "study/stability.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  scene::Scene torus(const std::vector<scene::Override> &settings)
  {
    std::vector<scene::Override> all = {{"Kernel/type", "constant"}, {"Study/h", "0.05"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("t.prm", scene::scene_template("double-well"), all);
  }

  Methods methods_of(const scene::Scene &scene)
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return choose_methods(scene, all);
  }

  std::vector<StrainGrowth> growths_of(const scene::Scene &scene)
  {
    const problem::Level level = scene.study.series[0].levels.back();
    auto growths = strain_growths(scene, "s", level);
    const problem::Problem<2> problem = scene::make_problem(scene, 0, level);
    for (const auto &method : methods_of(scene))
      add_growth(*method, problem, scene.time.density, growths);
    return growths;
  }
} // namespace

TEST(StrainGrowth, is_seen_at_the_rate_of_the_symbol_long_before_the_local_criterion)
{
  const auto growths = growths_of(torus({{"Methods/names", "IPA-AC-R2, Q1"}}));
  ASSERT_EQ(growths.size(), 3u);
  // J = 1, see tests/physics/double_well_stability.cc
  const double elliptic[] = {.977, .692, .994}, local[] = {1.621, .807, 3.090};
  for (std::size_t d = 0; d < 3; ++d)
  {
    const StrainGrowth &growth = growths[d];
    EXPECT_NEAR(growth.thresholds.ellipticity, elliptic[d], 1e-3) << growth.name;
    EXPECT_NEAR(growth.thresholds.local, local[d], 1e-3) << growth.name;
    EXPECT_GT(growth.first_wave, growth.thresholds.ellipticity) << growth.name;
    EXPECT_LT(growth.first_wave, growth.thresholds.local) << growth.name;
    ASSERT_EQ(growth.methods.size(), 1u); // Galerkin forces know no strain of the whole torus
    const MethodGrowth &rule = growth.methods[0];
    ASSERT_EQ(rule.observed.size(), growth.samples.size());
    for (std::size_t i = 0; i < growth.samples.size(); ++i)
    {
      const StrainSample &sample = growth.samples[i];
      EXPECT_EQ(sample.symbol > 0, sample.amplitude > growth.first_wave) << sample.amplitude;
      EXPECT_EQ(sample.local > 0, sample.amplitude > growth.thresholds.local) << sample.amplitude;
      if (rule.linear[i] > .1) // slower than that is not waited for
      {
        EXPECT_NEAR(rule.observed[i], rule.linear[i], .01 * rule.linear[i]) << sample.amplitude;
      }
      else
        EXPECT_LT(rule.observed[i], .2) << sample.amplitude;
    }
    EXPECT_GT(rule.observed.back(), 1) << growth.name;
    EXPECT_LT(growth.difference(rule), .12) << growth.name; // h = 1/20; a third of it at 1/40
    EXPECT_LT(growth.own_difference(rule), .01) << growth.name;
  }
}

TEST(StrainGrowth, rates_fall_with_the_root_of_the_density)
{
  const auto light = growths_of(torus({{"Methods/names", "FA"}, {"Study/h", "0.1"}})),
             heavy = growths_of(
                 torus({{"Methods/names", "FA"}, {"Study/h", "0.1"}, {"Time/density", "4"}}));
  const StrainSample &a = light[0].samples.back(), &b = heavy[0].samples.back();
  EXPECT_NEAR(a.symbol / b.symbol, 2, 1e-12);
  EXPECT_NEAR(a.local / b.local, 2, 1e-12);
  EXPECT_NEAR(light[0].methods[0].observed.back() / heavy[0].methods[0].observed.back(), 2, 1e-3);
}

// Jha & Lipton 2018, (65): of implicit Euler |1 + √λ Δt| / |1 - λ Δt²|.
TEST(StrainGrowth, spectral_radii_are_of_the_largest_strain_and_the_longest_step)
{
  const auto scene =
      torus({{"Methods/names", "FA"},
             {"Time/schemes", "implicit Euler, trapezoidal, velocity Verlet, Runge-Kutta"},
             {"Time/steps", "0.05, 0.01"}});
  const auto with = [](const scene::TimeSection &time, double critical)
  {
    Record record;
    record.curves["growth"] = {{"X", "", {1, 2}}, {"linear", "1/time", {0, 3}}};
    enter_spectral_radii(time, critical, record);
    return record;
  };
  const Record record = with(scene.time, 9);
  constexpr double z = 3 * .05;
  EXPECT_EQ(record["growth rate"], 3);
  EXPECT_EQ(record["growth step"], .05);
  EXPECT_NEAR(record["growth factor"], std::exp(z), 1e-15);
  EXPECT_NEAR(record["spectral radius of implicit Euler"], (1 + z) / std::abs(1 - z * z), 1e-14);
  EXPECT_NEAR(record["spectral radius of trapezoidal"], (1 + z / 2) / (1 - z / 2), 1e-14);
  const double half = 1 + z * z / 2; // eigenvalues of a matrix of determinant 1 and trace 2 + z²
  EXPECT_NEAR(record["spectral radius of velocity Verlet"], half + std::sqrt(half * half - 1),
              1e-14);
  EXPECT_FALSE(record.has("spectral radius of Runge-Kutta"));
  const auto fraction = torus({{"Methods/names", "FA"}, {"Time/critical fractions", "0.25"}});
  EXPECT_EQ(with(fraction.time, 9)["growth step"], 2.25);
}

TEST(StrainGrowth, expected_is_checked_for_every_direction)
{
  const auto check = [](const std::string &expected)
  {
    const auto scene = torus({{"Methods/names", "FA"}, {"Expected/strain growth", expected}});
    Records records(2);
    for (std::size_t d = 0; d < 2; ++d)
    {
      StrainGrowth growth;
      growth.samples.resize(1);
      growth.samples[0].symbol = 2;
      growth.methods = {{"FA", MethodFamily::meshfree, {2}, {d == 0 ? 2.02 : 2.2}, ""}};
      records[d].key.method = "FA";
      records[d].curves["growth"] = {};
      records[d].set("difference from the symbol", growth.difference(growth.methods[0]));
    }
    return check_growth(scene, records).at(0).holds;
  };
  EXPECT_TRUE(check("FA: 0.11"));
  EXPECT_FALSE(check("FA: 0.09")); // the second one is off by a tenth
  EXPECT_FALSE(check("PA-AC: 1"));
}

TEST(CriticalSteps, are_those_of_the_symbol_and_of_both_masses)
{
  const auto steps_of = [](const std::string &name, const scene::Scene &scene)
  {
    const problem::Level level = scene.study.series[0].levels.back();
    const problem::Problem<2> problem = scene::make_problem(scene, 0, level);
    const auto discretisation = methods_of(scene)[0]->discretise(problem);
    EXPECT_EQ(methods_of(scene)[0]->name(), name);
    return critical_steps(*discretisation, problem, analysis::measure(discretisation->matrix()),
                          scene.time.density);
  };
  // Δt_c √p/ε of FA at m = 4, see tests/meshfree/double_well_dynamics.cc
  const auto fa = steps_of("FA", torus({{"Methods/names", "FA"}}));
  EXPECT_NEAR(fa.own() / .2, .9467, 5e-4);
  EXPECT_EQ(fa.lumped(), 0);
  EXPECT_TRUE(fa.is_oscillating);
  const auto heavy = steps_of("FA", torus({{"Methods/names", "FA"}, {"Time/density", "9"}}));
  EXPECT_NEAR(heavy.own(), 3 * fa.own(), 1e-12);
  // of double wells by Galerkin both are of waves on a lattice without end
  const auto wells = steps_of("Q1", torus({{"Methods/names", "Q1"}, {"Study/h", "0.1"}}));
  EXPECT_GT(wells.largest, 1.2 * wells.largest_lumped);
  EXPECT_GT(wells.largest_lumped, 0);

  const auto line = [](const std::string &method, const std::string &mesh)
  {
    return scene::parse_scene("t.prm", "",
                              {{"Problem/solution", "x^2 + y"},
                               {"Domain/mesh", mesh},
                               {"Study/m", "2"},
                               {"Study/h", "0.125"},
                               {"Methods/names", method}});
  };
  // a mass matrix is smaller for short waves than its lumped one
  const auto q1 = steps_of("Q1", line("Q1", "lattice")),
             on_mesh = steps_of("Q1", line("Q1", "squares"));
  EXPECT_LT(q1.own(), .8 * q1.lumped());
  EXPECT_GT(q1.own(), .2 * q1.lumped());
  EXPECT_NEAR(on_mesh.own(), q1.own(), 1e-3 * q1.own());
  EXPECT_NEAR(on_mesh.lumped(), q1.lumped(), 1e-3 * q1.lumped());
}
