#include "base/workers.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

using namespace plumbline::base;
namespace fs = std::filesystem;

namespace
{
  constexpr const char *folder_variable = "WORKERS_TEST_FOLDER",
                       *code_variable = "WORKERS_TEST_CODE";

  struct Outcome
  {
    std::vector<BadEnding> endings;
    std::set<std::uint64_t> finished;
  };

  /// Two workers of eight tasks, the first of which ends its worker with this exit code.
  Outcome work_off_with(int exit_code)
  {
    const fs::path folder =
        fs::temp_directory_path() / ("plumbline_workers_" + std::to_string(getpid()));
    fs::create_directories(folder);
    setenv(folder_variable, folder.c_str(), 1);
    setenv(code_variable, std::to_string(exit_code).c_str(), 1);
    Outcome outcome;
    outcome.endings = work_off({0, 1, 2, 3, 4, 5, 6, 7}, 2,
                               {"--gtest_also_run_disabled_tests",
                                "--gtest_filter=Workers.DISABLED_work", "--gtest_brief=1"},
                               [](std::size_t) { return true; });
    for (const auto &file : fs::directory_iterator(folder))
      outcome.finished.insert(std::stoul(file.path().filename()));
    fs::remove_all(folder);
    return outcome;
  }
} // namespace

/// What a worker of the next test does.
TEST(Workers, DISABLED_work)
{
  const char *const folder = std::getenv(folder_variable), *const code = std::getenv(code_variable);
  ASSERT_TRUE(folder != nullptr && code != nullptr) << "it is not run by itself";
  for (std::uint64_t task = 0; next_task(task);)
  {
    if (task == 0)
      _exit(std::atoi(code));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::ofstream(fs::path(folder) / std::to_string(task));
  }
}

TEST(Workers, go_on_without_one_that_ends_with_an_exit_code_but_bad_input_ends_all)
{
  const std::set<std::uint64_t> others = {1, 2, 3, 4, 5, 6, 7};
  const Outcome failed = work_off_with(3);
  EXPECT_EQ(failed.finished, others);
  ASSERT_EQ(failed.endings.size(), 1u);
  EXPECT_EQ(failed.endings[0].exit_code, 3);
  EXPECT_EQ(failed.endings[0].how, "ended with exit code 3");
  const Outcome refused = work_off_with(2);
  EXPECT_LT(refused.finished.size(), others.size());
  ASSERT_EQ(refused.endings.size(), 1u);
  EXPECT_EQ(refused.endings[0].exit_code, 2);
}

TEST(WorkersDeathTest, end_at_once_where_their_parent_has_ended)
{
  const auto end_with = [](pid_t parent)
  {
    setenv("PLUMBLINE_PARENT", std::to_string(parent).c_str(), 1);
    end_with_parent();
    _exit(0);
  };
  EXPECT_EXIT(end_with(getpid()), testing::KilledBySignal(SIGTERM), ""); // not that of a child
  EXPECT_EXIT(end_with(getppid()), testing::ExitedWithCode(0), "");
}
