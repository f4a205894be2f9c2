// The same command goes on where a run was interrupted, but only if nothing has changed.

#include "command.h"
#include "io/record_journal.h"
#include "io/results_json.h"

#include <chrono>
#include <string>

namespace
{
  using namespace plumbline::app;

  /// As a command leaves it that is killed when it has solved everything.
  void kill_at_end(const fs::path &folder)
  {
    const auto results = plumbline::io::read_results(folder / "results.json");
    plumbline::io::RecordJournal(folder / "results.jsonl",
                                 "# levels: 0, statics: \n" + results.scene_text)
        .append(results);
    fs::remove(folder / "results.json");
  }
} // namespace

TEST(CommandResume, goes_on_with_an_unfinished_run_of_the_same_scene_and_files_alone)
{
  const std::string check = std::string(PLUMBLINE_SCENES) + "/check/";
  const fs::path folder = temporary("resume");
  const std::string nodes = write("resume.csv", read(check + "nodes.csv"));
  const auto command = [&](const std::string &more)
  {
    return run("run " + check + "check.prm -o " + folder.string() +
               " --methods FA --set Domain/mesh=squares --set Study/regime=m --set Study/h=0.125 "
               "--set Study/horizon=0.375 --set Expected/verdicts= --set Methods/nodes=" +
               nodes + more);
  };
  const auto is_continued = [&](const std::string &more)
  {
    const Outcome outcome = command(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const bool is = outcome.err.find("continuing: 1 record in") != std::string::npos;
    kill_at_end(folder); // for the next one
    return is;
  };
  EXPECT_FALSE(is_continued(""));
  EXPECT_TRUE(is_continued(""));
  EXPECT_FALSE(is_continued(" --set Geometry/checks=7")); // another scene
  EXPECT_TRUE(is_continued(" --set Geometry/checks=7"));
  EXPECT_FALSE(is_continued(""));

  // what is in the file of nodes counts, not when it was written
  fs::last_write_time(nodes,
                      fs::last_write_time(folder / "results.jsonl") + std::chrono::seconds(1));
  EXPECT_TRUE(is_continued(""));
  const auto written = fs::last_write_time(nodes);
  std::ofstream(nodes, std::ios::app) << "\n";
  fs::last_write_time(nodes, written - std::chrono::hours(1));
  EXPECT_FALSE(is_continued(""));
  EXPECT_TRUE(is_continued(""));

  // what is complete is done again, as its user asks
  EXPECT_EQ(command("").exit_code, 0);
  EXPECT_FALSE(is_continued(""));
}
