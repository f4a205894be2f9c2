// Causes that change the list of bonds or every weight, and factors of volumes.
#include "given_bonds.h"

#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_hypotheses.h"
#include "meshfree/check/given_rows.h"
#include "meshfree/check/volume_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  using Change = std::function<void(Bond<2> &bond, const Weights &weights, std::size_t node,
                                    std::size_t neighbour)>;

  Weights changed(Weights weights, const Change &change)
  {
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (std::size_t k = 0; k < weights.families[i].bonds.size(); ++k)
        change(weights.families[i].bonds[k], weights, i, weights.families[i].neighbours[k]);
    return weights;
  }

  Weights times(const Weights &weights, double factor)
  {
    return changed(weights, [factor](Bond<2> &bond, const Weights &, std::size_t, std::size_t)
                   { bond.weight *= factor; });
  }

  Explanation<2> explained(const Weights &weights, const Circumstances<2> &circumstances = {})
  {
    return explain(weights.given(), recognise(weights.given()), circumstances);
  }

  std::string names(const std::vector<Cause> &causes)
  {
    std::string all;
    for (const Cause &cause : causes)
      all += (all.empty() ? "" : "; ") + cause.name;
    return all;
  }

  /// Takes the bonds out for which `is_left` says so.
  Weights without(Weights weights,
                  const std::function<bool(std::size_t i, std::size_t j)> &is_left_out)
  {
    for (std::size_t i = 0; i < weights.families.size(); ++i)
    {
      Family<2> left;
      const Family<2> &all = weights.families[i];
      for (std::size_t k = 0; k < all.bonds.size(); ++k)
        if (!is_left_out(i, all.neighbours[k]))
        {
          left.neighbours.push_back(all.neighbours[k]);
          left.bonds.push_back(all.bonds[k]);
        }
      weights.families[i] = left;
    }
    return weights;
  }

  /// Nodes whose volumes differ by the side they are on, as on graded nodes.
  Weights graded(const std::string &rule)
  {
    return weights_of(rule, nodes_for(3.015, .3, "linear-decay"));
  }
} // namespace

TEST(Structure, half_lists_of_any_order_are_named_and_mended)
{
  for (const double perturbation : {0., .2})
  {
    const Weights whole = weights_of("FA", nodes_for(3.015, perturbation, "linear-decay"));
    const double own = check_moments(whole.families, whole.problem.kernel).typical();
    const std::size_t n = whole.families.size();
    using IsLeftOut = std::function<bool(std::size_t, std::size_t)>;
    const std::vector<std::pair<std::string, IsLeftOut>> orders = {
        {"i < j", [](std::size_t i, std::size_t j) { return j < i; }},
        {"i > j, the collar whole", [n](std::size_t i, std::size_t j) { return j > i && j < n; }},
        {"by parity", [](std::size_t i, std::size_t j) { return ((i + j) % 2 == 0) == (i < j); }}};
    for (const auto &[order, is_left_out] : orders)
      for (const double factor : {1., .002, 1000.})
      {
        const Explanation<2> found = explained(times(without(whole, is_left_out), factor));
        ASSERT_FALSE(found.causes.empty()) << order << ", " << factor;
        EXPECT_EQ(found.causes[0].name, "half list") << order;
        EXPECT_TRUE(found.causes[0].is_structural);
        EXPECT_NEAR(found.causes.back().after, own, perturbation > 0 ? 1e-3 : 1e-9)
            << order << ", " << factor;
        EXPECT_EQ(found.causes.size(), factor == 1 ? 1u : 2u) << names(found.causes);
        ASSERT_TRUE(found.rule) << order;
        EXPECT_EQ(found.rule->rule, "FA") << order;
      }
  }
}

TEST(Structure, half_lists_take_the_bonds_that_nodes_of_the_collar_give)
{
  const Weights whole = weights_of("IPA-AC-R2", nodes_for(3, 0, "linear-decay"));
  const std::size_t n = whole.families.size();
  Circumstances<2> circumstances;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < whole.families[i].bonds.size(); ++k)
      if (const std::size_t j = whole.families[i].neighbours[k]; j >= n)
      {
        Bond<2> back = whole.families[i].bonds[k];
        back.xi *= -1;
        back.kernel_point *= -1;
        circumstances.of_collar.push_back({j, i, back});
      }
  const auto causes =
      explained(without(whole, [n](std::size_t i, std::size_t j) { return j < i || j >= n; }),
                circumstances)
          .causes;
  ASSERT_EQ(causes.size(), 1u) << names(causes);
  EXPECT_EQ(causes[0].name, "half list");
  EXPECT_LT(causes[0].worst_after, 1e-10);
}

TEST(Structure, a_kernel_in_the_weights_is_named_by_its_profile)
{
  const std::vector<std::pair<std::string, double (*)(double)>> profiles = {
      {"like 1 - r/horizon, as the scene's kernel does", [](double t) { return 1 - t; }},
      {"like (1 - r/horizon)^2, which is not", [](double t) { return (1 - t) * (1 - t); }},
      {"like exp(-4 (r/horizon)^2), which is not", [](double t) { return std::exp(-4 * t * t); }},
      {"like 1/r, which is not", [](double t) { return 1 / t; }},
      {" (from ", [](double t) { return 1 / (1 + 40 * std::pow(t, 5)); }}};
  for (const double perturbation : {0., .2})
    for (const auto &[text, profile] : profiles)
      for (const double constant : {1., 35.4, -1.})
      {
        const Weights weights = changed(
            weights_of("FA", nodes_for(4, perturbation, "linear-decay")),
            [&, profile = profile](Bond<2> &bond, const Weights &w, std::size_t, std::size_t)
            { bond.weight *= constant * profile(bond.xi.norm() / w.problem.horizon()); });
        const Explanation<2> found = explained(weights);
        ASSERT_FALSE(found.causes.empty()) << text << ", " << perturbation;
        EXPECT_EQ(found.causes[0].name, "kernel in the weights") << text;
        EXPECT_NE(found.causes[0].text.find(text), std::string::npos) << found.causes[0].text;
        ASSERT_TRUE(found.rule);
        EXPECT_EQ(found.rule->rule, "FA");
      }
}

TEST(Structure, weights_with_the_own_volume_are_named)
{
  for (const std::string rule : {"FA", "LAMMPS"})
    for (const double factor : {1., 1e6})
    {
      const Weights weights = times(
          changed(graded(rule), [](Bond<2> &bond, const Weights &w, std::size_t i, std::size_t j)
                  { bond.weight *= w.volumes[i] / w.volumes[j]; }),
          factor);
      const Explanation<2> found = explained(weights);
      ASSERT_FALSE(found.causes.empty()) << rule << ", " << factor;
      EXPECT_EQ(found.causes[0].name, "own volume") << rule << ": " << names(found.causes);
      ASSERT_TRUE(found.rule);
      EXPECT_EQ(found.rule->rule, rule);
      EXPECT_EQ(found.causes.size(), factor == 1 ? 1u : 2u) << names(found.causes);
    }
}

TEST(Structure, a_drift_is_named_with_its_direction)
{
  for (const double perturbation : {0., .2})
    for (const Point<2> wind : {Point<2>(1, 0), Point<2>(0, -1), Point<2>(1, 1)})
    {
      const Weights weights =
          changed(weights_of("IPA-AC-R2", nodes_for(3, perturbation, "linear-decay")),
                  [&](Bond<2> &bond, const Weights &, std::size_t, std::size_t)
                  {
                    const double ahead = dealii::Tensor<1, 2>(wind) * dealii::Tensor<1, 2>(bond.xi);
                    bond.weight *= 1 + (ahead > 1e-9 ? .1 : ahead < -1e-9 ? -.1 : 0);
                  });
      const auto causes = explained(weights).causes;
      ASSERT_EQ(causes.size(), 1u) << perturbation << names(causes);
      EXPECT_EQ(causes[0].name, "drift");
      EXPECT_NE(causes[0].text.find("grows like 1/horizon"), std::string::npos);
      const std::string direction = wind[0] == 0 ? ", -1)" : wind[1] == 0 ? "(1, " : "(0.71, 0.71)";
      if (perturbation == 0)
      {
        EXPECT_NE(causes[0].text.find(direction), std::string::npos) << causes[0].text;
      }
      EXPECT_LT(causes[0].after, .3 * causes[0].before);
    }
}

TEST(Structure, all_zero_is_all_there_is_to_say)
{
  const auto causes = explained(times(weights_of("FA", nodes_for(3, 0, "linear-decay")), 0)).causes;
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].text, "all weights are zero");
}

TEST(Structure, no_cause_is_named_whose_removal_makes_the_moments_worse)
{
  // constants that are calibrated to exact second moments are right, whatever they are
  for (const std::string kernel : {"linear-decay", "constant", "bond-tensor"})
    for (const std::string rule : {"FA", "LAMMPS", "QWJ", "IPA-AC"})
    {
      const Weights own = weights_of(rule, nodes_for(3.0003, 0, kernel));
      const double ratio = check_moments(own.families, own.problem.kernel).mean_ratio;
      for (const double part : {1., .9})
        for (const Cause &cause : explained(times(own, 1 + part * (1 / ratio - 1))).causes)
          EXPECT_LT(cause.after, cause.before) << kernel << ", " << rule << ": " << cause.text;
      const auto causes = explained(times(own, 1 / ratio)).causes;
      for (const Cause &cause : causes)
        EXPECT_EQ(cause.name, "missing ramp") << kernel << ", " << rule << ": " << cause.text;
    }
  // weights with a kernel in them that are calibrated as well
  const Weights twice = changed(weights_of("FA", nodes_for(4, 0, "linear-decay")),
                                [](Bond<2> &bond, const Weights &w, std::size_t, std::size_t)
                                { bond.weight *= 1 - bond.xi.norm() / w.problem.horizon(); });
  const double ratio = check_moments(twice.families, twice.problem.kernel).mean_ratio;
  EXPECT_EQ(names(explained(times(twice, 1 / ratio)).causes), "");
}

TEST(Structure, bonds_as_long_as_the_horizon_may_be_left_out)
{
  const auto shorter = [](const Weights &weights)
  {
    return without(weights,
                   [&](std::size_t i, std::size_t j)
                   {
                     const auto &nodes = weights.problem.cells()->nodes;
                     return nodes[i].distance(nodes[j]) > weights.problem.horizon() * (1 - 1e-9);
                   });
  };
  for (const double m : {3., 4., 5.})
    for (const std::string kernel : {"linear-decay", "constant"})
    {
      const Weights weights = shorter(weights_of("FA", nodes_for(m, 0, kernel)));
      const auto rule = recognise(weights.given());
      ASSERT_TRUE(rule) << kernel << m;
      EXPECT_EQ(rule->rule, "FA");
      EXPECT_TRUE(find_outliers(weights.given(), rule).empty()) << kernel << m;
      EXPECT_TRUE(find_outliers(weights.given(), {}).empty()) << kernel << m;
      for (const Cause &cause : explained(weights).causes)
      {
        if (cause.name == "missing ramp")
          continue; // FA's own error
        EXPECT_EQ(cause.name, "bonds at the horizon") << kernel << m;
        EXPECT_EQ(kernel, "constant") << "the kernel is 0 there";
        EXPECT_TRUE(cause.is_own_error);
        EXPECT_LT(cause.after, cause.before);
      }
    }
}

TEST(Volumes, carry_a_factor_that_is_told_from_the_areas)
{
  for (const double perturbation : {0., .3})
    for (const double factor : {.002, .01, 1e6, 1550.0031})
    {
      Weights weights = weights_of("FA", nodes_for(3, perturbation, "linear-decay"));
      for (double &volume : weights.volumes)
        volume *= factor;
      const VolumeCheck<2> check = check_volumes(weights.given(), weights.problem.cells()->area);
      EXPECT_NEAR(check.factor, factor, 1e-9 * factor) << perturbation;
      EXPECT_TRUE(check.outliers.empty());
      for (std::size_t i = 0; i < check.mended.size(); ++i)
        EXPECT_NEAR(check.mended[i], weights.problem.cells()->area[i],
                    1e-9 * weights.problem.cells()->area[i]);
    }
  EXPECT_NE(unit_text(1e6).find("mm for m"), std::string::npos);
  EXPECT_NE(unit_text(1550.0031).find("inches for m"), std::string::npos);
  EXPECT_NE(unit_text(.01).find("a plate of thickness 0.01"), std::string::npos);
}

TEST(Volumes, of_bands_of_nodes_are_named_and_those_of_one_size_are_none)
{
  for (const double perturbation : {0., .3})
    for (const double factor : {1.2, .5})
    {
      Weights weights = weights_of("FA", nodes_for(3, perturbation, "linear-decay"));
      std::vector<std::size_t> band;
      for (std::size_t i = 0; i < weights.families.size(); ++i)
        if (std::abs(weights.problem.cells()->nodes[i][0] - .5) < .15) // a quarter
        {
          band.push_back(i);
          weights.volumes[i] *= factor;
        }
      ASSERT_GT(band.size(), weights.families.size() / 5);
      const VolumeCheck<2> check = check_volumes(weights.given(), weights.problem.cells()->area);
      EXPECT_EQ(check.factor, 1);
      ASSERT_EQ(check.outliers.size(), band.size()) << perturbation << ", " << factor;
      for (const Outlier<2> &one : check.outliers)
        EXPECT_NEAR(one.found / one.expected, factor, 1e-6);
    }
  // h² of nodes that are moved
  Weights weights = weights_of("FA", nodes_for(3, .3, "linear-decay"));
  for (double &volume : weights.volumes)
    volume = node_distance * node_distance;
  const VolumeCheck<2> check = check_volumes(weights.given(), weights.problem.cells()->area);
  EXPECT_TRUE(check.outliers.empty());
  EXPECT_EQ(check.factor, 1);
}

TEST(Volumes, and_weights_that_carry_one_factor_are_one_cause)
{
  const Weights sound = weights_of("FA", nodes_for(3, 0, "linear-decay"));
  Circumstances<2> circumstances;
  circumstances.volume_factor = .002;
  auto causes = explained(times(sound, .002), circumstances).causes;
  ASSERT_EQ(causes.size(), 1u) << names(causes);
  EXPECT_EQ(causes[0].text.find("the volumes are 0.002 times the areas of their cells"), 0u);
  EXPECT_NE(causes[0].text.find("and all weights carry the same factor; without that the moments "
                                "are off by 4.72 %"),
            std::string::npos)
      << causes[0].text;
  causes = explained(sound, circumstances).causes;
  ASSERT_EQ(causes.size(), 1u) << names(causes);
  EXPECT_NE(causes[0].text.find("the weights do not carry that factor"), std::string::npos);
}

TEST(Outliers, are_none_of_families_whose_moments_are_exact)
{
  // weights recalibrated around one node that is moved: right, and unlike all others
  const auto problem = nodes_for(3, 0, "linear-decay");
  problem::Problem<2> moved = problem;
  auto cells = std::make_shared<geometry::NodeCells<2>>(*problem.cells());
  cells->nodes[27] += dealii::Tensor<1, 2>({.02, -.015});
  moved.on_mesh()->cells = cells;
  const Weights exact = weights_of("IPA-AC-R2", moved);
  EXPECT_LT(check_moments(exact.families, moved.kernel).second.value, 1e-10);
  EXPECT_TRUE(find_outliers(exact.given(), {}).empty());
  // but one of them with a weight that is wrong is told
  Weights wrong = exact;
  const std::size_t k = some_bond(wrong, 28);
  wrong.families[28].bonds[k].weight *= 1.5;
  const auto found = find_outliers(wrong.given(), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 28u);
}
