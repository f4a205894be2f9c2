#include "meshfree/bond_hypotheses.h"

#include "given_bonds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  using Change = std::function<void(Bond &bond, const Weights &weights, std::size_t node)>;

  /// What is done to all bonds, and the cause to be found.
  struct Planted
  {
    std::string cause;
    Change plant;
    double factor = 1;
  };

  std::vector<Cause> causes_of(const std::string &rule, const scene::Problem &problem,
                               const Change &plant, bool is_recognised)
  {
    Weights weights = weights_of(rule, problem);
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (Bond &bond : weights.families[i].bonds)
        plant(bond, weights, i);
    return find_causes(weights.given(), is_recognised ? recognise(weights.given()) : std::nullopt);
  }

  Change times(double factor)
  {
    return [factor](Bond &bond, const Weights &, std::size_t) { bond.weight *= factor; };
  }

  std::vector<Planted> all_planted(double m)
  {
    return {{"negated", times(-1), -1},
            {"factor 2", times(2), 2},
            {"factor 1/2", times(.5), .5},
            {"negated, factor 2", times(-2), -2},
            {"volume of a ball", times(.75 / m), .75 / m},
            {"bond constant of 3D", times(1.25 / m), 1.25 / m},
            {"common factor", times(7), 7},
            {"kernel at midpoints",
             [](Bond &bond, const Weights &, std::size_t) { bond.kernel_point *= .5; }},
            {"kernel points reversed",
             [](Bond &bond, const Weights &, std::size_t) { bond.kernel_point *= -1; }},
            {"kernel points absolute", [](Bond &bond, const Weights &weights, std::size_t i)
             { bond.kernel_point += dealii::Tensor<1, 2>(weights.problem.cells->nodes[i]); }}};
  }
} // namespace

TEST(Causes, of_what_was_done_to_all_weights_are_found)
{
  constexpr double m = 3.015;
  for (const std::string kernel : {"linear-decay", "bond-tensor"})
    for (const double perturbation : {0., .2})
    {
      const auto problem = nodes_for(m, perturbation, kernel);
      for (const std::string rule : {"FA", "LAMMPS", "IPA-AC", "IPA-AC-R2"})
        for (const Planted &planted : all_planted(m))
        {
          const auto causes = causes_of(rule, problem, planted.plant, true);
          ASSERT_FALSE(causes.empty())
              << kernel << ", " << perturbation << ", " << rule << ", " << planted.cause;
          if (causes.size() > 1)
          { // besides kernel points, FA's own error
            EXPECT_EQ(causes[1].name, "missing ramp") << rule << ", " << planted.cause;
          }
          EXPECT_EQ(causes[0].name, planted.cause) << rule;
          EXPECT_NEAR(causes[0].factor, planted.factor, 1e-3 * std::abs(planted.factor)) << rule;
          EXPECT_LE(causes[0].after, causes[0].before + 1e-12) << rule;
        }
    }
}

TEST(Causes, are_told_by_moments_alone_where_no_rule_is_recognised)
{
  const auto problem = nodes_for(3.015, .2, "bond-tensor");
  for (const Planted &planted : all_planted(3.015))
  {
    const auto causes = causes_of("FA", problem, planted.plant, false);
    ASSERT_EQ(causes.size(), 1u) << planted.cause;
    EXPECT_EQ(causes[0].name, planted.cause);
  }
}

TEST(Causes, a_whole_ball_counts_the_own_volume)
{
  // IPA-AC's weights are the ball without the node's own cell
  for (const double perturbation : {0., .2})
  {
    const auto problem = nodes_for(3, perturbation, "linear-decay");
    const double ball = M_PI * problem.horizon() * problem.horizon();
    const auto causes = causes_of(
        "IPA-AC", problem,
        [&](Bond &bond, const Weights &weights, std::size_t i)
        { bond.weight /= 1 - weights.volumes[i] / ball; },
        true);
    ASSERT_EQ(causes.size(), 1u);
    EXPECT_EQ(causes[0].name, "own volume counted");
  }
}

TEST(Causes, sound_rules_have_none)
{
  for (const std::string kernel : {"linear-decay", "bond-tensor"})
    for (const double m : {3., 3.5, 4.})
      for (const double perturbation : {0., .3})
      {
        const auto problem = nodes_for(m, perturbation, kernel);
        for (const Rule &rule : rules())
          for (const bool is_recognised : {true, false})
            for (const Cause &cause : causes_of(rule.name, problem, times(1), is_recognised))
              // whole cells are a cause where cut ones would do
              EXPECT_TRUE(rule.name == "FA" && cause.name == "missing ramp")
                  << kernel << ", m = " << m << ", " << perturbation << ", " << rule.name << ": "
                  << cause.text;
      }
}

TEST(Causes, whole_cells_where_cut_ones_would_do_are_one)
{
  // bond tensors on moved nodes: partial areas do far better
  const auto problem = nodes_for(3.015, .2, "bond-tensor");
  const auto causes = causes_of("FA", problem, times(1), true);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].name, "missing ramp");
  EXPECT_TRUE(causes[0].is_own_error);
  EXPECT_LT(causes[0].after, causes[0].before / 4);
  EXPECT_TRUE(causes_of("PA-AC", problem, times(1), true).empty());
}
