#include "goes_on.h"

#include "command.h"

#include <nlohmann/json.hpp>

namespace plumbline::app
{
  void expect_to_go_on(const std::string &command, const std::string &name)
  {
    const fs::path folder = temporary(name), whole = temporary(name + "_whole");
    ASSERT_EQ(run(command + " --quiet -o " + whole.string()).exit_code, 0);
    EXPECT_FALSE(fs::exists(whole / (name + ".jsonl")));
    ASSERT_TRUE(kill_at(command + " --quiet -o " + folder.string(), folder / (name + ".jsonl")));
    EXPECT_FALSE(fs::exists(folder / (name + ".json")));
    const Outcome next = run(command + " -o " + folder.string());
    ASSERT_EQ(next.exit_code, 0) << next.err;
    EXPECT_NE(next.err.find("continuing: "), std::string::npos) << next.err;
    const auto results_in = [&](const fs::path &place)
    {
      const auto json = read_json(place / (name + ".json"));
      auto results = json.value("records", nlohmann::json());
      EXPECT_FALSE(results.empty());
      for (auto &one : results)
      {
        for (const char *measured : {"setup_seconds", "solve_seconds", "peak_bytes"})
          one["cost"].erase(measured);
      }
      return results;
    };
    EXPECT_EQ(results_in(folder), results_in(whole));
    fs::remove_all(folder);
    fs::remove_all(whole);
  }
} // namespace plumbline::app
