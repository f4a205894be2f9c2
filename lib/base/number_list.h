#pragma once

#include <array>
#include <string>
#include <vector>

namespace plumbline::base
{
  /// The numbers that were given for an option, separated by commas, semicolons or blanks.
  /// @throws InputError  what is no number; no numbers at all
  std::vector<double> to_numbers(const std::string &option, const std::vector<std::string> &given);

  /// The same, three numbers for each vector.
  /// @throws InputError  also if the count is not a multiple of three
  std::vector<std::array<double, 3>> to_vectors(const std::string &option,
                                                const std::vector<std::string> &given);

  /// A text of numbers alone.
  bool is_numbers(const std::string &text);
} // namespace plumbline::base
