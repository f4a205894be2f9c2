// What the smallest model leaves out is not missed: the full one yields the same numbers.
#include "analysis/statics.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using analysis::Solution;
  using geometry::Point;

  using Settings = std::vector<scene::Override>;

  Solution solve(const std::string &model, Settings settings, const std::string &name)
  {
    const Settings common = {{"Solver/tolerance", "1e-13"}, {"Geometry/checks", "0"}};
    settings.insert(settings.end(), common.begin(), common.end());
    const auto scene = scene::parse_scene("test.prm", scene::scene_template(model), settings);
    for (const auto &methods : {reference::methods(), meshfree::methods()})
      for (const auto &method : methods)
        if (method->name() == name)
          return analysis::solve(*method, make_problem(scene, 0, scene.study.series[0].levels[0]));
    throw std::logic_error(name);
  }

  /// Largest difference of what stands at the same places, relative to the largest value.
  double difference(const std::vector<Point<2>> &places, const std::vector<double> &a,
                    const std::vector<Point<2>> &other_places, const std::vector<double> &b)
  {
    if (places.empty() || places.size() != other_places.size() || a.size() != b.size())
      return 1;
    const std::size_t nc = a.size() / places.size();
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const auto same =
          std::min_element(other_places.begin(), other_places.end(),
                           [&](const Point<2> &p, const Point<2> &q)
                           { return p.distance_square(places[i]) < q.distance_square(places[i]); });
      for (std::size_t c = 0; c < nc; ++c)
      {
        const double value = b[nc * (same - other_places.begin()) + c];
        worst = std::max(worst, std::abs(a[nc * i + c] - value));
        largest = std::max(largest, std::abs(value));
      }
    }
    return worst / largest;
  }

  /// Of nodal values by both models.
  double difference(const std::string &model, const Settings &settings, const std::string &name,
                    const std::string &outer_tolerance = "1e-4")
  {
    Settings full = settings;
    full.push_back({"Solver/model", "full"});
    full.push_back({"Quadrature/tolerance", outer_tolerance});
    const Solution small = solve(model, settings, name), whole = solve(model, full, name);
    EXPECT_NE(small.diagnostics.operator_backend.substr(0, 6), "sparse");
    EXPECT_EQ(whole.diagnostics.operator_backend.substr(0, 6), "sparse");
    return difference(small.nodes, small.nodal, whole.nodes, whole.nodal);
  }

  constexpr double round_off = 1e-11;
  const Settings ratio_2 = {{"Study/h", "0.125"}, {"Study/m", "2"}};
} // namespace

TEST(FullModel, yields_the_same_nodal_values_for_bonds)
{
  for (const std::string model : {"scalar", "tensor"})
    for (const std::string name : {"FA", "IPA-AC", "IPA-AC-R2", "Q1", "DGQ0"})
      EXPECT_LT(difference(model, ratio_2, name), round_off) << model << name;
}

TEST(FullModel, yields_the_same_nodal_values_where_the_dilatation_drops_out)
{
  Settings equal = ratio_2;
  equal.push_back({"Material/nu", "0.25"});
  for (const std::string name : {"FA", "IPA-AC-R2", "Q1"})
    EXPECT_LT(difference("LPS", equal, name), round_off) << name;
}

TEST(FullModel, yields_the_same_nodal_values_with_a_dilatation)
{
  for (const std::string name : {"FA", "IPA-AC-R2", "OPT"})
    EXPECT_LT(difference("LPS", ratio_2, name), round_off) << name;
  // to the error of the outer quadrature: by the first rule, and refined once
  Settings wave = ratio_2; // nodal values of cubic fields are exact by any rule
  wave.push_back({"Problem/solution", "x^3 - y^2*x, sin(x + 2*y)"});
  const double first = difference("LPS", wave, "Q1", "0"),
               second = difference("LPS", wave, "Q1", "0.9");
  EXPECT_LT(first, 2e-5);
  EXPECT_LT(second, first / 4);
}

TEST(FullModel, of_a_free_body_is_that_of_its_vertices_too)
{
  const Settings bar = {{"Domain/boxes", "0, 0 : 1, 0.5"},
                        {"Study/h", "0.05"},
                        {"Problem/load", "100*(x > 0.8 - 1e-9), 0"},
                        {"Quadrature/tolerance", "0"}};
  Settings full = bar;
  full.push_back({"Solver/model", "full"});
  for (const std::string name : {"PA-AC", "DGQ0"})
  {
    const Solution small = solve("variational", bar, name),
                   whole = solve("variational", full, name);
    EXPECT_LT(difference(small.nodes, small.nodal, whole.nodes, whole.nodal), round_off) << name;
  }
}
