#include "scene/scene_file.h"

#include "base/error.h"
#include "scene/scene.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  /// A folder that vanishes with the test.
  class SceneFile : public testing::Test, protected tests::TextFolder
  {
  protected:
    SceneFile() : TextFolder("scene") {}

    /// What reading the scene says, without its folder.
    std::string fault(const std::string &name, const std::string &text) const
    {
      try
      {
        (void)read_scene(write(name, text));
      }
      catch (const InputError &error)
      {
        std::string message = error.what();
        for (std::size_t at; (at = message.find(path().string() + "/")) != std::string::npos;)
          message.erase(at, path().string().size() + 1);
        return message;
      }
      return "no error";
    }
    std::string fault(const std::string &text) const { return fault("a.prm", text); }
  };

  std::vector<Setting> settings(const std::string &text)
  {
    return read_settings("a.prm", text, "scene 'a.prm'");
  }

  const std::string problem_text = "subsection Problem\n  set solution = x^2\nend\n",
                    methods = "subsection Methods\n  set names = Q1\nend\n";
} // namespace

TEST_F(SceneFile, has_settings_sections_comments_and_continued_lines)
{
  const auto found = settings("# what it is for\r\nset Purpose = two  words # said\r\n\r\n"
                              "SUBSECTION Study\n\tset  decisive   error=nodal Linf | exact\n"
                              "  set h = 0.1, \\\n     0.05\n end \nset empty =");
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].key, "Purpose");
  EXPECT_EQ(found[0].value, "two  words");
  EXPECT_EQ(found[1].key, "Study/decisive error");
  EXPECT_EQ(found[1].value, "nodal Linf | exact");
  EXPECT_EQ(found[2].value, "0.1, 0.05");
  EXPECT_EQ(found[2].place, "line 6");
  EXPECT_EQ(found[3].place, "line 9");
  EXPECT_EQ(found[3].value, "");
}

TEST_F(SceneFile, says_in_which_line_it_is_not_understood)
{
  EXPECT_EQ(fault("subsection Study\n set hh = 0.1\nend\n")
                .find("scene 'a.prm', line 2: key "
                      "'Study/hh' is not known"),
            0u);
  EXPECT_EQ(fault(problem_text + "sett h = 1\n"),
            "scene 'a.prm', line 4: 'sett h = 1' is not understood; write 'set key = value', "
            "'subsection NAME', 'end', 'include FILE', or '#' before a comment");
  EXPECT_EQ(
      fault(problem_text + "set h\n").find("scene 'a.prm', line 4: 'set h' is not understood"), 0u);
  EXPECT_EQ(fault("\n\nend\n"), "scene 'a.prm', line 3: 'end' closes no subsection; remove it");
  EXPECT_EQ(
      fault(problem_text + "subsection Study\n set h = 1\n"),
      "scene 'a.prm', line 4: subsection Study is not closed; write 'end' after its last line");
  EXPECT_EQ(fault("subsection Geometry\n\n set checks = few\nend\n")
                .find("scene 'a.prm', line 3: Geometry/checks = 'few' is not allowed"),
            0u);
}

TEST_F(SceneFile, with_a_key_given_twice_is_refused_with_both_lines)
{
  EXPECT_EQ(
      fault(problem_text + methods + "subsection Problem\n  set solution = y\nend\n"),
      "scene 'a.prm', line 8: Problem/solution is given in line 2 already; remove one of them");
  write("common.prm", "# of all\n" + problem_text);
  EXPECT_EQ(fault("include common.prm\n" + methods + problem_text),
            "scene 'a.prm', line 6: Problem/solution is given in line 3 of 'common.prm' already; "
            "remove one of them");
  EXPECT_EQ(fault("a.json", "{\"Problem\": {\"solution\": \"x\",\n \"solution\": \"y\"}}"),
            "scene 'a.json', line 2: the key 'solution' comes twice in one object; mend the file");
}

TEST_F(SceneFile, includes_others_from_its_folder_and_never_itself)
{
  std::filesystem::create_directory(path() / "parts");
  write("parts/problem.prm", problem_text);
  write("parts/all.prm", "include problem.prm\n" + methods);
  EXPECT_EQ(fault("include parts/all.prm\n"), "no error");
  EXPECT_EQ(fault("\ninclude a.prm\n"), "scene 'a.prm', line 2: 'a.prm' is being read already, so "
                                        "that it would include itself; remove the line");
  write("b.prm", "include ../" + path().filename().string() + "/a.prm\n");
  EXPECT_EQ(fault("include b.prm\n").find("scene 'a.prm', line 1 of 'b.prm': '../"), 0u);
  EXPECT_EQ(fault("include nowhere.prm\n"),
            "scene 'a.prm', line 1: 'nowhere.prm' cannot be read; give a file named from the "
            "scene's folder");
  EXPECT_EQ(fault("include parts\n").find("scene 'a.prm', line 1: 'parts' cannot be read"), 0u);
  std::string many;
  for (int i = 0; i < 101; ++i)
    many += "include empty.prm\n";
  write("empty.prm", "");
  EXPECT_EQ(fault(many), "scene 'a.prm', line 101: more than 100 files are included; write them "
                         "in one");
}

TEST_F(SceneFile, that_is_no_text_is_refused)
{
  EXPECT_EQ(fault(problem_text + "set Purpose = \xE9t\xE9\n"),
            "scene 'a.prm', line 4: has a character that is not UTF-8; store the file as UTF-8");
  EXPECT_EQ(fault(std::string("set Purpose = a\0b\n", 18)),
            "scene 'a.prm', line 1: has the control character 0; give a plain text file");
  EXPECT_EQ(fault("\xEF\xBB\xBF" + problem_text + methods), "no error"); // as Windows writes it
  std::filesystem::create_directory(path() / "d.prm");
  try
  {
    (void)read_scene((path() / "d.prm").string());
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("cannot be read; give a .prm or .json file"),
              std::string::npos);
  }
  EXPECT_EQ(fault(""), "scene 'a.prm': Problem/load = manufactured needs Problem/solution; give "
                       "the solution, or the load itself");
}

TEST_F(SceneFile, in_json_takes_numbers_and_truth_values_and_says_what_it_does_not)
{
  const std::string methods_json = "\"Methods\": {\"names\": \"Q1\"}";
  EXPECT_EQ(fault("a.json", "{\"Problem\": {\"solution\": \"x\"}, " + methods_json +
                                ", \"Study\": {\"m\": 4, \"h\": 0.1}, \"Output\": {\"fields\": "
                                "true}}"),
            "no error");
  EXPECT_EQ(fault("a.json", "{\"Study\": {\"m\": [3, 4]}}"),
            "scene 'a.json', Study/m: is a list; give a text, a number, true or false; "
            "a list is a text with commas");
  EXPECT_EQ(fault("a.json", "{\"Study\": {\"m\": null}}"),
            "scene 'a.json', Study/m: is null; give a text, a number, true or false");
  EXPECT_EQ(fault("a.json", "{\n\"Study\": \n nonsense}"),
            "scene 'a.json', line 3: is not JSON from 'no' on; mend the file");
  EXPECT_EQ(fault("a.json", "{\n\"Study\": {"),
            "scene 'a.json', line 2: is not JSON: the text ends too early; mend the file");
  EXPECT_EQ(fault("a.json", "{\"Study\": {\"m\": 1e400}}"),
            "scene 'a.json', line 1: a number is beyond the range of double precision; mend the "
            "file");
  EXPECT_EQ(fault("a.json", "[]"), "scene 'a.json', line 1: is not a JSON object; write "
                                   "{\"Section\": {\"key\": \"value\"}}");
  EXPECT_EQ(fault("a.json", "{\"Study\": {\"m\": \"3 # 4\"}}")
                .find("scene 'a.json', Study/m: Study/m = '3 # 4' cannot be written in a scene"),
            0u);
}

TEST_F(SceneFile, nested_ever_deeper_is_refused)
{
  for (const std::string open : {"{\"a\":", "["})
  {
    std::string deep;
    for (int i = 0; i < 100000; ++i)
      deep += open;
    EXPECT_EQ(fault("a.json", deep),
              "scene 'a.json', line 1: is nested deeper than 64 levels; mend the file");
  }
  std::string sections;
  for (int i = 0; i < 100000; ++i)
    sections += "subsection a\n";
  EXPECT_EQ(fault(sections).find("scene 'a.prm', line 100000: subsection a is not closed"), 0u);
}
