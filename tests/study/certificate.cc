// Certificates: two ways that agree, and ways that are broken; values by fits to nodes; limits by
// Richardson's extrapolation; grades of given values.
#include "study/certificate.h"
#include "base/error.h"
#include "meshfree/method.h"
#include "method/discretisation.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/grade.h"
#include "study/grid_convergence.h"
#include "study/nodal_fit.h"
#include "study/preflight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <list>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using dealii::Point;
  using Points = std::vector<Point<2>>;

  scene::Scene make_scene(const std::vector<scene::Override> &more = {})
  {
    std::vector<scene::Override> settings = {
        {"Geometry/checks", "0"},     {"Kernel/type", "constant"},
        {"Study/regime", "m"},        {"Study/horizon", "0.25"},
        {"Study/h", "1/8,1/16,1/32"}, {"Problem/solution", "sin(3*x)*cos(2*y)"},
        {"Methods/names", "PA-AC"},   {"Reference/method", "Q2"},
        {"Output/points", "at.csv"}};
    settings.insert(settings.end(), more.begin(), more.end());
    return scene::parse_scene("test.prm", "", settings);
  }

  Points some_points(const problem::Problem<2> &)
  {
    return {{.1, .2}, {.3, .7}, {.5, .5}, {.91, .33}};
  }

  /// Discretises and solves other problems than it is given.
  class Broken : public method::Method
  {
  public:
    using Change = std::function<void(problem::Problem<2> &)>;

    Broken(const std::string &name, Change change)
        : rule_(find_method(meshfree::methods(), name, "test")), change_(std::move(change))
    {
    }

    std::string name() const override { return rule_->name(); }
    method::MethodFamily family() const override { return rule_->family(); }
    std::string help() const override { return "broken"; }

    std::unique_ptr<method::Discretisation>
    discretise(const problem::Problem<2> &problem,
               const base::Communicator &communicator) const override
    {
      return std::make_unique<BrokenDiscretisation>(*this, problem, communicator);
    }

  private:
    const problem::Problem<2> &changed(const problem::Problem<2> &problem) const
    {
      problems_.push_back(problem);
      change_(problems_.back());
      return problems_.back();
    }

    class BrokenDiscretisation : public method::Discretisation
    {
    public:
      BrokenDiscretisation(const Broken &method, const problem::Problem<2> &problem,
                           const base::Communicator &communicator)
          : method_(method), right_(method.rule_->discretise(method.changed(problem), communicator))
      {
      }
      std::size_t n_unknowns() const override { return right_->n_unknowns(); }
      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        return right_->data(method_.changed(problem));
      }
      std::unique_ptr<algebra::LinearSystem> tangent() const override { return right_->tangent(); }
      method::DiscreteOperator matrix() const override { return right_->matrix(); }
      method::Diagnostics diagnostics() const override { return right_->diagnostics(); }

    private:
      const Broken &method_;
      std::unique_ptr<method::Discretisation> right_;
    };

    std::shared_ptr<const method::Method> rule_;
    Change change_;
    mutable std::list<problem::Problem<2>> problems_; ///< that discretisations refer to
  };

  void scale_load(problem::Problem<2> &problem, double factor)
  {
    problem.load.value = [value = problem.load.value, factor](const Point<2> &x, unsigned int c)
    { return factor * value(x, c); };
    problem.load.series.reset();
    problem.load.fast = {};
  }

  Certificate certify_by(const method::Method &rule, const scene::Scene &scene = make_scene())
  {
    const std::shared_ptr<const method::Method> not_owned(std::shared_ptr<void>(), &rule);
    return certify(scene, *find_method(reference::methods(), "Q2", "test"), {not_owned}, 2,
                   some_points);
  }

  /// Of a certificate with known values.
  Certificate certificate_of(const std::vector<double> &values, double bound)
  {
    Certificate certificate;
    for (const double value : values)
    {
      CertifiedValue one;
      one.x = {static_cast<double>(certificate.points.size()), 0};
      one.value = one.other = {value};
      one.bound = bound;
      certificate.points.push_back(one);
    }
    certificate.size = root_mean_square(values);
    return certificate;
  }
} // namespace

TEST(Certificate, holds_values_on_which_both_ways_agree_within_their_bounds)
{
  const auto rule = find_method(meshfree::methods(), "PA-AC", "test");
  const Certificate found = certify_by(*rule);
  EXPECT_TRUE(found.refused().empty());
  ASSERT_EQ(found.points.size(), 4u);
  for (const CertifiedValue &one : found.points)
  {
    const double exact = std::sin(3 * one.x[0]) * std::cos(2 * one.x[1]);
    EXPECT_EQ(one.exact, std::vector<double>{exact});
    EXPECT_LE(std::abs(one.value[0] - exact), one.bound);
    EXPECT_LE(std::abs(one.other[0] - exact), one.other_bound);
    EXPECT_GT(one.bound, 0);
    EXPECT_LT(one.bound, 1e-4);
    EXPECT_LT(one.other_bound, .05);
    EXPECT_EQ(one.digits, std::floor(-std::log10(one.bound / found.size)));
  }
  // ∫ sin 3x dx · ∫ cos 2y dy
  ASSERT_TRUE(found.mean);
  const double mean = (1 - std::cos(3.)) / 3 * std::sin(2.) / 2;
  EXPECT_LE(std::abs(found.mean->value[0] - mean), found.mean->bound);
  EXPECT_LE(std::abs(found.mean->other[0] - mean), found.mean->other_bound);
  EXPECT_LT(found.mean->bound, 1e-5);
  EXPECT_EQ(found.meshfree.h, (std::vector<double>{1. / 8, 1. / 16, 1. / 32}));
  EXPECT_LE(found.meshfree.order, 2);
  EXPECT_GT(found.meshfree.error, 0);
}

TEST(Certificate, is_refused_if_one_way_is_broken)
{
  const Broken right("PA-AC", [](auto &) {});
  EXPECT_TRUE(certify_by(right).refused().empty());
  const Broken of_wrong_load("PA-AC", [](auto &problem) { scale_load(problem, 1.05); });
  EXPECT_EQ(certify_by(of_wrong_load).refused().size(), 5u); // the mean, too
  const scene::Scene shorter = make_scene({{"Study/horizon", "0.2"}});
  const Broken of_wrong_horizon("PA-AC",
                                [&](auto &problem) { problem.kernel = make_kernel(shorter, .2); });
  EXPECT_FALSE(certify_by(of_wrong_horizon).refused().empty());
  const scene::Scene other = make_scene({{"Kernel/limit", "-Laplace"}});
  const Broken of_twice_the_diffusion("PA-AC", [&](auto &problem)
                                      { problem.kernel = make_kernel(other, .25); });
  EXPECT_FALSE(certify_by(of_twice_the_diffusion).refused().empty());
}

TEST(Certificate, is_refused_if_changes_do_not_fall_so_that_there_is_no_bound)
{
  // the second change is the larger one
  const Broken erratic("PA-AC",
                       [](auto &problem) {
                         scale_load(problem, problem.h > .1 ? 1 : problem.h > .05 ? 1.5 : 3);
                       });
  const Certificate found = certify_by(erratic);
  EXPECT_EQ(found.refused().size(), 5u);
  for (const CertifiedValue &one : found.points)
    EXPECT_FALSE(one.has_bounds());
  EXPECT_TRUE(std::isnan(found.meshfree.order));
}

TEST(Certificate, is_refused_if_the_known_solution_contradicts_it)
{
  Certificate found = certificate_of({1, 2}, 1e-3);
  EXPECT_TRUE(found.refused().empty());
  found.points[1].exact = {2.002};
  ASSERT_EQ(found.refused().size(), 1u);
  EXPECT_EQ(found.refused()[0], &found.points[1]);
  found.points[1].exact = {2.0005};
  EXPECT_TRUE(found.refused().empty());
  found.points[0].other = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(found.refused().size(), 1u);
}

TEST(Certificate, needs_a_scene_of_one_problem_with_points_and_a_reference)
{
  const auto expect_refused =
      [](const std::vector<scene::Override> &settings, const std::string &part)
  {
    try
    {
      check_certifiable(make_scene(settings));
      ADD_FAILURE() << part;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  EXPECT_NO_THROW(check_certifiable(make_scene()));
  expect_refused({{"Output/points", ""}}, "Output/points is empty");
  expect_refused({{"Reference/method", "none"}}, "Reference/method = none");
  expect_refused({{"Reference/estimate", "none"}}, "Reference/estimate = none");
  expect_refused({{"Problem/solution", "a: x; b: y"}}, "2 cases");
  expect_refused({{"Study/horizon", "0.25, 0.2"}}, "Study/regime must be m");
  expect_refused({{"Study/h", "1/8,1/16"}}, "Study/h has 2 mesh sizes");
}

TEST(NodalFit, has_cubics_exactly_and_beside_corners_too)
{
  const auto cubic = [](const Point<2> &x)
  { return 1 + x[0] - 2 * x[1] + x[0] * x[1] * x[1] + 3 * std::pow(x[0], 3) - x[1] * x[1]; };
  Points nodes;
  std::vector<double> nodal;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i)
    {
      nodes.emplace_back(.05 + .1 * i, .05 + .1 * j);
      nodal.push_back(cubic(nodes.back()));
      nodal.push_back(-nodal.back());
    }
  const Points points = {{.5, .5}, {.33, .71}, {0, 0}, {1, .02}, {.35, .45}};
  const std::vector<double> values = values_by_fit(points, nodes, nodal, 2);
  ASSERT_EQ(values.size(), 2 * points.size());
  for (unsigned int i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(values[2 * i], cubic(points[i]), 1e-11) << points[i];
    EXPECT_NEAR(values[2 * i + 1], -cubic(points[i]), 1e-11) << points[i];
  }
  nodal[0] = 1e3; // a point on a node has its value whatever its neighbours have
  EXPECT_DOUBLE_EQ(values_by_fit({nodes[0]}, nodes, nodal, 2)[0], 1e3);
  EXPECT_TRUE(std::isnan(values_by_fit(points, {nodes.begin(), nodes.begin() + 9}, nodal, 2)[0]));
}

TEST(NodalFit, has_cubics_in_space)
{
  const auto cubic = [](const Point<3> &x)
  { return 1 + x[0] - 2 * x[1] * x[2] + x[0] * x[1] * x[2] + std::pow(x[2], 3) - x[1] * x[1]; };
  std::vector<Point<3>> nodes;
  std::vector<double> nodal;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i)
      {
        nodes.emplace_back(.1 * i, .1 * j, .1 * k);
        nodal.push_back(cubic(nodes.back()));
      }
  const std::vector<Point<3>> points = {{.22, .31, .13}, {.5, .01, .44}, {.25, .25, .25}};
  const std::vector<double> values = values_by_fit(points, nodes, nodal, 1);
  for (unsigned int i = 0; i < points.size(); ++i)
    EXPECT_NEAR(values[i], cubic(points[i]), 1e-11) << points[i];
}

TEST(Certificate, in_space_has_bounds_that_hold)
{
  const scene::Scene scene = scene::parse_scene("test.prm", "",
                                                {{"Domain/dimension", "3"},
                                                 {"Domain/boxes", "0, 0, 0 : 1/2, 1/2, 1/2"},
                                                 {"Kernel/type", "linear-decay"},
                                                 {"Study/regime", "m"},
                                                 {"Study/horizon", "1/4"},
                                                 {"Study/h", "1/8,1/16,1/32"},
                                                 {"Problem/solution", "sin(3*x)*cos(2*y)*exp(z)"},
                                                 {"Methods/names", "PA-AC"},
                                                 {"Reference/method", "Q1"},
                                                 {"Output/points", "at.csv"}});
  check_certifiable(scene);
  const auto points = [](const problem::Problem<3> &) {
    return std::vector<Point<3>>{{.1, .2, .3}, {.4, .25, .25}, {.31, .11, .4}};
  };
  const Certificate found = certify(scene, *find_method(reference::methods(), "Q1", "test"),
                                    {find_method(meshfree::methods(), "PA-AC", "test")}, 0, points);
  ASSERT_EQ(found.points.size(), 3u);
  EXPECT_TRUE(found.refused().empty());
  EXPECT_GE(found.least_digits(), 1u);
  for (const CertifiedValue &one : found.points)
  {
    ASSERT_EQ(one.x.size(), 3u);
    EXPECT_GT(one.error(), 0) << one.x[0];
    EXPECT_LT(one.error(), one.bound) << one.x[0];
    EXPECT_LT(std::abs(one.other[0] - one.exact[0]), one.other_bound) << one.x[0];
  }
  ASSERT_TRUE(found.mean);
  // over (0, 1/2): the means of sin 3x, of cos 2y and of exp z
  const double mean = 2 * (1 - std::cos(1.5)) / 3 * std::sin(1.) * 2 * (std::exp(.5) - 1);
  EXPECT_NEAR(found.mean->value[0], mean, found.mean->bound);
  EXPECT_LT(found.mean->bound, .05 * mean);
  const CertifiedPlaces places(found);
  EXPECT_EQ(places.find({.4, .25, .25}), 1u);
  EXPECT_EQ(places.find({.4, .25, .2}), 3u); // none
}

TEST(Certificate, has_each_rule_with_its_own_errors)
{
  const scene::Scene scene = make_scene();
  const method::Methods all = meshfree::methods();
  const Certificate found =
      certify(scene, *find_method(reference::methods(), "Q2", "test"),
              {find_method(all, "PA-AC", "test"), find_method(all, "FA", "test")}, 2, some_points);
  ASSERT_EQ(found.rules.size(), 2u);
  EXPECT_EQ(found.rules[1].method, "FA");
  for (const CertifiedRule &rule : found.rules)
  {
    EXPECT_EQ(rule.h, (std::vector<double>{1. / 8, 1. / 16, 1. / 32}));
    ASSERT_EQ(rule.largest.size(), 3u);
    EXPECT_GE(rule.largest[2], rule.root_mean_square[2]);
  }
  double largest = 0; // of the first one, by the values in the certificate
  for (const CertifiedValue &one : found.points)
    largest = std::max(largest, one.difference() / found.size);
  EXPECT_NEAR(found.rules[0].largest[2], largest, 1e-12);
  EXPECT_NE(found.rules[1].largest[2], found.rules[0].largest[2]);
  EXPECT_NEAR(found.rules[0].order, 2, .3);
}

TEST(GridConvergence, extrapolates_to_the_limit_of_a_power_law)
{
  const std::vector<double> h = {.3, .17, .1, .06}, limit = {1, -2, 5}, c = {.4, 1, -.2};
  const auto values = [&](double p)
  {
    std::vector<std::vector<double>> result;
    for (const double one : h)
    {
      result.emplace_back();
      for (unsigned int i = 0; i < 3; ++i)
        result.back().push_back(limit[i] + c[i] * std::pow(one, p));
    }
    return result;
  };
  for (const double p : {1., 2., 3.5})
  {
    const GridConvergence found = grid_convergence(h, values(p));
    ASSERT_TRUE(found.is_known());
    EXPECT_NEAR(found.order, p, .01);
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(found.correction[i] / (-c[i] * std::pow(h[3], p)), 1, .02) << p;
  }
  EXPECT_NEAR(grid_convergence(h, values(3.5), 2).order, 2, 1e-12);
  EXPECT_FALSE(grid_convergence(h, values(.2)).is_known()); // slower than 3/4 as h halves
  EXPECT_FALSE(grid_convergence({.2, .1}, {{1}, {2}}).is_known());
  EXPECT_FALSE(grid_convergence({.4, .2, .1}, {{1}, {1.1}, {1.3}}).is_known());
}

namespace
{
  const std::vector<double> certified = {1, -2, 3, .5};

  /// u_i (1 + factor) + C h^p.
  std::vector<GivenValues> series_of(double p, double factor, const std::vector<double> &h)
  {
    std::vector<GivenValues> series;
    for (const double one : h)
    {
      series.push_back({"h = " + std::to_string(one), {}});
      for (const double value : certified)
        series.back().values.push_back(value * (1 + factor) + (1 + .2 * value) * std::pow(one, p));
    }
    return series;
  }
} // namespace

TEST(Grade, counts_digits_and_no_more_than_the_certificate_has)
{
  const Certificate certificate = certificate_of(certified, 1e-6);
  const auto grade_of = [&](double factor)
  {
    std::vector<double> values = certified;
    for (double &value : values)
      value *= factor;
    return grade(certificate, {{"one", values}}, {}).grades.front();
  };
  const Grade exact = grade_of(1);
  EXPECT_EQ(exact.largest, 0);
  EXPECT_TRUE(exact.is_at_least);
  EXPECT_EQ(exact.digits, 6u); // of 1e-6 / 1.89
  const Grade percent = grade_of(1.01);
  EXPECT_NEAR(percent.root_mean_square, .01, 1e-12);
  EXPECT_NEAR(percent.largest, .03 / certificate.size, 1e-12);
  EXPECT_FALSE(percent.is_at_least);
  EXPECT_EQ(percent.digits, 1u); // .0159 relative
  EXPECT_TRUE(grade_of(1 + 3e-7).is_at_least);
  EXPECT_FALSE(grade_of(1 + 4e-7).is_at_least); // 1.2e-6 at the third point
  EXPECT_THROW(grade(certificate, {{"short", {1, 2}}}, {}), InputError);
}

TEST(Grade, finds_orders_and_the_limit_of_a_series)
{
  const Certificate certificate = certificate_of(certified, 1e-6);
  const std::vector<double> h = {.1, .05, .025};
  for (const double p : {1., 2.})
  {
    const SeriesGrade found = grade(certificate, series_of(p, 0, h), h);
    EXPECT_NEAR(found.order.value, p, 1e-6);
    EXPECT_TRUE(std::isnan(found.grades[0].order));
    EXPECT_NEAR(found.grades[2].order, p, 1e-6);
    EXPECT_NEAR(found.own_order, p, .01);
    // 1.25 times the error of the finest grid, which a pure power has all extrapolated
    EXPECT_NEAR(found.index / found.finest().root_mean_square, 1.25, .02);
    EXPECT_EQ(found.limit, GradedLimit::certified) << found.reason;
    EXPECT_LT(found.limit_distance, .02 * found.index);
  }
  const SeriesGrade biased = grade(certificate, series_of(2, .01, h), h);
  EXPECT_EQ(biased.limit, GradedLimit::another) << biased.reason;
  EXPECT_NEAR(biased.limit_distance, .01, 1e-4);
  EXPECT_NEAR(biased.own_order, 2, .01);
  EXPECT_LT(biased.order.value, 1.5); // errors flatten
}

TEST(Grade, does_not_decide_about_limits_without_evidence)
{
  const Certificate certificate = certificate_of(certified, 1e-6);
  const auto limit = [&](const std::vector<GivenValues> &given, const std::vector<double> &h)
  { return grade(certificate, given, h).limit; };
  EXPECT_EQ(limit(series_of(2, 0, {.1, .05}), {.1, .05}), GradedLimit::not_decided);
  EXPECT_EQ(limit(series_of(2, 0, {.1, .05, .025}), {}), GradedLimit::not_decided);
  // so coarse that the index is a fifth of the solution
  EXPECT_EQ(limit(series_of(1, 0, {1, .5, .25}), {1, .5, .25}), GradedLimit::not_decided);
  std::vector<GivenValues> erratic = series_of(2, 0, {.1, .05, .025});
  for (double &value : erratic[2].values)
    value += .1;
  EXPECT_EQ(limit(erratic, {.1, .05, .025}), GradedLimit::not_decided);
  // so coarse a first grid that the order of the changes is too large: errors still fall
  for (const std::vector<double> &errors : {std::vector<double>{.027, .01, .005},
                                            {.07, .01, .0025},
                                            {.5, .01, .0025},
                                            {.02, -.001, -.0005}})
  {
    std::vector<GivenValues> coarse(3, {"coarse", certified});
    for (std::size_t i = 0; i < coarse.size(); ++i)
      for (double &value : coarse[i].values)
        value *= 1 + errors[i];
    EXPECT_EQ(limit(coarse, {.2, .1, .05}), GradedLimit::not_decided) << errors.front();
  }
  // right to the last digit: no order to see, but the limit is
  const std::vector<GivenValues> exact(3, {"exact", certified});
  const SeriesGrade found = grade(certificate, exact, {.1, .05, .025});
  EXPECT_EQ(found.limit, GradedLimit::certified);
  EXPECT_TRUE(std::isnan(found.order.value));
  // below the bounds nothing is an order
  const Certificate loose = certificate_of(certified, .02);
  EXPECT_TRUE(
      std::isnan(grade(loose, series_of(2, 0, {.1, .05, .025}), {.1, .05, .025}).order.value));
}
