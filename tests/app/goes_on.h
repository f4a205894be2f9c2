// What a command does that was killed before.
#pragma once

#include <string>

namespace plumbline::app
{
  /// A command that is killed at its first line ends as one that nothing disturbs, to the last bit.
  /// @param name  of its files: NAME.jsonl, NAME.json with records
  void expect_to_go_on(const std::string &command, const std::string &name);
} // namespace plumbline::app
