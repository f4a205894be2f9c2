#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace plumbline::base
{
  /// The words of an enum's values in their order, for choices by words as in scene files: to be
  /// specialised beside the enum.
  template <class Enum>
  inline constexpr std::array<const char *, 0> words{};

  template <class Enum>
  std::string word(Enum choice)
  {
    return words<Enum>[static_cast<std::size_t>(choice)];
  }

  /// The choice that a word stands for, if there is one.
  template <class Enum>
  std::optional<Enum> from_word(const std::string &word)
  {
    const auto found = std::find(words<Enum>.begin(), words<Enum>.end(), word);
    if (found == words<Enum>.end())
      return {};
    return static_cast<Enum>(found - words<Enum>.begin());
  }
} // namespace plumbline::base
