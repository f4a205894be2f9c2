// Predicted messages and times of many ranks: of the nodes, blocks and reach that each method has.
#include "study/rank_times.h"
#include "method/discretisation_in_space.h"
#include "scene/problem.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
} // namespace

TEST(RankTimes, are_of_the_nodes_and_stencil_of_each_method)
{
  const scene::Scene scene = make_scene({{"Domain/boxes", "0,0,0 : 1,1,1.5"},
                                         {"Methods/names", "FA, PA-AC, Q1, DGQ0, Q2"},
                                         {"Study/m", "2"},
                                         {"Study/h", "1/4, 1/8"}});
  const Methods methods = choose_methods(scene, available());
  constexpr unsigned int n_ranks = 5;
  const auto times = predict_times(scene, methods, 0, n_ranks, {});
  ASSERT_EQ(times.size(), 4u * 2); // Q2 is not distributed
  for (const TimeOfLevel &one : times)
  {
    const auto method = find_method(methods, one.method, "");
    const auto whole =
        method->discretise_in_space(scene::make_problem_in_space(scene, 0, one.level));
    const auto &n = one.layout.n;
    EXPECT_EQ(static_cast<std::size_t>(n[0]) * n[1] * n[2], whole->n_unknowns()) << one.method;
    EXPECT_EQ(one.layout.reach, whole->waves()->stiffness.reaches()[2]) << one.method;
    EXPECT_EQ(one.layout.block, one.level.h == .25 ? 2 : 3) << one.method;
    EXPECT_GT(one.apply.sent.n_messages, 0u);
    EXPECT_GT(one.iteration.seconds(), one.apply.seconds() + one.precondition.seconds());
  }
  EXPECT_EQ(predict_times(scene, methods, 1, n_ranks, {}).size(), 4u);
}

TEST(RankTimes, are_of_forces_alone_in_time)
{
  const scene::Scene scene = make_scene({{"Time/final time", "0.1"},
                                         {"Problem/solution", "x*y + z^2"},
                                         {"Study/norms", "nodal L2"},
                                         {"Study/decisive error", "nodal L2 | exact"},
                                         {"Study/h", "1/4"}});
  const auto times = predict_times(scene, choose_methods(scene, available()), 0, 2, {});
  ASSERT_EQ(times.size(), 1u);
  EXPECT_GT(times.front().apply.seconds(), 0);
  EXPECT_EQ(times.front().iteration.seconds(), 0);
}
