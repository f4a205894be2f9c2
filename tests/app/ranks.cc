// The command on several ranks: none waits for another, and one of them speaks.
#include "command.h"

namespace
{
  using namespace plumbline::app;

  std::size_t count(const std::string &text, const std::string &part)
  {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }

  std::string small_scene(const std::string &mesh)
  {
    return write("ranks_" + mesh + ".prm",
                 "subsection Domain\n set mesh = " + mesh +
                     "\nend\nsubsection Problem\n set solution = x^2 + y^2\nend\n"
                     "subsection Methods\n set names = FA, Q1\nend\n"
                     "subsection Study\n set h = 0.1, 0.05, 0.025\nend\n");
  }
} // namespace

TEST(Ranks, agree_on_a_budget_on_lattices_and_say_that_they_repeat_the_work)
{
  const fs::path folder = temporary("ranks");
  const std::string scene = small_scene("lattice") + " --threads 1 -o " + folder.string();
  // some solves take longer than the budget on one of the ranks and not on the other
  const Outcome outcome = run_on_two_ranks("run " + scene + " --budget 0.002");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count(outcome.err, "note: each of the 2 ranks repeats all of the work, since lattices "
                               "are not shared among them"),
            1u)
      << outcome.err;
  expect_found(read(folder / "results.json"), "\"work of ranks\": \"repeated by each");
  fs::remove_all(folder);
}

TEST(Ranks, share_meshes_without_a_word)
{
  const fs::path folder = temporary("ranks");
  const Outcome outcome = run_on_two_ranks("run " + small_scene("squares") +
                                           " --threads 1 --levels 2 --quiet -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read(folder / "results.json").find("work of ranks"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Ranks, refuse_with_one_voice)
{
  const Outcome outcome =
      run_on_two_ranks("run " + small_scene("lattice") + " --set Study/h=0.3 --threads 1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(count(outcome.err, "plumbline: scene "), 1u) << outcome.err;
}

TEST(Ranks, end_where_the_page_cannot_be_written)
{
  const fs::path folder = temporary("ranks");
  fs::create_directories(folder / "report.html"); // a folder in its place
  const Outcome outcome = run_on_two_ranks("run " + small_scene("squares") +
                                           " --threads 1 --levels 1 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err,
               "output file '" + (folder / "report.html").string() + "' cannot be written");
  fs::remove_all(folder);
}
