// Problems made of values, callables and arrays, beside the same ones read from scenes.
#include "problem/builder.h"
#include "analysis/statics.h"
#include "base/error.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;
  using problem::Problem;
  using problem::ProblemBuilder;

  const geometry::Domain unit_square{{{{0, 0}, {1, 1}}}, {}};

  method::Methods all_methods()
  {
    method::Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  std::vector<double> averages(const std::string &name, const Problem<2> &problem)
  {
    const method::Methods all = all_methods();
    return analysis::solve(**std::find_if(all.begin(), all.end(),
                                          [&](const auto &one) { return one->name() == name; }),
                           problem)
        .averages;
  }

  /// δ = 0.3, -∫ γ (u(y) - u(x)) dy = b, whose limit is -Laplace.
  physics::Kernel<2> diffusion(double horizon = .3)
  {
    return physics::Kernel<2>::with_diffusion(physics::kernel_type("linear-decay").profile, horizon,
                                              1);
  }

  const auto load = [](const Point<2> &x, unsigned int) { return 1 + x[0] * x[1]; };
  const auto constraint = [](const Point<2> &x, unsigned int) { return x[0] - 2 * x[1]; };

  std::string refusal(const ProblemBuilder &given)
  {
    try
    {
      (void)given.build();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_found(const std::string &text, const std::string &part)
  {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
} // namespace

TEST(ProblemBuilder, poses_what_a_scene_poses)
{
  for (const std::string mesh : {"lattice", "squares"})
  {
    const scene::Scene scene =
        scene::parse_scene("t.prm", "",
                           {{"Kernel/type", "linear-decay"},
                            {"Kernel/limit", "-Laplace"},
                            {"Problem/load", "1 + x*y"},
                            {"Problem/constraint", "x - 2*y"},
                            {"Domain/mesh", mesh},
                            {"Reference/method", "Q2"},
                            {"Study/decisive error", "averages L2 | reference"},
                            {"Methods/names", "all"},
                            {"Study/h", "0.1"},
                            {"Study/m", "3"}});
    const Problem<2> read = scene::make_problem(scene, 0, {.1, .3});
    ProblemBuilder given(mesh == "lattice"
                             ? problem::Domain(problem::LatticeDomain{{unit_square, .1}})
                             : problem::mesh_domain(unit_square, .1, {}, .3),
                         diffusion());
    given.load.value = load;
    given.constraint.value = constraint;
    given.settings = read.settings;
    EXPECT_NEAR(given.h, .1, 1e-15);
    const Problem<2> made = given.build();
    for (const std::string name : {"FA", "IPA-AC", "Q1", "DGQ1"})
    {
      const std::vector<double> a = averages(name, made), b = averages(name, read);
      if (mesh == "lattice") // to the same bits
      {
        EXPECT_EQ(a, b) << name;
      }
      ASSERT_EQ(a.size(), b.size()) << name;
      for (std::size_t i = 0; i < a.size(); ++i) // corners of cells may differ by rounding
        EXPECT_NEAR(a[i], b[i], 1e-12) << name << ' ' << mesh;
    }
  }
}

TEST(ProblemBuilder, makes_the_load_of_a_solution)
{
  ProblemBuilder given(problem::LatticeDomain{{unit_square, .1}}, diffusion());
  given.solution =
      problem::Field<2>{[](const Point<2> &x, unsigned int) { return x[0] * x[0] + x[1]; }, {}};
  const Problem<2> problem = given.build();
  EXPECT_FALSE(problem.is_load_given);
  EXPECT_NEAR(problem.load.value({.4, .3}, 0), -2, 1e-10); // of x², by the second moments
  EXPECT_EQ(problem.constraint.value({-.1, .5}, 0), .01 + .5);
}

TEST(ProblemBuilder, takes_nodes_as_an_array)
{
  std::vector<Point<2>> nodes; // a lattice sheared in its rows, with its interaction domain
  for (double y = -.25; y < 1.3; y += .1)
    for (double x = -.25; x < 1.3; x += .1)
      nodes.emplace_back(x + .01 * std::sin(9 * y), y);
  ProblemBuilder given(problem::mesh_domain(unit_square, .1, nodes, .3), diffusion());
  given.solution =
      problem::Field<2>{[](const Point<2> &x, unsigned int) { return x[0] - 3 * x[1]; }, {}};
  const Problem<2> problem = given.build();
  EXPECT_NEAR(given.h, .1, .02);
  const std::vector<double> found = averages("Q1", problem);
  double worst = 0;
  for (const double value : found)
    worst = std::max(worst, std::abs(value));
  EXPECT_GT(worst, 1); // |x - 3 y| reaches 3
  EXPECT_LT(worst, 3);
}

TEST(ProblemBuilder, poses_bodies_with_free_boundaries)
{
  const scene::Scene scene = scene::read_scene(PLUMBLINE_SCENES "/state_based/bar.prm");
  const problem::Level level = scene.study.series.front().levels.front();
  const Problem<2> read = scene::make_problem(scene, 0, level);
  const auto *body = std::get_if<problem::BodyDomain>(&read.domain);
  ASSERT_NE(body, nullptr);
  ProblemBuilder given(*body, read.kernel, level.h);
  static_cast<Problem<2> &>(given) = read; // what remains after a change of the load
  given.load = {};
  given.load.value = [&](const Point<2> &x, unsigned int c) { return 2 * read.load.value(x, c); };
  given.is_load_given = true;
  const auto twice = averages("PA-AC", given.build()), once = averages("PA-AC", read);
  ASSERT_EQ(twice.size(), once.size());
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    largest = std::max(largest, std::abs(once[i]));
    difference = std::max(difference, std::abs(twice[i] - 2 * once[i]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(difference, 1e-9 * largest);
}

TEST(ProblemBuilder, refuses_what_is_no_problem)
{
  ProblemBuilder given(problem::LatticeDomain{{unit_square, .1}}, diffusion());
  given.load.value = load;
  EXPECT_EQ(refusal(given), "");
  {
    ProblemBuilder bad = given;
    bad.h = -1;
    expect_found(refusal(bad), "h = -1 is not the size of cells");
  }
  {
    ProblemBuilder bad = given;
    bad.load.value = [](const Point<2> &x, unsigned int) { return std::log(x[0] - .5); };
    const std::string message = refusal(bad);
    expect_found(message, "load = ");
    expect_found(message, "it must be a finite number everywhere in the domain");
  }
  {
    ProblemBuilder bad = given;
    bad.constraint.value = [](const Point<2> &x, unsigned int) { return std::sqrt(x[0]); };
    expect_found(refusal(bad), "everywhere in the interaction domain");
  }
  {
    ProblemBuilder bad(problem::mesh_domain(unit_square, .1, {}, .3), diffusion(.5));
    bad.load.value = load;
    expect_found(refusal(bad), "the interaction domain is known to be 0.3 wide, but bonds reach "
                               "0.5");
  }
}
