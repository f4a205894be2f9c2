#include "base/similar_words.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace plumbline::base
{
  namespace
  {
    /// Levenshtein's distance.
    std::size_t count_edits(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1); // from the first i letters of a to those of b
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j)
        {
          const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
          diagonal = row[j + 1];
          row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
      }
      return row.back();
    }
  } // namespace

  std::string to_lower(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  }

  std::vector<std::string> similar_words(const std::string &word,
                                         const std::vector<std::string> &known)
  {
    constexpr std::size_t letters_per_edit = 5, longest = 100;
    if (word.size() > longest)
      return {};
    std::size_t fewest = 1 + word.size() / letters_per_edit;
    std::vector<std::string> similar;
    for (const std::string &one : known)
    {
      const std::size_t edits = count_edits(to_lower(word), to_lower(one));
      if (edits > fewest || edits >= std::max(word.size(), one.size()))
        continue; // no letter in common
      if (edits < fewest)
        similar.clear();
      fewest = edits;
      similar.push_back(one);
    }
    return similar;
  }

  std::string did_you_mean(const std::vector<std::string> &meant)
  {
    constexpr std::size_t most = 3;
    if (meant.empty() || meant.size() > most)
      return "";
    std::string text;
    for (const std::string &one : meant)
      text += (text.empty() ? "; did you mean " : " or ") + one;
    return text + "?";
  }

  std::string did_you_mean(const std::string &word, const std::vector<std::string> &known)
  {
    return did_you_mean(similar_words(word, known));
  }
} // namespace plumbline::base
