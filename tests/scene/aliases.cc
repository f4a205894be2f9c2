// Former names of keys and values are read; scenes that are written have today's.
#include "scene/aliases.h"
#include "base/error.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  std::string text_of(const std::string &text, const std::vector<Override> &settings = {})
  {
    std::vector<Override> all = {{"Problem/solution", "x, y"}, {"Kernel/type", "1/r"},
                                 {"Kernel/limit", "Navier"},   {"Material/model", "LPS"},
                                 {"Material/E", "1"},          {"Material/nu", "0.3"},
                                 {"Methods/names", "PA-AC"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return parse_scene("test.prm", text, all).text;
  }

  std::string refusal(const std::string &text, const std::vector<Override> &settings = {})
  {
    try
    {
      (void)text_of(text, settings);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(Aliases, AreReadInScenesAndInSettings)
{
  const std::string wide = text_of("subsection Domain\n set interaction domain = 2\nend\n");
  EXPECT_EQ(text_of("subsection Domain\n set collar = 2\nend\n"), wide);
  EXPECT_EQ(text_of("", {{"Domain/collar", "2"}}), wide);
  EXPECT_NE(wide.find("set interaction domain"), std::string::npos);
  EXPECT_EQ(wide.find("set collar"), std::string::npos);
  const Override squares = {"Domain/mesh", "squares"};
  const std::string mixed = text_of("", {squares, {"Solver/dilatation", "mixed"}});
  EXPECT_EQ(text_of("subsection Solver\n set dilatation = kept\nend\n", {squares}), mixed);
  EXPECT_EQ(mixed.find("kept"), std::string::npos);
}

TEST(Aliases, EachStandsForAKeyThatThereIs)
{
  for (const Alias &one : aliases())
  {
    const std::string message =
        refusal("", {{one.old_key.empty() ? one.key : one.old_key, "no such value, nor a number"}});
    EXPECT_EQ(message.find("is not known"), std::string::npos) << message;
    if (!one.old_key.empty())
    {
      EXPECT_EQ(current_key(one.old_key), one.key);
    }
    else
    {
      EXPECT_EQ(current_value(one.key, one.old_value), one.value);
      EXPECT_EQ(refusal("", {{one.key, one.old_value}}).find("is not allowed"), std::string::npos)
          << one.key;
    }
  }
}

TEST(Aliases, ByTheSideOfTheirNewNamesAreRefused)
{
  const std::string message = refusal("subsection Domain\n set collar = 2\n"
                                      " set interaction domain = 3\nend\n");
  EXPECT_NE(message.find("Domain/interaction domain"), std::string::npos) << message;
}
