#include "base/number_list.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace plumbline::base
{
  namespace
  {
    constexpr auto separators = ",; \t\n";

    std::vector<std::string> words_of(const std::string &text)
    {
      std::vector<std::string> words;
      for (std::size_t end = 0, begin = 0;
           (begin = text.find_first_not_of(separators, end)) != std::string::npos;)
      {
        end = std::min(text.find_first_of(separators, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
      }
      return words;
    }

    std::optional<double> to_number(const std::string &word)
    {
      char *end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      return word.empty() || *end != 0 || !std::isfinite(value) ? std::nullopt
                                                                : std::optional(value);
    }
  } // namespace

  bool is_numbers(const std::string &text)
  {
    const auto words = words_of(text);
    return !text.empty() &&
           std::all_of(words.begin(), words.end(),
                       [](const std::string &word) { return to_number(word).has_value(); });
  }

  std::vector<double> to_numbers(const std::string &option, const std::vector<std::string> &given)
  {
    std::vector<double> numbers;
    for (const std::string &text : given)
    {
      const std::vector<std::string> words = words_of(text);
      for (const std::string &word : words)
        if (&word != &words.front() && word.size() > 1 && word[0] == '0' && word[1] != '.')
          throw InputError(
              option + ": '" + text +
              "' looks like a number with a decimal comma; write 3.015, not 3,015, and "
              "separate numbers by blanks or ', '");
        else if (const auto number = to_number(word))
          numbers.push_back(*number);
        else
          throw InputError(option + ": '" + word +
                           "' is not a number; give numbers separated by commas, semicolons or "
                           "blanks");
    }
    if (numbers.empty())
      throw InputError(option + " has no numbers; give one or more, or leave it out");
    return numbers;
  }

  std::vector<std::array<double, 3>> to_vectors(const std::string &option,
                                                const std::vector<std::string> &given)
  {
    const std::vector<double> numbers = to_numbers(option, given);
    if (numbers.size() % 3 != 0)
      throw InputError(option + " has " + std::to_string(numbers.size()) +
                       " numbers; give three for each direction, e.g. 1,0,0 1,1,0");
    std::vector<std::array<double, 3>> vectors;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return vectors;
  }
} // namespace plumbline::base
