// What a command does that was killed before.
#pragma once

#include "command.h"

#include <nlohmann/json.hpp>

namespace plumbline::app
{
  /// A command that is killed at its first line ends as one that nothing disturbs, to the last bit.
  /// @param name  of its files: NAME.jsonl, NAME.json with levels
  inline void expect_to_go_on(const std::string &command, const std::string &name)
  {
    const fs::path folder = temporary(name), whole = temporary(name + "_whole");
    ASSERT_EQ(run(command + " --quiet -o " + whole.string()).exit_code, 0);
    EXPECT_FALSE(fs::exists(whole / (name + ".jsonl")));
    ASSERT_TRUE(kill_at(command + " --quiet -o " + folder.string(), folder / (name + ".jsonl")));
    EXPECT_FALSE(fs::exists(folder / (name + ".json")));
    const Outcome next = run(command + " -o " + folder.string());
    ASSERT_EQ(next.exit_code, 0) << next.err;
    EXPECT_NE(next.err.find("continuing: "), std::string::npos) << next.err;
    auto levels = nlohmann::json::parse(read(folder / (name + ".json")))["levels"],
         others = nlohmann::json::parse(read(whole / (name + ".json")))["levels"];
    for (auto *list : {&levels, &others})
      for (auto &level : *list)
        level.erase("seconds");
    EXPECT_EQ(levels, others);
    fs::remove_all(folder);
    fs::remove_all(whole);
  }
} // namespace plumbline::app
