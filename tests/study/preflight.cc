// What is wrong with the data of a scene is found before any solve.
#include "study/preflight.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <string>

using namespace plumbline;

namespace
{
  /// What check_data says about a scene; empty: nothing.
  std::string complaint(const std::vector<scene::Override> &settings)
  {
    try
    {
      study::check_data(scene::parse_scene("test.prm", "", settings));
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  bool says(const std::string &message, const std::string &part)
  {
    return message.find(part) != std::string::npos;
  }
} // namespace

TEST(Preflight, a_mesh_that_does_not_follow_h_is_refused)
{
  // halved until no side is longer than h: 8 cells a side for .3 and .28, 16 for .15
  const auto cube = [](const std::string &h)
  {
    return complaint({{"Problem/solution", "x"},
                      {"Methods/names", "Q1"},
                      {"Domain/mesh", "hyper_cube"},
                      {"Domain/arguments", "-1 : 1 : false"},
                      {"Domain/inside", "0.5 - max(abs(x), abs(y))"},
                      {"Study/regime", "m"},
                      {"Study/horizon", "0.4"},
                      {"Study/h", h}});
  };
  EXPECT_EQ(cube("0.3, 0.15"), "");
  const std::string message = cube("0.3, 0.28");
  EXPECT_TRUE(says(message, "level h = 0.28")) << message;
  EXPECT_TRUE(says(message, "cells of the level before")) << message;
  EXPECT_TRUE(says(message, "a mesh that follows h")) << message;
}

TEST(Preflight, a_crack_through_a_node_is_found_at_every_level)
{
  const auto cracked = [](const std::string &crack)
  {
    return complaint({{"Problem/solution", "x, y"},
                      {"Kernel/type", "1/r"},
                      {"Kernel/limit", "Navier"},
                      {"Material/model", "LPS"},
                      {"Material/E", "1"},
                      {"Material/nu", "0.3"},
                      {"Methods/names", "FA"},
                      {"Domain/mesh", "squares"},
                      {"Domain/cracks", crack},
                      {"Study/m", "2"},
                      {"Study/h", "0.25, 0.125"}});
  };
  EXPECT_EQ(cracked("0.5, 0.2 : 0.5, 0.8"), "");
  // between the nodes of the first level, through those of the second
  const std::string message = cracked("0.1, 0.3125 : 0.8, 0.3125");
  EXPECT_TRUE(says(message, "level h = 0.125")) << message;
  EXPECT_TRUE(says(message, "Domain/cracks: crack 0 goes through node")) << message;
}

TEST(Preflight, data_are_looked_at_as_far_out_as_any_level_reaches)
{
  // the root is not real beyond x = -.2: the first level's collar is .3 wide, the others' less
  const auto reach = [](const std::string &h)
  {
    return complaint({{"Problem/solution", "sqrt(x + 0.2)"},
                      {"Methods/names", "FA"},
                      {"Study/m", "3"},
                      {"Study/h", h}});
  };
  EXPECT_TRUE(says(reach("0.1, 0.05, 0.025"), "Problem/solution")) << reach("0.1, 0.05, 0.025");
  EXPECT_EQ(reach("0.04, 0.02"), "");
}
