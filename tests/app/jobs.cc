// Worker processes (--jobs) and ranks share methods and levels of `run` and other analyses: the
// same numbers, whatever happens to the processes.

#include "command.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sys/wait.h>
#include <thread>

namespace
{
  using namespace plumbline::app;
  using Json = nlohmann::json;

  /// Without what each run measures anew: times, memory, and the machine.
  Json untimed(const fs::path &file)
  {
    Json json = read_json(file);
    for (const char *const name : {"provenance", "advice", "facts"})
      json.erase(name);
    for (Json &record : json["records"])
    {
      for (const char *const name : {"setup_seconds", "solve_seconds", "peak_bytes"})
        record["cost"].erase(name);
      for (Json &scalars : {std::ref(record["scalars"])})
        for (auto one = scalars.begin(); one != scalars.end();)
          one = one.key().find("seconds") != std::string::npos ? scalars.erase(one) : ++one;
    }
    for (Json &saving : json["savings"])
      for (const char *const name : {"smallest", "full"})
        saving.erase(name);
    return json;
  }

  const std::string reference = "run " + std::string(PLUMBLINE_SCENES) +
                                "/ipa_ac/scalar_delta_convergence.prm --threads 1 --quiet --set "
                                "Study/m=2 --set Study/h=0.25,0.125 --set Expected/verdicts= "
                                "--set Expected/errors= ",
                    long_run = "run " + std::string(PLUMBLINE_SCENES) +
                               "/ipa_ac/scalar_delta_convergence.prm --threads 1 --quiet --methods "
                               "FA,PA-AC,Q1,Q2,DGQ1 --set Study/m=3 --set "
                               "Expected/verdicts= --set Expected/errors= ";

  std::size_t n_stored(const fs::path &folder)
  {
    const fs::path journal = folder / "results.jsonl";
    const std::string text = fs::exists(journal) ? read(journal) : "";
    return std::count(text.begin(), text.end(), '\n');
  }

  /// Until the head and this many records are stored.
  void wait_for_records(const fs::path &folder, std::size_t n)
  {
    for (int i = 0; i < 30000 && n_stored(folder) < n + 2; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  int exit_code_of(pid_t process)
  {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::size_t count(const std::string &text, const std::string &part)
  {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at)
      ++n;
    return n;
  }
} // namespace

TEST(Jobs, give_the_same_bits_as_one_process_by_workers_and_ranks)
{
  const std::string scenes = std::string(PLUMBLINE_SCENES);
  const fs::path one = temporary("one"), two = temporary("two"), ranks = temporary("two_ranks");
  for (const auto &[command, file] :
       {std::pair{reference + "--methods FA,IPA-AC-R2,Q1", "results"},
        {reference + "--methods IPA-AC-R2,Q1 --set Reference/method=Q2 --set 'Study/decisive "
                     "error=averages L2 | reference' --set Output/points=0.5,0.5",
         "results"},
        {reference + "--methods FA,IPA-AC-R2 --budget 1000", "results"},
        {"run " + scenes +
             "/line/delta_convergence.prm --threads 1 --quiet --levels 1 --methods FA,Q1 "
             "--set Expected/verdicts= --set Expected/errors=",
         "results"},
        {"stability " + scenes +
             "/ipa_ac/scalar_delta_convergence.prm --quiet --levels 2 --methods FA,Q1 --set "
             "Study/m=2",
         "stability"}})
  {
    ASSERT_EQ(run(command + " -o " + one.string()).exit_code, 0) << command;
    const Outcome outcome = run(command + " --jobs 2 -o " + two.string());
    EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
    EXPECT_EQ(without_progress(outcome.err), "") << command;
    const std::string name = std::string(file) + ".json";
    EXPECT_EQ(untimed(one / name), untimed(two / name)) << command;
    const Outcome of_ranks = run_on_two_ranks(command + " -o " + ranks.string());
    EXPECT_EQ(of_ranks.exit_code, 0) << command << of_ranks.err;
    EXPECT_EQ(of_ranks.err, "") << command;
    EXPECT_EQ(of_ranks.out, "") << command;
    EXPECT_EQ(untimed(one / name), untimed(ranks / name)) << command;
    EXPECT_EQ(read_json(ranks / name)["provenance"]["work of ranks"],
              "methods and levels are distributed: one rank computes each of them");
    for (const fs::path &many : {two, ranks})
    {
      EXPECT_FALSE(fs::exists(many / (std::string(file) + ".jsonl")));
      if (fs::exists(one / "points"))
      {
        for (const auto &points : fs::directory_iterator(one / "points"))
          EXPECT_EQ(read(points.path()), read(many / "points" / points.path().filename()))
              << points.path();
      }
    }
    for (const fs::path &folder : {one, two, ranks})
      fs::remove_all(folder);
  }
}

TEST(Jobs, read_the_arguments_of_the_command_in_the_same_way)
{
  const std::string scene = std::string(PLUMBLINE_SCENES) + "/ipa_ac/scalar_delta_convergence.prm",
                    set = " --quiet --methods FA --set Study/m=2 --set Expected/verdicts= --set "
                          "Expected/errors= --set Study/h=0.25,0.125 ";
  const fs::path folder = temporary("arguments");
  const std::string base = "run --jobs 2 -o " + folder.string();
  for (const std::string &command :
       {base + set + scene,                  // the last value could take in SCENE
        base + " --threads 0" + set + scene, // which workers are given a number for
        base + set + "--threads=0 " + scene, base + set + "-- " + scene})
  {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.err;
    EXPECT_TRUE(read_json(folder / "results.json")["is_complete"]) << command;
    fs::remove_all(folder);
  }
}

TEST(Jobs, go_on_after_a_kill_and_an_interrupt_with_what_is_finished)
{
  const fs::path folder = temporary("killed");
  const std::string command = long_run + "--jobs 2 -o " + folder.string();
  const pid_t killed = start(command);
  wait_for_records(folder, 1);
  kill(killed, SIGKILL);
  exit_code_of(killed);
  const std::size_t n_before = n_stored(folder);
  ASSERT_GE(n_before, 3u);
  const fs::path err = temporary("err");
  const pid_t interrupted = start(command, err.string());
  wait_for_records(folder, n_before);
  kill(interrupted, SIGINT);
  EXPECT_EQ(exit_code_of(interrupted), 130);
  expect_found(read(err), "ending the worker processes");
  const Json part = read_json(folder / "results.json");
  EXPECT_FALSE(part["is_complete"]);
  EXPECT_GE(part["records"].size(), 1u);
  const Outcome rest = run(command);
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  const Json all = untimed(folder / "results.json");
  EXPECT_TRUE(all["is_complete"]);
  fs::remove_all(folder);
  ASSERT_EQ(run(long_run + "-o " + folder.string()).exit_code, 0);
  EXPECT_EQ(all, untimed(folder / "results.json"));
  fs::remove_all(folder);
  fs::remove(err);
}

TEST(Jobs, tell_once_that_a_worker_has_died_and_finish_what_the_others_can)
{
  const fs::path folder = temporary("died"), err = temporary("err");
  const pid_t command = start(long_run + "--jobs 2 -o " + folder.string(), err.string());
  wait_for_records(folder, 3); // Galerkin methods of the finest level take longer than rules
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const std::string process = std::to_string(command);
  std::istringstream workers(read("/proc/" + process + "/task/" + process + "/children"));
  pid_t worker = 0;
  ASSERT_TRUE(workers >> worker);
  kill(worker, SIGKILL);
  EXPECT_EQ(exit_code_of(command), 3);
  const std::string said = read(err);
  EXPECT_EQ(count(said, "a worker process (--jobs) was ended by a signal (Killed); if a task is "
                        "missing, run the same command again"),
            1u)
      << said;
  EXPECT_EQ(count(said, "interrupted"), 0u) << said;
  EXPECT_FALSE(read_json(folder / "results.json")["is_complete"]);
  const Outcome rest = run(long_run + "-o " + folder.string()); // by this process alone
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_TRUE(read_json(folder / "results.json")["is_complete"]);
  fs::remove_all(folder);
  fs::remove(err);
}

TEST(Jobs, are_refused_where_processes_cannot_share)
{
  expect_refused(reference + "--jobs 2 --set 'Study/decisive error=averages L2 | own finest level'",
                 "--jobs = 2: each method is compared with its own finest level");
  expect_refused("crack --jobs 2 " + std::string(PLUMBLINE_SCENES) + "/griffith/branching.prm",
                 "the argument '--jobs ");
}
