// A folder holds what belongs together: of one scene, by one process at a time.
#include "command.h"

#include <fcntl.h>
#include <sys/file.h>

#include <set>

namespace
{
  using namespace plumbline::app;

  std::string scene(const std::string &name, const std::string &methods)
  {
    const fs::path file = temporary("scenes") / (name + ".prm");
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "subsection Problem\n set solution = x^2 + y^2\nend\n"
                           "subsection Methods\n set names = "
                        << methods << "\nend\nsubsection Study\n set h = 0.25, 0.125\nend\n";
    return file.string();
  }

  std::set<std::string> files(const fs::path &folder)
  {
    std::set<std::string> names;
    for (const auto &file : fs::recursive_directory_iterator(folder))
      if (!file.is_directory())
        names.insert(file.path().lexically_relative(folder).string());
    return names;
  }

  void expect_run(const std::string &arguments, const fs::path &folder)
  {
    const Outcome outcome = run(arguments + " --quiet -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
} // namespace

TEST(OutputFolder, of_another_scene_is_as_if_it_had_been_empty)
{
  const fs::path folder = temporary("shared"), fresh = temporary("fresh");
  expect_run("run " + scene("one", "FA, Q1, IPA-AC-R2") + " --set Output/fields=true", folder);
  expect_run("dispersion " + scene("one", "FA, Q1"), folder);
  std::ofstream(folder / "notes.txt") << "mine";
  const std::string other = "run " + scene("other", "FA");
  const Outcome outcome = run(other + " --quiet -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.err, "held results of another scene (run of one, dispersion of one)");
  expect_run(other, fresh);
  std::set<std::string> expected = files(fresh);
  expected.insert("notes.txt"); // no command wrote it
  EXPECT_EQ(files(folder), expected);
  EXPECT_EQ(read(folder / "notes.txt"), "mine");
  fs::remove_all(folder);
  fs::remove_all(fresh);
}

TEST(OutputFolder, keeps_nothing_that_the_same_scene_wrote_before_it_was_changed)
{
  const fs::path folder = temporary("changed"), fresh = temporary("fresh");
  const std::string name = scene("one", "FA, Q1, IPA-AC-R2");
  expect_run("dispersion " + name, folder);
  const auto of_dispersion = files(folder);
  expect_run("run " + name, folder);
  expect_run("run " + name + " --methods FA", folder);
  expect_run("run " + name + " --methods FA", fresh);
  std::set<std::string> expected = files(fresh);
  expected.insert(of_dispersion.begin(), of_dispersion.end()); // of the same scene, by its name
  EXPECT_EQ(files(folder), expected);
  fs::remove_all(folder);
  fs::remove_all(fresh);
}

TEST(OutputFolder, is_for_one_process_at_a_time)
{
  const fs::path folder = temporary("locked");
  fs::create_directory(folder);
  const int lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  const std::string name = scene("one", "FA");
  for (const std::string command : {"run ", "dispersion ", "stability "})
  {
    const Outcome outcome = run(command + name + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, 2);
    expect_found(outcome.err, "is in use by another process of plumbline; wait for its end");
    EXPECT_TRUE(fs::is_empty(folder));
  }
  close(lock);
  expect_run("run " + name, folder);
  fs::remove_all(folder);
}

TEST(OutputFolder, keeps_what_no_command_wrote_however_often_it_is_used)
{
  const fs::path folder = temporary("mine");
  fs::create_directories(folder / "charts");
  for (const char *const name : {"notes.txt", "charts/own.svg"})
    std::ofstream(folder / name) << "mine";
  for (const std::string name : {"one", "other", "one"})
    expect_run("run " + scene(name, "FA"), folder);
  for (const char *const name : {"notes.txt", "charts/own.svg"})
    EXPECT_EQ(read(folder / name), "mine");
  fs::remove_all(folder);
}

TEST(OutputFolder, is_left_as_it_was_by_what_is_refused)
{
  const fs::path folder = temporary("refused_later");
  expect_run("run " + scene("one", "FA"), folder);
  const auto before = files(folder);
  const Outcome outcome =
      run("run " + scene("other", "FA") + " --set Study/h=0.3 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(files(folder), before);
  fs::remove_all(folder);
}
