#include "app/unexpected.h"

#include <cctype>

namespace plumbline::app
{
  namespace
  {
    /// Lines and runs of blanks and dashes, as libraries frame their texts, made one blank.
    std::string on_one_line(const std::string &text)
    {
      std::string result;
      for (std::size_t at = 0; at < text.size(); ++at)
      {
        const bool is_rule =
            text.compare(at, 2, "--") == 0 || (at > 0 && text[at] == '-' && text[at - 1] == '-');
        const bool is_blank = is_rule || std::isspace(static_cast<unsigned char>(text[at])) != 0;
        if (!is_blank)
          result += text[at];
        else if (!result.empty() && result.back() != ' ')
          result += ' ';
      }
      while (!result.empty() && result.back() == ' ')
        result.pop_back();
      return result;
    }
  } // namespace

  std::string explain_unexpected(const std::string &text)
  {
    const std::string said = on_one_line(text);
    return "an unexpected error, which is a fault of Plumbline: results that are not whole are "
           "marked so, and the same command goes on with a run that was not finished; if it fails "
           "again, try fewer levels (--levels) or methods (--methods), and report the scene with "
           "this line (it says: " +
           (said.empty() ? "nothing" : said) + ")";
  }
} // namespace plumbline::app
