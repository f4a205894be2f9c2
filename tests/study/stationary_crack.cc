#include "study/stationary_crack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using study::Limit;
  using study::Record;
  using study::Records;

  /// At levels whose tip energies are q, or in a field of K whose releases over K²/E' are.
  Records records(const std::string &method, const std::vector<double> &h,
                  const std::vector<double> &q, bool is_field = false)
  {
    Records result;
    for (std::size_t i = 0; i < h.size(); ++i)
    {
      Record record;
      record.key.method = method;
      record.key.series = "delta = 1";
      record.key.h = h[i];
      method::RiceStrip strip{8, 20, 10, h[i], {}};
      method::StripState state;
      state.intact = 1;
      state.opening = {2, 1};
      state.energy = q[i] + 10 * h[i];
      double release = 1;
      if (is_field)
      {
        strip.K_tip = 10.5;
        release = q[i] * (state.intact = .375);
      }
      result.push_back(study::strip_record(record, strip, state, release, {}));
    }
    return result;
  }

  /// Of all that a strip can yield.
  std::vector<Limit> limits_of(const Records &found)
  {
    return study::find_limits(found, {"W1", "tip energy", "G", "opening"});
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
  const auto limits = limits_of(records("A", sizes, q)); // W1 and opening do not move
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].quantity, "tip energy");
  EXPECT_NEAR(limits[0].value, .4, 1e-9);
  EXPECT_NEAR(limits[0].rate, 1.5, 1e-8);
  EXPECT_NEAR(limits[0].change, 0, 1e-9);
}

TEST(StripLimits, of_a_field_of_K_are_those_of_its_release)
{
  std::vector<double> q;
  for (const double h : sizes)
    q.push_back(curve(h));
  study::StudyResults results;
  results.records = records("A", sizes, q, true);
  const auto limits = limits_of(results.records);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].quantity, "G");
  EXPECT_NEAR(limits[0].value, .4, 1e-9);
  // no strip that is too short: .4 is what it gets
  EXPECT_TRUE(check_strip(results, {}).empty());
  for (Record &record : results.records) // as if it were between grips
  {
    record.set("W1", .375);
    record.set("G/W1 - 1", record["G"] - 1);
  }
  EXPECT_EQ(check_strip(results, {}).size(), sizes.size());
}

TEST(StripLimits, are_not_there_where_values_go_up_and_down)
{
  EXPECT_TRUE(limits_of(records("A", sizes, {.4, .5, .45, .47})).empty());
  EXPECT_TRUE(limits_of(records("A", {.5, .3}, {.5, .45})).empty());
}

TEST(StripLimits, agree_as_far_as_they_lie_apart)
{
  const auto limit = [](const std::string &method, const std::string &quantity, double value)
  { return Limit{method, "", quantity, value, 2, .01}; };
  Limit vague = limit("D", "tip energy", .5);
  vague.change = .03;
  const auto all =
      study::find_agreements({limit("A", "W1", 5), limit("A", "tip energy", .41),
                              limit("B", "tip energy", .43), limit("C", "tip energy", .42), vague});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].quantity, "tip energy");
  EXPECT_EQ(all[0].least, .41);
  EXPECT_EQ(all[0].largest, .43);
  EXPECT_EQ(all[0].n_methods, 3u);
}

namespace
{
  /// What does not hold where the scene expects this of method A alone.
  std::vector<study::Expectation> missed(const study::StudyResults &results,
                                         scene::ExpectedSection expected,
                                         const std::string &quantity,
                                         const std::vector<double> &values)
  {
    scene::Expected one;
    one.kind = scene::ExpectedKind::strip;
    one.method = "A";
    one.problem = quantity;
    one.values = values;
    expected.all = {one};
    auto all = study::check_strip(results, expected);
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const study::Expectation &given) { return given.holds; }),
              all.end());
    return all;
  }
} // namespace

TEST(StripExpectations, miss_what_is_not_as_expected)
{
  study::StudyResults results;
  results.records = records("A", sizes, {.7, .6, .55, .5});
  results.limits = limits_of(results.records);
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6;
  const auto expect = [&](const std::string &quantity, const std::vector<double> &values)
  { return missed(results, expected, quantity, values).size(); };
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .5}), 0u);
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .51}), 1u);
  EXPECT_EQ(expect("tip energy", {.7, .6}), 1u);              // there are more
  EXPECT_EQ(expect("tip energy", {.7, .6, .55, .5, .4}), 0u); // of a finer level
  EXPECT_EQ(expect("opening", {1, 1, 1, 1}), 0u);
  EXPECT_EQ(expect("W1", {1, 1, 1, 1}), 0u);
  EXPECT_EQ(expect("tip energy limit", {results.limits.front().value}), 0u);
  EXPECT_EQ(expect("nothing", {1}), 1u);
  results.records[1].set("G/W1 - 1", .02); // ends are too near
  EXPECT_EQ(expect("W1", {1, 1, 1, 1}), 1u);
  results.records[1] = {};
  results.records[1].key.method = "A";
  results.records[1].failure = "no weights";
  EXPECT_EQ(expect("W1", {1, 1, 1}), 1u);
}

TEST(StripExpectations, miss_rates_that_are_not_as_expected)
{
  std::vector<double> q;
  for (const double h : sizes)
    q.push_back(curve(h));
  study::StudyResults results;
  results.records = records("A", sizes, q);
  results.limits = limits_of(results.records);
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6; // which is not that of rates
  expected.rate_tolerance = .04;
  const auto faults = [&](const std::string &quantity, const std::vector<double> &values)
  { return missed(results, expected, quantity, values); };
  EXPECT_EQ(faults("tip energy rate", {1.5}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.53}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.47}).size(), 0u);
  EXPECT_EQ(faults("tip energy rate", {1.55}).size(), 1u); // a relative .04 would hold
  EXPECT_EQ(faults("tip energy rate", {1.45}).size(), 1u);
  const auto wrong = faults("tip energy rate", {2.2});
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong.front().found, "1.5");
  EXPECT_EQ(faults("W1 rate", {1.5}).size(), 1u); // it does not move
  EXPECT_EQ(faults("rate", {1.5}).size(), 1u);
}

TEST(StripExpectations, are_of_growth_where_a_rule_has_grown)
{
  study::StudyResults results;
  results.records = records("A", {.5, .25, .125}, {.7, .6, .55});
  scene::ExpectedSection expected;
  expected.error_tolerance = 1e-6;
  const auto expect = [&](const std::string &quantity, const std::vector<double> &values)
  { return missed(results, expected, quantity, values).size(); };
  EXPECT_EQ(expect("growth mean", {1.6, 1.35, 1.225}), 1u);
  for (Record &record : results.records) // as a power of h, all the same
  {
    const double h = record.key.h;
    method::StripState state;
    state.intact = 1;
    state.opening = {2, 1};
    record = study::strip_record(record, {8, 20, 10, h, {}}, state, 1,
                                 study::StripGrowth{1.2 + h, 1.1 + h, 1.05 + h, .9 - h});
  }
  EXPECT_EQ(expect("growth peak", {1.7, 1.45, 1.325}), 0u);
  EXPECT_EQ(expect("growth peak", {1.7, 1.45, 1.4}), 1u);
  EXPECT_EQ(expect("growth mean", {1.6, 1.35, 1.225}), 0u);
  EXPECT_EQ(expect("growth released", {1.55, 1.3, 1.175}), 0u);
  EXPECT_EQ(expect("growth bonds", {.4, .65, .775}), 0u);
}

TEST(StripRecords, have_what_is_known_of_edges_and_growth)
{
  const Record grips = records("A", {.5}, {.7}).front(); // W1 = G = 1, open by 1 at the tip
  EXPECT_NEAR(grips["tip energy"], .7, 1e-12);
  EXPECT_EQ(grips["W1"], 1);
  EXPECT_EQ(grips["G/W1 - 1"], 0);
  EXPECT_EQ(grips["opening"], 1);
  EXPECT_FALSE(grips.has("G"));
  EXPECT_FALSE(grips.has("growth peak"));
  const Record field = records("A", {.5}, {.7}, true).front();
  EXPECT_NEAR(field["G"], .7, 1e-12);
  EXPECT_EQ(field["K^2/E'"], .375);
  EXPECT_FALSE(field.has("W1"));
  EXPECT_FALSE(field.has("tip energy"));
  const analysis::Curve &opening = field.curves.at("opening");
  EXPECT_EQ(opening[1].values, (std::vector<double>{2, 1}));
  EXPECT_EQ(opening[0].values, (std::vector<double>{-.75, -.25})); // nodes at centres
}
