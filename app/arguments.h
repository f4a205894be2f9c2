#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace plumbline::app
{
  /// What is wrong with the arguments of the command, and the remedy.
  /// @param app  after it has tried to parse them
  std::string explain(const CLI::ParseError &error, const CLI::App &app);

  /// Arguments with all numbers that follow an option in one argument, e.g. --angles 0 -45 as
  /// --angles=0,-45.
  std::vector<std::string> join_numbers(const std::vector<std::string> &arguments,
                                        const std::string &option);
} // namespace plumbline::app
