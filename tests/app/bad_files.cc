// Files that are broken, hostile or no files at all, as a user meets them: exit codes, messages in
// our own words, no output.

#include "refusals.h"

#include <algorithm>

namespace
{
  using namespace plumbline::app;

  const std::string problem = "subsection Problem\n  set solution = x^2 + y\nend\n",
                    methods = "subsection Methods\n  set names = FA\nend\n";

  class BadFiles : public testing::Test
  {
  protected:
    BadFiles() : folder_(temporary("bad_files")) {}
    void SetUp() override { fs::create_directory(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder_ / name, std::ios::binary) << text;
      return (folder_ / name).string();
    }

    /// @return what it says
    std::string refused(const std::string &arguments) const
    {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
      EXPECT_EQ(outcome.out, "") << arguments;
      const std::string err = without_progress(outcome.err);
      EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << outcome.err;
      for (const std::string foreign :
           {"boost", "json.exception", "dealii", "Error loading", "unexpected error", "terminate"})
        EXPECT_EQ(outcome.err.find(foreign), std::string::npos) << outcome.err;
      return outcome.err;
    }
    std::string refused_scene(const std::string &name, const std::string &text) const
    {
      return refused("run " + write(name, text) + " -o " + output());
    }

    std::string output() const { return (folder_ / "out").string(); }

    const fs::path folder_;
  };
} // namespace

TEST_F(BadFiles, scenes_that_do_not_end_are_refused)
{
  expect_found(refused_scene("self.prm", problem + "include self.prm\n"),
               "self.prm', line 4: 'self.prm' is being read already, so that it would include "
               "itself; remove the line");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "{\"a\":";
  expect_found(refused_scene("deep.json", deep),
               "deep.json', line 1: is nested deeper than 64 levels; mend the file");
}

TEST_F(BadFiles, a_key_that_is_given_twice_is_refused_with_both_lines)
{
  expect_found(
      refused_scene("twice.prm", problem + methods + problem),
      "twice.prm', line 8: Problem/solution is given in line 2 already; remove one of them");
  expect_found(refused_scene("twice.json", "{\"Study\": {\"m\": 3,\n\"m\": 4}}"),
               "twice.json', line 2: the key 'm' comes twice in one object");
}

TEST_F(BadFiles, scenes_that_are_no_text_are_refused)
{
  expect_found(refused_scene("zero.prm", std::string("set Purpose = \0", 15)),
               "line 1: has the control character 0; give a plain text file");
  expect_found(refused_scene("latin.prm", problem + "# \xE4\n"), "line 4: has a character that is");
  expect_found(refused("run " + folder_.string()), "cannot be read; give a .prm or .json file");
  expect_found(refused("run " + write("results.prm", "{\"schema\": 4}")), "is not understood");
  expect_found(refused_scene("list.json", "[1, 2]"), "is not a JSON object");
  expect_found(refused_scene("empty.json", ""), "is not JSON: the text ends too early");
}

TEST_F(BadFiles, scenes_from_windows_run)
{
  std::string text = "\xEF\xBB\xBF" + problem + methods + "subsection Study\n set h = 0.25\nend\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  const Outcome outcome = run("run " + write("windows.prm", text) + " --quiet -o " + output());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadFiles, scenes_from_a_pipe_run)
{
  const std::string text = problem + methods + "subsection Study\n set h = 0.25\nend\n";
  const std::string json = "{\"Problem\": {\"solution\": \"x\"}, \"Methods\": {\"names\": "
                           "\"FA\"}, \"Study\": {\"h\": 0.25}}";
  for (const std::string &file : {write("piped.prm", text), write("piped.json", json)})
  {
    const std::string to = " run /dev/stdin --quiet -o " + output() + " 2>&1";
    EXPECT_EQ(std::system(("cat " + file + " | " PLUMBLINE_COMMAND + to).c_str()), 0) << file;
    expect_found(read(fs::path(output()) / "results.json"), "\"scene\": \"stdin\"");
    fs::remove_all(output());
  }
  const int status =
      std::system(("cat " + write("sampled.prm", text) +
                   " | " PLUMBLINE_COMMAND " sample /dev/stdin -o " + output() + " 2>/dev/null")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(BadFiles, threads_of_the_environment_that_are_no_number_are_refused)
{
  for (const std::string value : {"0", "-1", "many", "2x", ""})
  {
    const std::string err = output() + ".err";
    const int status = std::system(
        ("DEAL_II_NUM_THREADS=" + value + " " PLUMBLINE_COMMAND " --version >/dev/null 2>" + err)
            .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << value;
    expect_found(read(err), "DEAL_II_NUM_THREADS must be a whole number from 1");
    fs::remove(err);
  }
  EXPECT_EQ(std::system("DEAL_II_NUM_THREADS=1 " PLUMBLINE_COMMAND " --version >/dev/null"), 0);
}

TEST_F(BadFiles, numbers_that_are_none_are_refused)
{
  const std::string scene = write("scene.prm", problem + methods);
  for (const std::string h : {"nan", "1e400", "inf", "-1", "0", "0.1.2", "1e"})
  {
    const std::string said = refused("run " + scene + " -o " + output() + " " + set("Study/h", h));
    EXPECT_TRUE(said.find("Study/h = '" + h + "' is not allowed") != std::string::npos ||
                said.find("Study/h = " + h + " must be a positive length") != std::string::npos)
        << said;
  }
  expect_found(refused("run " + scene + " -o " + output() + " " + set("Study/h", "1e-300")),
               "h = 1e-300");
  expect_found(refused("run " + scene + " -o " + output() + " " + set("Study/m", "1e308")),
               "mesh sizes, more than 2000");
}

TEST_F(BadFiles, expressions_are_refused_in_our_words)
{
  const std::string scene = write("scene.prm", problem + methods);
  const auto said = [&](const std::string &expression) {
    return refused("run " + scene + " -o " + output() + " " + set("Problem/solution", expression));
  };
  const std::string opening = "Problem/solution = ";
  expect_found(said("x +* y"),
               opening + "'x +* y' does not parse: an operator stands where a value");
  expect_found(said("sin(x"), "does not parse: a bracket is not closed; write");
  expect_found(said("x +"),
               "does not parse: it ends where a number, a name or a bracket is missing");
  expect_found(said("x + z"),
               "does not parse: there is an unknown name or sign 'z' at character 5");
  expect_found(said("2 x"), "does not parse: an operator is missing before 'x' at character 3");
  expect_found(said("sin()"), "does not parse: there are too few arguments of 'sin'");
  expect_found(said("x > 0 ? 1"), "does not parse: a condition is not of the form a ? b : c");
  expect_found(said("\"x\""), "does not parse: there are quotes, and values are numbers");
  expect_found(said("min(x, y)) + 1"), "does not parse: there is a bracket too many");
}

TEST_F(BadFiles, scripts_cannot_start_programs_or_run_for_ever)
{
  const std::string scene =
      write("scene.prm", "subsection Domain\n set mesh = a.geo\nend\n" + problem + methods);
  const fs::path mark = folder_ / "started";
  write("a.geo", "SystemCall \"touch " + mark.string() + "\";\n");
  expect_found(refused("run " + scene + " -o " + output()),
               "a.geo', line 1: SystemCall would start a program, which meshes may not; take the "
               "command out");
  EXPECT_FALSE(fs::exists(mark));
  write("a.geo", "For i In {0 : 1e12}\n a = i;\nEndFor\n");
  setenv("PLUMBLINE_GMSH_SECONDS", "1", 1);
  expect_found(
      refused("run " + scene + " -o " + output()),
      "a.geo': gmsh was ended after 1 CPU seconds; mend a loop that does not end, choose a "
      "larger h, or set the environment's PLUMBLINE_GMSH_SECONDS");
  unsetenv("PLUMBLINE_GMSH_SECONDS");
}

TEST_F(BadFiles, results_that_are_broken_are_refused)
{
  const auto said = [&](const std::string &text)
  {
    write("results.json", text);
    return refused("report " + folder_.string());
  };
  expect_found(said("{\"schema\": 1e400}"),
               "results.json', line 1: a number is beyond the range of double precision; run the "
               "scene again");
  expect_found(said("{\"schema\": null}"), "schema is not a whole number");
  expect_found(said(""), "line 1: is not JSON: the text ends too early; run the scene again");
  expect_found(said("\n\nnone"), "line 3: is not JSON from 'no' on; run the scene again");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "[";
  expect_found(said(deep), "is nested deeper than 64 levels; run the scene again");
  fs::remove(folder_ / "results.json");
  fs::create_directory(folder_ / "results.json");
  expect_found(refused("report " + folder_.string()), "cannot be read; give the folder that");
}

TEST_F(BadFiles, arguments_are_refused_in_our_words)
{
  expect_found(refused("fly"), "plumbline: no known command is given; write plumbline run");
  expect_found(refused(""), "plumbline: no known command is given; write plumbline run SCENE, or "
                            "another command: run, ");
  expect_found(refused("run"),
               "plumbline: SCENE is missing; 'plumbline run --help' lists the arguments");
  expect_found(refused("run a.prm --fast"),
               "the argument '--fast' is not known; 'plumbline run --help' lists the arguments");
  expect_found(refused("run a.prm --levels many"),
               "the value of --levels = many is not of the right");
  expect_found(refused("run a.prm --threads -1"), "give a whole number, 0 or greater");
  expect_found(refused("run a.prm --budget some"), "give a number such as 0.5");
  expect_found(refused("run a.prm --levels"), "--levels has no value, or too many");
}
