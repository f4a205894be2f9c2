// Values at points on intervals, their estimates, and certificates: ways that agree, and ways that
// are broken.
#include "study/certificate.h"
#include "base/error.h"
#include "meshfree/method.h"
#include "method/discretisation.h"
#include "physics/gauss.h"
#include "reference/method.h"
#include "scene/on_line.h"
#include "study/estimate_on_line.h"
#include "study/memory_estimate.h"
#include "study/nodal_fit.h"
#include "study/preflight.h"
#include "study/statics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using Point = dealii::Point<1>;
  using Points = std::vector<Point>;
  using Settings = std::vector<scene::Override>;
  using Problem = problem::Problem<1>;

  /// sin 3x on two intervals between which bonds reach.
  scene::Scene make_scene(const Settings &more = {})
  {
    Settings settings = {
        {"Domain/dimension", "1"},      {"Domain/boxes", "0 : 1; 9/8 : 2"},
        {"Kernel/type", "conical"},     {"Problem/solution", "sin(3*x)"},
        {"Methods/names", "PA-AC, Q2"}, {"Study/regime", "m"},
        {"Study/horizon", "1/4"},       {"Study/h", "1/16, 1/32, 1/64"},
        {"Study/norms", "averages L2"}, {"Study/decisive error", "averages L2 | exact"},
        {"Reference/method", "Q2"},     {"Output/points", "at.csv"}};
    settings.insert(settings.end(), more.begin(), more.end());
    return scene::parse_scene("line.prm", "", settings);
  }

  Points some_points(const Problem &)
  {
    return {Point(.1), Point(.37), Point(.5), Point(1.3), Point(1.9)};
  }

  Methods available()
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  std::shared_ptr<const Method> find(const std::string &name)
  {
    return find_method(available(), name, "test");
  }

  /// Discretises other problems than it is given.
  class Broken : public Method, public method::MethodOnIntervals
  {
  public:
    using Change = std::function<void(Problem &)>;

    Broken(const std::string &name, Change change) : right_(find(name)), change_(std::move(change))
    {
    }

    std::string name() const override { return right_->name(); }
    method::MethodFamily family() const override { return right_->family(); }
    std::string help() const override { return "broken"; }
    unsigned int order() const override { return right_->order(); }
    std::unique_ptr<method::Discretisation> discretise(const problem::Problem<2> &,
                                                       const base::Communicator &) const override
    {
      return nullptr;
    }
    std::string why_not_on_intervals(const physics::Kernel<1> &kernel) const override
    {
      return on_line().why_not_on_intervals(kernel);
    }
    std::unique_ptr<method::IntervalDiscretisation>
    discretise_on_intervals(const Problem &problem) const override
    {
      Problem changed = problem;
      change_(changed);
      return on_line().discretise_on_intervals(changed);
    }

  private:
    const method::MethodOnIntervals &on_line() const
    {
      return dynamic_cast<const method::MethodOnIntervals &>(*right_);
    }

    std::shared_ptr<const Method> right_;
    Change change_;
  };

  Certificate certify_by(const Method &galerkin, const Method &rule,
                         const scene::Scene &scene = make_scene())
  {
    const std::shared_ptr<const Method> not_owned(std::shared_ptr<void>(), &rule);
    return certify(scene, galerkin, {not_owned}, 1, some_points);
  }

  double exact(double x)
  {
    return std::sin(3 * x);
  }
} // namespace

TEST(PointsOnLine, have_values_of_each_solve_with_estimates_that_are_bounds)
{
  std::map<std::string, std::vector<ValuesAtPoints>> found;
  StaticsOptions options;
  options.points_on_line = some_points;
  options.on_values = [&](const ValuesAtPoints &values, const Record &record)
  { found[record.key.method].push_back(values); };
  const scene::Scene scene = make_scene({{"Reference/method", "Q1"}});
  const Methods all = available();
  (void)run_study(statics_analysis(all, options), scene, choose_methods(scene, all));
  ASSERT_EQ(found.size(), 3u);
  for (const auto &[method, levels] : found)
  {
    ASSERT_EQ(levels.size(), 3u) << method;
    for (unsigned int level = 0; level < 3; ++level)
    {
      const ValuesAtPoints &values = levels[level];
      ASSERT_EQ(values.values.size(), 5u);
      EXPECT_EQ(values.estimate.size(), method == "PA-AC" ? 0u : 5u) << method;
      for (unsigned int i = 0; i < 5; ++i)
      {
        const double x = some_points(Problem{geometry::IntervalLattice({{0, 1}}, .5),
                                             make_kernel_on_line(scene, .25)})[i][0],
                     error = std::abs(values.values[i] - exact(x));
        EXPECT_EQ(values.exact[i], exact(x));
        EXPECT_LT(error, method == "PA-AC" ? .1 : method == "Q2" ? 1e-4 : 5e-3) << method << x;
        if (method != "PA-AC")
        {
          EXPECT_LE(error, values.estimate[i]) << method << ' ' << x;
        }
      }
    }
    if (method == "PA-AC")
      continue;
    // estimates fall as fast as errors do, by degree p + 1
    const double ratio = levels[1].estimate[0] / levels[2].estimate[0];
    EXPECT_NEAR(std::log2(ratio), method == "Q2" ? 3 : 2, .35) << method;
  }
}

// a line has no second row of cells, and its matrix is a band
TEST(MemoryOnLine, grows_with_cells_times_band)
{
  const scene::Scene fine = make_scene({{"Study/h", "1/512, 1/1024, 1/2048"},
                                        {"Reference/method", "DGQ3"},
                                        {"Methods/names", "PA-AC"}});
  double largest = 0;
  for (const MemoryOfLevel &one : estimate_memory(fine, {find("DGQ3")}, 0, 1))
  {
    EXPECT_EQ(one.largest.what.find(" x "), std::string::npos) << one.largest.what;
    largest = std::max(largest, one.largest.bytes);
  }
  EXPECT_GT(largest, 8. * (2 * 2048 * 4) * (512 * 4)); // the factor alone
  EXPECT_LT(largest, 2e9);
}

// discontinuous elements take the limits of data from inside their cells
TEST(StaticsOnLine, data_may_jump_at_ends_of_cells)
{
  const auto solved = [](const std::string &name, const std::string &constraint)
  {
    const scene::Scene scene = make_scene({{"Problem/solution", ""},
                                           {"Problem/load", "1"},
                                           {"Problem/constraint", constraint},
                                           {"Reference/method", "DGQ3"},
                                           {"Study/decisive error", "averages L2 | reference"}});
    const Problem problem = make_problem_on_line(scene, 0, scene.study.series.front().levels[0]);
    return solve_on_line(*find(name), problem).averages;
  };
  for (const std::string name : {"DGQ0", "DGQ1", "DGQ2", "DGQ3"})
  {
    const std::vector<double> with_left = solved(name, "x <= 17/16 ? 0 : 1/10"),
                              with_right = solved(name, "x < 17/16 ? 0 : 1/10");
    ASSERT_EQ(with_left.size(), with_right.size());
    for (std::size_t i = 0; i < with_left.size(); ++i)
      EXPECT_NEAR(with_left[i], with_right[i], 1e-14) << name;
  }
}

TEST(EstimateOnLine, bounds_averages_and_fields_without_hiding_either)
{
  for (const std::string solution : {"sin(3*x)", "exp(2*x)", "1/(1.4 + x)"})
    for (const std::string name : {"Q1", "Q2", "DGQ1", "DGQ2", "DGQ3"})
    {
      const Problem problem =
          make_problem_on_line(make_scene({{"Problem/solution", solution}}), 0, {1. / 16, .25});
      const auto method = find(name);
      const SolutionOnLine solved = solve_on_line(*method, problem);
      const ErrorEstimate found = estimate_on_line(*method, problem, solved);
      const auto &gauss = physics::gauss(10);
      std::vector<double> averages; // errors of them
      double squares = 0;
      problem.lattice.for_each_cell(
          [&](int cell)
          {
            double sum = 0;
            for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const Point x(problem.lattice.coordinate(cell + gauss.point(q)[0]));
              const double u = problem.solution->value(x, 0);
              sum += gauss.weight(q) * u;
              squares += problem.h() * gauss.weight(q) * std::pow(u - solved.value(x[0]), 2);
            }
            averages.push_back(sum - solved.averages[averages.size()]);
          });
      const double error = std::sqrt(squares), of_averages = averages_l2(problem, averages);
      EXPECT_LE(of_averages, found.estimate) << name << solution;
      EXPECT_LE(error, found.field_estimate) << name << solution;
      EXPECT_LT(found.field_estimate, 30 * error + 1e-10) << name << solution;
      EXPECT_LE(found.field_rate, method->order() + 1e-12);
    }
}

TEST(CertificateOnLine, holds_values_on_which_both_ways_agree_within_their_bounds)
{
  const Certificate found = certify_by(*find("Q2"), *find("PA-AC"));
  EXPECT_TRUE(found.refused().empty());
  ASSERT_EQ(found.points.size(), 5u);
  for (const CertifiedValue &one : found.points)
  {
    ASSERT_EQ(one.x.size(), 1u);
    EXPECT_EQ(one.exact, std::vector<double>{exact(one.x[0])});
    EXPECT_LE(one.error(), one.bound);
    EXPECT_LE(std::abs(one.other[0] - one.exact[0]), one.other_bound);
    EXPECT_GT(one.bound, 0);
    EXPECT_LT(one.bound, 1e-4);
  }
  ASSERT_TRUE(found.mean);
  // over (0, 1) and (9/8, 2), which have a length of 15/8
  const double mean = (1 - std::cos(3.) + std::cos(27. / 8) - std::cos(6.)) / 3 / (15. / 8);
  EXPECT_NEAR(found.mean->value[0], mean, found.mean->bound);
  EXPECT_NEAR(found.mean->other[0], mean, found.mean->other_bound);
  EXPECT_LT(found.mean->bound, 1e-5);
  EXPECT_EQ(found.meshfree.h, (std::vector<double>{1. / 16, 1. / 32, 1. / 64}));
}

TEST(CertificateOnLine, is_refused_if_one_way_is_broken)
{
  const auto refused =
      [](const std::string &rule, const Broken::Change &change, const Settings &more = {})
  { return certify_by(*find("Q2"), Broken(rule, change), make_scene(more)).refused().size(); };
  EXPECT_EQ(refused("PA-AC", [](auto &) {}), 0u);
  const auto of_kernel = [](const std::string &key, const std::string &value, double horizon)
  {
    return [=](Problem &problem) {
      problem.kernel = make_kernel_on_line(make_scene({{key, value}}), horizon);
    };
  };
  const Settings unknown = {{"Problem/solution", ""},
                            {"Problem/load", "1"},
                            {"Problem/constraint", "0"},
                            {"Study/decisive error", "averages L2 | reference"}};
  for (const Settings &more : {Settings{}, unknown})
  {
    // twice the stiffness, another kernel of the same limit
    EXPECT_EQ(refused("PA-AC", of_kernel("Kernel/limit", "-Laplace", .25), more), 6u);
    EXPECT_GT(refused("PA-AC", of_kernel("Kernel/type", "constant", .25), more), 0u);
    // on the finest level alone, so that changes grow and there is no bound
    EXPECT_EQ(refused(
                  "PA-AC",
                  [&](Problem &problem)
                  {
                    if (problem.h() < .02)
                      of_kernel("Kernel/limit", "-Laplace", .25)(problem);
                  },
                  more),
              6u);
    // and if the Galerkin method is the broken one
    EXPECT_FALSE(certify_by(Broken("Q2", of_kernel("Kernel/limit", "-Laplace", .25)),
                            *find("PA-AC"), make_scene(more))
                     .refused()
                     .empty());
  }
}

TEST(NodalFitOnLine, has_cubics_exactly_and_beside_ends_too)
{
  const auto cubic = [](double x) { return 1 + x - 2 * x * x + 3 * x * x * x; };
  Points nodes;
  std::vector<double> nodal;
  for (int i = 0; i < 20; ++i)
  {
    nodes.emplace_back(.05 + .1 * i);
    nodal.push_back(cubic(nodes.back()[0]));
  }
  for (const double x : {0., .33, 1.05, 1.99})
    EXPECT_NEAR(values_by_fit({Point(x)}, nodes, nodal, 1)[0], cubic(x), 1e-11) << x;
  EXPECT_TRUE(
      std::isnan(values_by_fit({Point(.5)}, {nodes.begin(), nodes.begin() + 3}, nodal, 1)[0]));
}
