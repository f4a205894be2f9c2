#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <string>
#include <vector>

namespace plumbline::app
{
  /// What is wrong with the arguments of the command, and the remedy.
  /// @param app  after it has tried to parse them
  std::string explain(const CLI::ParseError &error, const CLI::App &app);

  /// The numbers that were given for an option, separated by commas, semicolons or blanks.
  /// @throws InputError  what is no number; no numbers at all
  std::vector<double> to_numbers(const std::string &option, const std::vector<std::string> &given);

  /// The same, three numbers for each vector.
  /// @throws InputError  another number of numbers, too
  std::vector<std::array<double, 3>> to_vectors(const std::string &option,
                                                const std::vector<std::string> &given);

  /// Arguments with all numbers that follow an option in one argument, e.g. --angles 0 -45 as
  /// --angles=0,-45.
  std::vector<std::string> join_numbers(const std::vector<std::string> &arguments,
                                        const std::string &option);
} // namespace plumbline::app
