#include "study/standing_crack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using study::StripLimit;
  using study::StripRow;

  /// At levels whose tip energies are q.
  std::vector<StripRow> rows(const std::string &method, const std::vector<double> &h,
                             const std::vector<double> &q)
  {
    std::vector<StripRow> result;
    for (std::size_t i = 0; i < h.size(); ++i)
    {
      StripRow row;
      row.method = method;
      row.series = "delta = 1";
      row.h = h[i];
      row.strip = {8, 20, 10, h[i]};
      row.state.intact = row.release = 1;
      row.state.opening = {2, 1};
      row.state.energy = q[i] + 10 * h[i];
      result.push_back(row);
    }
    return result;
  }

  const std::vector<double> sizes = {.5, .3, .2, .1};

  double curve(double h)
  {
    return .4 + .7 * std::pow(h, 1.5);
  }
} // namespace

TEST(StripLimits, are_those_of_a_power_of_h)
{
  std::vector<double> q;
  for (const double h : sizes)
    q.push_back(curve(h));
  const auto limits = strip_limits({}, rows("A", sizes, q)); // W1 and opening do not move
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].quantity, "tip energy");
  EXPECT_NEAR(limits[0].limit, .4, 1e-9);
  EXPECT_NEAR(limits[0].rate, 1.5, 1e-8);
  EXPECT_NEAR(limits[0].change, 0, 1e-9);
}

TEST(StripLimits, of_a_field_of_K_are_those_of_its_release)
{
  std::vector<double> q;
  for (const double h : sizes)
    q.push_back(curve(h));
  std::vector<StripRow> field = rows("A", sizes, q);
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    field[i].strip.K_tip = 10.5;
    field[i].release = q[i] * (field[i].state.intact = .375);
  }
  scene::StripSection constrained;
  constrained.edges = scene::StripEdges::K_field;
  const auto limits = strip_limits(constrained, field);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].quantity, "G");
  EXPECT_NEAR(limits[0].limit, .4, 1e-9);
  // no strip that is too short: .4 is what it gets
  study::StripResults results;
  results.strip = constrained;
  results.rows = field;
  EXPECT_TRUE(strip_faults(results, {}).empty());
  for (StripRow &row : results.rows)
    row.strip.K_tip = {};
  EXPECT_EQ(strip_faults(results, {}).size(), sizes.size());
}

TEST(StripLimits, are_not_there_where_values_go_up_and_down)
{
  EXPECT_TRUE(strip_limits({}, rows("A", sizes, {.4, .5, .45, .47})).empty());
  EXPECT_TRUE(strip_limits({}, rows("A", {.5, .3}, {.5, .45})).empty());
}

TEST(StripLimits, agree_as_far_as_they_lie_apart)
{
  const auto limit = [](const std::string &method, const std::string &quantity, double value)
  { return StripLimit{method, "", quantity, method::MethodFamily::meshfree, value, 2, .01}; };
  StripLimit vague = limit("D", "tip energy", .5);
  vague.change = .03;
  const auto all = study::strip_agreements({limit("A", "W1", 5), limit("A", "tip energy", .41),
                                            limit("B", "tip energy", .43),
                                            limit("C", "tip energy", .42), vague});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].quantity, "tip energy");
  EXPECT_EQ(all[0].least, .41);
  EXPECT_EQ(all[0].largest, .43);
  EXPECT_EQ(all[0].n_methods, 3u);
}

namespace
{
  /// Where the scene expects this of method A alone.
  auto faults_of(const study::StripResults &results, scene::ExpectedSection expected,
                 const std::string &quantity, const std::vector<double> &values)
  {
    scene::Expected one;
    one.kind = scene::ExpectedKind::strip;
    one.method = "A";
    one.problem = quantity;
    one.values = values;
    expected.all = {one};
    return study::strip_faults(results, expected);
  }
} // namespace

TEST(StripFaults, are_what_is_not_as_expected)
{
  study::StripResults results;
  results.rows = rows("A", sizes, {.7, .6, .55, .5});
  results.limits = strip_limits({}, results.rows);
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6;
  const auto expect = [&](const std::string &quantity, const std::vector<double> &values)
  { return faults_of(results, expected, quantity, values).size(); };
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .5}), 0u);
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .51}), 1u);
  EXPECT_EQ(expect("tip energy", {.7, .6}), 1u);              // there are more
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .5, .4}), 0u); // of a finer level
  EXPECT_EQ(expect("opening", {1, 1, 1, 1}), 0u);
  EXPECT_EQ(expect("W1", {1, 1, 1, 1}), 0u);
  EXPECT_EQ(expect("tip energy limit", {results.limits.front().limit}), 0u);
  EXPECT_EQ(expect("nothing", {1}), 1u);
  results.rows[1].release = 1.02; // ends are too near
  EXPECT_EQ(expect("W1", {1, 1, 1, 1}), 1u);
  results.rows[1].failure = "no weights";
  EXPECT_EQ(expect("W1", {1, 1, 1}), 1u);
}

TEST(StripFaults, are_rates_that_are_not_as_expected)
{
  std::vector<double> q;
  for (const double h : sizes)
    q.push_back(curve(h));
  study::StripResults results;
  results.rows = rows("A", sizes, q);
  results.limits = strip_limits({}, results.rows);
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6; // which is not that of rates
  expected.rate_tolerance = .04;
  const auto faults = [&](const std::string &quantity, const std::vector<double> &values)
  { return faults_of(results, expected, quantity, values); };
  EXPECT_EQ(faults("tip energy rate", {1.5}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.53}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.47}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.55}).size(), 1u); // a relative .04 would hold
  EXPECT_EQ(faults("tip energy rate", {1.45}).size(), 1u);
  const auto wrong = faults("tip energy rate", {2.2});
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NE(wrong.front().find("number 1 is 1.5"), std::string::npos) << wrong.front();
  EXPECT_EQ(faults("W1 rate", {1.5}).size(), 1u); // it does not move
  EXPECT_EQ(faults("rate", {1.5}).size(), 1u);
}

TEST(StripFaults, are_of_growth_where_a_rule_has_grown)
{
  study::StripResults results;
  results.strip.n_growth = 4;
  results.rows = rows("A", {.5, .25, .125}, {.7, .6, .55});
  for (const StripRow &row : results.rows)
    EXPECT_TRUE(std::isnan(row.quantity("growth peak")));
  for (StripRow &row : results.rows) // as a power of h, all the same
    row.growth = study::StripGrowth{1.2 + row.h, 1.1 + row.h, 1.05 + row.h, .9 - row.h};
  results.limits = strip_limits(results.strip, results.rows);
  for (const StripLimit &limit : results.limits) // what lattices trap has none
    EXPECT_EQ(limit.quantity.find("growth"), std::string::npos);
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6;
  const auto expect = [&](const std::string &quantity, const std::vector<double> &values)
  { return faults_of(results, expected, quantity, values).size(); };
  EXPECT_EQ(expect("growth peak", {1.7, 1.45, 1.325}), 0u);
  EXPECT_EQ(expect("growth peak", {1.7, 1.45, 1.4}), 1u);
  EXPECT_EQ(expect("growth mean", {1.6, 1.35, 1.225}), 0u);
  EXPECT_EQ(expect("growth released", {1.55, 1.3, 1.175}), 0u);
  EXPECT_EQ(expect("growth bonds", {.4, .65, .775}), 0u);
  results.strip.n_growth = 0;
  EXPECT_EQ(expect("growth mean", {1.6, 1.35, 1.225}), 1u);
}

TEST(StripQuantities, are_those_of_edges_and_growth)
{
  using Names = std::vector<std::string>;
  scene::StripSection strip;
  EXPECT_EQ(study::strip_quantities(strip), Names({"W1", "tip energy", "opening"}));
  strip.n_growth = 4;
  EXPECT_EQ(study::strip_quantities(strip),
            Names({"W1", "tip energy", "opening", "growth peak", "growth mean", "growth released",
                   "growth bonds"}));
  strip.n_growth = 0;
  strip.edges = scene::StripEdges::K_field;
  EXPECT_EQ(study::strip_quantities(strip), Names({"G", "opening"}));
  const StripRow row = rows("A", {.5}, {.7}).front(); // W1 = G = 1, open by 1 at the tip
  EXPECT_NEAR(row.quantity("tip energy"), .7, 1e-12);
  EXPECT_EQ(row.quantity("W1"), 1);
  EXPECT_EQ(row.quantity("G"), 1);
  EXPECT_EQ(row.quantity("opening"), 1);
  EXPECT_TRUE(std::isnan(row.quantity("openings")));
}
