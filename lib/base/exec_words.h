#pragma once

#include <string>
#include <vector>

namespace plumbline::base
{
  /// Arguments or settings as exec and posix_spawn take them, ended by a null.
  /// @param words  must outlive the result
  inline std::vector<char *> exec_words(std::vector<std::string> &words)
  {
    std::vector<char *> result;
    for (std::string &word : words)
      result.push_back(word.data());
    result.push_back(nullptr);
    return result;
  }
} // namespace plumbline::base
