// Consistency and stability: what the exact solution leaves of a rule's equations, in what order it
// falls, and the nodal error that follows from it.
#include "study/truncation.h"

#include "scene/problem.h"
#include "study/solution_record.h"
#include "study/trend.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using in_space::Settings;

  StudyResults results_of(const Settings &more)
  {
    Settings settings = {{"Kernel/type", "linear-decay"},
                         {"Kernel/limit", "-1/2 Laplace"},
                         {"Problem/solution", "sin(3*x)*cos(2*y)"},
                         {"Study/regime", "delta"},
                         {"Study/m", "3"},
                         {"Study/h", "0.1, 0.05, 0.025, 0.0125"},
                         {"Study/norms", "nodal Linf, truncation Linf, truncation L2"},
                         {"Study/decisive error", "truncation Linf | exact"}};
    settings.insert(settings.end(), more.begin(), more.end());
    return in_space::run(scene::parse_scene("test.prm", "", settings));
  }

  const Trend &trend_of(const StudyResults &results, const std::string &method,
                        const std::string &error = "truncation Linf | exact")
  {
    return *std::find_if(results.trends.begin(), results.trends.end(),
                         [&](const Trend &one)
                         { return one.method == method && one.error == error; });
  }

  std::string message_of(const Settings &settings)
  {
    try
    {
      (void)results_of(settings);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

// Yang & Yin, sections 4.2.2 and 5.1: at a fixed m the error in the second moments stays, which
// IPA-AC has; corrected to degree 2 what is left is of order h^2, to degree 4 of order h^4.
TEST(Truncation, falls_at_a_fixed_ratio_for_compatible_rules_alone)
{
  const StudyResults results =
      results_of({{"Methods/names", "FA, PA-AC, IPA-AC, IPA-AC-R2, IPA-AC-R4"}});
  for (const std::string name : {"FA", "PA-AC", "IPA-AC"})
  {
    EXPECT_EQ(trend_of(results, name).outcome, Outcome::stalls) << name;
    EXPECT_EQ(trend_of(results, name, "truncation L2 | exact").outcome, Outcome::stalls) << name;
  }
  for (const auto &[name, order] : {std::pair("IPA-AC-R2", 2.), {"IPA-AC-R4", 4.}})
  {
    EXPECT_EQ(trend_of(results, name).outcome, Outcome::converges) << name;
    EXPECT_NEAR(trend_of(results, name).rate, order, .1) << name;
    EXPECT_NEAR(trend_of(results, name, "truncation L2 | exact").rate, order, .1) << name;
  }
}

// Ibid., lemma 4.3: O(h^2/delta^2) at a fixed horizon.
TEST(Truncation, of_ipa_ac_is_of_order_two_at_a_fixed_horizon)
{
  const StudyResults results =
      results_of({{"Methods/names", "IPA-AC"}, {"Study/regime", "m"}, {"Study/horizon", "0.4"}});
  EXPECT_EQ(trend_of(results, "IPA-AC").outcome, Outcome::converges);
  EXPECT_NEAR(trend_of(results, "IPA-AC").rate, 2, .3);
}

// A quadratic has a truncation error that is the same at all nodes, and so its error is that times
// Poisson's torsion function, whose maximum on the unit square is .0736713 (of -Laplace e = 1).
TEST(Truncation, and_the_inverse_give_the_nodal_error)
{
  constexpr double torsion = 2 * .0736713; // of -1/2 Laplace
  const StudyResults results =
      results_of({{"Methods/names", "FA, IPA-AC-R2"}, {"Problem/solution", "x^2 + y^2"}});
  for (const Record &record : results.records)
  {
    const double tau = record["truncation Linf | exact"], error = record["nodal Linf | exact"];
    EXPECT_NEAR(record["largest load"], 2, 1e-9); // -1/2 Laplace of it
    EXPECT_NEAR(record["truncation L2 | exact"], tau, record["truncation round-off"] + 1e-9 * tau);
    if (record.key.method == "IPA-AC-R2")
    {
      EXPECT_LT(tau, record["truncation round-off"]);
      EXPECT_LT(record["truncation round-off"], 1e-10);
      continue;
    }
    EXPECT_GT(tau, .05); // FA's second moments at m = 3
    // lemma 4.2: ‖A⁻¹‖ <= a²/∫C ξ_1², a half the width and the horizon
    const double a = .5 + record.key.horizon;
    EXPECT_LT(error, a * a * tau);
    if (record.key.level == 3)
    {
      EXPECT_NEAR(error, torsion * tau, .15 * torsion * tau);
    }
  }
}

// Yang & Yin, (4.5): the error is at most the norm of the inverse times the truncation error. Where
// that is the same at all nodes, as of a quadratic, it is as large: ‖A⁻¹‖ of an M-matrix is the
// largest value of A⁻¹ 1. In L2 the bound is with the smallest eigenvalue, and the lowest mode of
// the square alone has 8/pi^2 = .81 of the norm of 1.
TEST(Truncation, times_the_norm_of_the_inverse_bounds_the_error)
{
  const Settings norms = {{"Study/norms", "nodal Linf, nodal L2, bound Linf, bound L2"},
                          {"Study/decisive error", "bound Linf | exact"},
                          {"Methods/names", "FA, IPA-AC, IPA-AC-R2"},
                          {"Study/h", "0.1, 0.05, 0.025"}};
  Settings quadratic = norms, at_vertices = norms;
  quadratic.push_back({"Problem/solution", "x^2 + y^2"});
  at_vertices.push_back({"Problem/solution", "x^2 + y^2"});
  at_vertices.push_back({"Methods/nodes", "vertices"}); // fewer nodes than cells
  for (const auto &[settings, is_quadratic] :
       {std::pair(norms, false), {quadratic, true}, {at_vertices, true}})
    for (const Record &record : results_of(settings).records)
    {
      const double bound = record["bound Linf | exact"], error = record["nodal Linf | exact"],
                   l2_bound = record["bound L2 | exact"], l2 = record["nodal L2 | exact"];
      EXPECT_EQ(record["inverse norm is exact"], 1); // weights >= 0
      EXPECT_FALSE(record.has("truncation Linf | exact"));
      if (is_quadratic && record.key.method == "IPA-AC-R2")
      {
        EXPECT_LT(bound, round_off_of(record, "bound Linf | exact"));
        EXPECT_LT(l2_bound, round_off_of(record, "bound L2 | exact"));
        continue;
      }
      EXPECT_GT(bound, error * (1 - 1e-8)) << record.key.label();
      EXPECT_GT(l2_bound, l2 * (1 - 1e-8)) << record.key.label();
      if (is_quadratic)
      {
        EXPECT_NEAR(bound, error, 1e-7 * error) << record.key.label();
        EXPECT_GT(l2, .81 * l2_bound) << record.key.label();
      }
    }
}

// Ibid., theorem 4.1: at a fixed horizon the bound of IPA-AC falls as the error does.
TEST(Truncation, bounds_of_ipa_ac_are_of_order_two_at_a_fixed_horizon)
{
  const StudyResults results = results_of({{"Methods/names", "IPA-AC"},
                                           {"Study/regime", "m"},
                                           {"Study/horizon", "0.4"},
                                           {"Study/h", "0.2, 0.1, 0.05, 0.025"},
                                           {"Study/norms", "nodal Linf, bound Linf"},
                                           {"Study/decisive error", "bound Linf | exact"}});
  EXPECT_EQ(trend_of(results, "IPA-AC", "bound Linf | exact").outcome, Outcome::converges);
  EXPECT_NEAR(trend_of(results, "IPA-AC", "bound Linf | exact").rate, 2, .3);
  for (const Record &record : results.records)
    EXPECT_LT(record["bound Linf | exact"], 4 * record["nodal Linf | exact"]) << record.key.h;
}

// The load of a linear field is round-off, and so is its truncation error.
TEST(Truncation, of_fields_without_a_load_is_round_off)
{
  const StudyResults results =
      results_of({{"Methods/names", "FA"}, {"Problem/solution", "x"}, {"Study/h", "0.1"}});
  const Record &record = results.records.front();
  EXPECT_LE(record["truncation Linf | exact"], record["truncation round-off"]);
  EXPECT_GT(record["largest load"], 1);
}

// Not to the solution, which has another unit.
TEST(Truncation, is_relative_to_the_load)
{
  const StudyResults results = results_of({{"Methods/names", "FA"}, {"Domain/boxes", "0,0 : 2,2"}});
  const Record &record = results.records.front();
  const std::string largest = "truncation Linf | exact", l2 = "truncation L2 | exact";
  EXPECT_NE(record["largest load"], record["variation"]);
  EXPECT_EQ(size_of(record, largest), record["largest load"]);
  EXPECT_NEAR(size_of(record, l2), 2 * record["largest load"], 1e-12); // the root of the area is 2
  EXPECT_EQ(round_off_of(record, largest), record["truncation round-off"]);
  EXPECT_EQ(size_of(record, "nodal Linf | exact"), record["variation"]);
}

// Pflug, Stingl & Zetzmann 2026, proposition 3.17: at a fixed horizon one-point rules tend to L u
// in L2, here at the nodes, from whose averages L u differs by O(h).
TEST(Truncation, of_one_point_rules_tends_to_zero_at_a_fixed_horizon)
{
  const StudyResults results = results_of({{"Methods/names", "FA, PA-AC"},
                                           {"Study/regime", "m"},
                                           {"Study/horizon", "0.4"},
                                           {"Study/h", "0.2, 0.1, 0.05"}});
  for (const std::string name : {"FA", "PA-AC"})
  {
    const Trend &trend = trend_of(results, name, "truncation L2 | exact");
    EXPECT_LT(trend.values.back(), .1 * trend.values.front()) << name;
    EXPECT_GT(fit_slope(trend.x, trend.values).value, 1.5) << name;
  }
}

TEST(Truncation, is_found_in_space_too)
{
  const StudyResults results = in_space::run(in_space::make_scene(
      {{"Kernel/type", "linear-decay"},
       {"Kernel/limit", "-1/2 Laplace"},
       {"Problem/solution", "x^2 + y*z"},
       {"Methods/names", "FA, IPA-AC-R2, Q1"},
       {"Study/regime", "delta"},
       {"Study/m", "2"},
       {"Study/h", "1/4, 1/8"},
       {"Study/norms", "nodal Linf, averages L2, truncation Linf, truncation L2, bound Linf"}}));
  // FA's second moment over the ball's, which is 1: ∫ c (1 - r/δ) ξ_1² = 4π c δ^5 / 90
  double moment = 0;
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i)
        moment += std::max(0., 1 - std::sqrt(i * i + j * j + k * k) / 2) * i * i;
  moment *= 90 / (4 * M_PI * 32);
  for (const Record &record : results.records)
  {
    ASSERT_EQ(record.has("truncation Linf | exact"), record.key.method != "Q1");
    if (record.key.method == "FA")
    {
      EXPECT_NEAR(record["truncation Linf | exact"], 1 - moment, 1e-9);
      EXPECT_NEAR(record["bound Linf | exact"], record["nodal Linf | exact"],
                  1e-7 * record["nodal Linf | exact"]); // it is the same at all nodes
    }
    if (record.key.method == "IPA-AC-R2")
    {
      EXPECT_LT(record["truncation Linf | exact"], record["truncation round-off"]);
    }
  }
}

TEST(Truncation, is_of_known_solutions_and_equations_at_nodes)
{
  const auto expect = [](const Settings &settings, const std::string &words)
  { EXPECT_NE(message_of(settings).find(words), std::string::npos) << message_of(settings); };
  expect({{"Methods/names", "FA, Q1"}},
         "is defined for meshfree rules, whose equations hold at nodes");
  expect({{"Methods/names", "FA"},
          {"Reference/method", "Q2"},
          {"Study/decisive error", "truncation L2 | reference"}},
         "use the target exact or local");
  const Settings::value_type bounds = {"Study/norms", "bound Linf"};
  expect({{"Methods/names", "FA, Q1"}, bounds, {"Study/decisive error", "bound Linf | exact"}},
         "is defined for meshfree rules");
  expect({{"Methods/names", "FA"},
          {"Reference/method", "Q2"},
          bounds,
          {"Study/decisive error", "bound Linf | reference"}},
         "use the target exact or local");
}
