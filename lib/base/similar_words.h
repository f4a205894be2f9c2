#pragma once

#include <string>
#include <vector>

namespace plumbline::base
{
  /// In lower case; other characters than ASCII letters stay.
  std::string to_lower(std::string text);

  /// The known words that a misspelt one may stand for, without regard to case: those with the
  /// fewest edits (a letter inserted, removed or replaced), if these are few for its length.
  std::vector<std::string> similar_words(const std::string &word,
                                         const std::vector<std::string> &known);

  /// "; did you mean X or Y?" of at most three words, or nothing.
  std::string did_you_mean(const std::vector<std::string> &meant);

  /// The same of the known words that are similar to one.
  std::string did_you_mean(const std::string &word, const std::vector<std::string> &known);
} // namespace plumbline::base
