// Cases that share a discretisation are solved, charged and fail as if each were alone.
#include "analysis/statics.h"

#include "base/error.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;

namespace
{
  using Settings = std::vector<scene::Override>;

  std::shared_ptr<const method::Method> method_of(const std::string &name)
  {
    for (const auto &methods : {reference::methods(), meshfree::methods()})
      for (const auto &one : methods)
        if (one->name() == name)
          return one;
    throw std::logic_error(name);
  }

  /// A constant, which quadrature of whatever degree does not move, and a wave.
  scene::Scene two_cases(const Settings &settings)
  {
    Settings all = {{"Problem/solution", "flat: 3; wave: sin(5*x)*cos(4*y)"},
                    {"Geometry/checks", "0"},
                    {"Methods/names", "Q1"},
                    {"Study/h", "0.125"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("test.prm", "", all);
  }

  std::vector<problem::Problem<2>> problems_of(const scene::Scene &scene)
  {
    return {make_problem(scene, 0, {.125, .3}), make_problem(scene, 1, {.125, .3})};
  }

  /// Fails at its second case.
  class Fragile : public study::GivenSolutions
  {
  public:
    explicit Fragile(std::function<void()> fail) : GivenSolutions("fragile"), fail_(std::move(fail))
    {
    }

  private:
    method::Field field(const problem::Problem<2> &) const override
    {
      if (n_solves == 2)
        fail_();
      return {};
    }
    std::function<void()> fail_;
  };

  std::string failure(const analysis::Outcome &outcome)
  {
    try
    {
      std::rethrow_exception(outcome.failure);
    }
    catch (const std::exception &error)
    {
      return error.what();
    }
  }
} // namespace

TEST(Statics, cases_together_have_the_solutions_that_they_have_alone)
{
  const struct
  {
    std::string mesh, method;
  } ways[] = {{"lattice", "FA"}, {"lattice", "Q2"},   {"squares", "OPT"},
              {"squares", "Q1"}, {"triangles", "P1"}, {"squares", "LOCAL"}};
  for (const auto &[mesh, name] : ways)
  {
    const auto scene = two_cases({{"Domain/mesh", mesh}});
    const auto problems = problems_of(scene);
    const auto method = method_of(name);
    const auto together = analysis::solve(*method, {&problems[0], &problems[1]});
    ASSERT_EQ(together.size(), 2u);
    for (unsigned int c = 0; c < 2; ++c)
    {
      const auto alone = analysis::solve(*method, problems[c]);
      ASSERT_TRUE(together[c].solution) << name;
      EXPECT_EQ(together[c].solution->averages, alone.averages) << name << " on " << mesh;
      EXPECT_EQ(together[c].solution->nodal, alone.nodal) << name << " on " << mesh;
      EXPECT_EQ(together[c].solution->diagnostics.n_refinements, alone.diagnostics.n_refinements);
      const dealii::Point<2> x(.3, .6);
      EXPECT_EQ(together[c].solution->value(x, 0), alone.value(x, 0)) << name << " on " << mesh;
    }
  }
}

TEST(Statics, each_case_is_charged_the_setup_and_refined_as_far_as_it_needs)
{
  const auto scene = two_cases({{"Domain/mesh", "triangles"},
                                {"Quadrature/entries", "quadrature"},
                                {"Quadrature/tolerance", "1e-6"},
                                {"Quadrature/max refinements", "6"}});
  const auto problems = problems_of(scene);
  const auto solved = analysis::solve(*method_of("P1"), {&problems[0], &problems[1]});
  ASSERT_TRUE(solved[0].solution && solved[1].solution);
  const auto &flat = *solved[0].solution, &wave = *solved[1].solution;
  EXPECT_EQ(flat.diagnostics.n_refinements, 1u);
  EXPECT_GT(wave.diagnostics.n_refinements, 1u);
  EXPECT_GT(flat.cost.setup_seconds, 0);
  EXPECT_GT(wave.cost.setup_seconds, flat.cost.setup_seconds); // the same, and that of finer ones
}

TEST(Statics, what_one_case_fails_at_is_its_own)
{
  const auto scene = two_cases({});
  const auto problems = problems_of(scene);
  const auto solve = [&](const std::function<void()> &fail) {
    return analysis::solve(Fragile(fail), {&problems[0], &problems[1]});
  };
  const auto numerical = solve([] { throw NumericalError("rank loss"); });
  EXPECT_TRUE(numerical[0].solution);
  EXPECT_FALSE(numerical[1].solution);
  EXPECT_EQ(failure(numerical[1]), "rank loss");
  EXPECT_EQ(failure(solve([] { throw std::bad_alloc(); })[1]).find("memory ran out"), 0u);
  EXPECT_THROW(solve([] { throw InputError("bad key"); }), InputError); // it is the user's
}
