// What a page of motions advises, and what is kept of a run that was killed.
#include "report/dynamics_tables.h"
#include "report/motion_journal.h"
#include "report/motion_json.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

using namespace plumbline;

namespace
{
  study::MotionRun motion(unsigned int level, double step, double error, double seconds)
  {
    study::MotionRun run;
    run.method = "FA";
    run.scheme = "velocity Verlet";
    run.level = level;
    run.step = step;
    run.errors["nodal L2 | exact"] = error;
    run.cost.solve_seconds = seconds;
    return run;
  }
} // namespace

TEST(DynamicsReport, best_runs_are_those_that_no_other_beats_in_error_and_time)
{
  study::DynamicResults results;
  results.decisive_error = "nodal L2 | exact";
  results.runs = {motion(0, .1, 1e-2, 1), motion(0, .05, 5e-3, 2), motion(1, .1, 6e-3, 3),
                  motion(1, .05, 1e-3, 4)};
  const auto best = report::best_runs(results);
  ASSERT_EQ(best.size(), 3u); // the third is dearer and worse than the second
  EXPECT_EQ(best[0], &results.runs[0]);
  EXPECT_EQ(best[1], &results.runs[1]);
  EXPECT_EQ(best[2], &results.runs[3]);
  results.variable = "a"; // of its values some are easier than others
  EXPECT_TRUE(report::best_runs(results).empty());
}

TEST(DynamicsReport, best_runs_are_none_whose_errors_cancel)
{
  study::DynamicResults results;
  results.decisive_error = "nodal L2 | exact";
  results.runs = {motion(0, .1, 1e-5, 1), motion(0, .05, 5e-3, 2), motion(0, .025, 5.01e-3, 4)};
  const auto best = report::best_runs(results);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_EQ(best[0], &results.runs[1]); // that the shortest step is a little worse is no luck
}

namespace
{
  namespace fs = std::filesystem;

  /// What a scene's run begins with.
  study::DynamicResults begun()
  {
    study::DynamicResults results;
    results.scene_name = "s";
    results.scene_text = "set a = 1\n";
    return results;
  }

  study::MotionRun whole_motion()
  {
    study::MotionRun run = motion(2, 1. / 3, 1e-17 / 7, .25);
    run.family = study::MethodFamily::meshfree;
    run.problem = "case1";
    run.series = "m = 3";
    run.steps = "dt = 0.3333";
    run.h = .1 / 3;
    run.horizon = .1;
    run.critical_step = std::numeric_limits<double>::infinity();
    run.counts = {3, 4, 5, 6};
    run.cost.setup_seconds = .5;
    run.size = 2. / 3;
    run.errors["nodal Linf | exact"] = std::nan("");
    run.energies = {{0, 1. / 3, 2. / 3, 0, 0}, {.5, std::nan(""), 1e300, -1. / 7, 5e-324}};
    run.history = {1. / 9, std::nan("")};
    run.imbalance = .1;
    run.facts["bonds"] = 36;
    run.failure = "it \"ended\"";
    return run;
  }

  std::string text_of(const study::MotionRun &run)
  {
    return report::motion_json(run).dump();
  }

  fs::path folder_of(const std::string &name)
  {
    fs::path folder = fs::temp_directory_path() / ("plumbline_" + name + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }
} // namespace

TEST(MotionJournal, gives_back_every_bit_of_what_is_finished)
{
  const fs::path folder = folder_of("journal");
  study::DynamicResults results = begun();
  results.references = {{"case1", .2, 36, 1e-9 / 3, 2.5}};
  results.runs = {whole_motion()};
  report::MotionJournal journal(folder);
  journal.append(results);
  results.runs.push_back(motion(3, .1, .2, .3));
  journal.append(results);
  const auto back = report::read_motions(folder, begun());
  ASSERT_EQ(back.runs.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(text_of(back.runs[i]), text_of(results.runs[i]));
  EXPECT_TRUE(std::isinf(back.runs[0].critical_step));
  EXPECT_TRUE(std::isnan(back.runs[0].energies[1].kinetic));
  EXPECT_EQ(back.runs[0].energies[1].work, -1. / 7);
  EXPECT_EQ(back.runs[0].energies[1].dissipated, 5e-324);
  EXPECT_EQ(back.runs[0].counts.n_newton, 6u);
  EXPECT_EQ(back.runs[1].step, .1);
  ASSERT_EQ(back.references.size(), 1u);
  EXPECT_EQ(back.references[0].estimate, 1e-9 / 3);
  EXPECT_EQ(back.references[0].n_points, 36u);
  journal.remove();
  EXPECT_TRUE(report::read_motions(folder, begun()).runs.empty());
  fs::remove_all(folder);
}

TEST(MotionJournal, leaves_out_a_cut_line_and_what_is_of_another_scene_or_no_journal)
{
  const fs::path folder = folder_of("cut"), file = folder / "dynamics.jsonl";
  study::DynamicResults results = begun();
  results.runs = {whole_motion(), motion(3, .1, .2, .3)};
  report::MotionJournal(folder).append(results);
  fs::resize_file(file, fs::file_size(file) - 5);
  EXPECT_EQ(report::read_motions(folder, begun()).runs.size(), 1u);

  study::DynamicResults other = begun();
  other.scene_text += "set b = 2\n";
  EXPECT_TRUE(report::read_motions(folder, other).runs.empty());
  other = begun();
  other.n_levels = 1; // which level is the finest decides what is measured there
  EXPECT_TRUE(report::read_motions(folder, other).runs.empty());
  for (const std::string text : {"", "{", "[1]\n", "\n\n", "{\"version\": 1}\n{\"method\": 1}\n"})
  {
    std::ofstream(file) << text;
    EXPECT_TRUE(report::read_motions(folder, begun()).runs.empty()) << text;
  }
  fs::remove_all(folder);
}
