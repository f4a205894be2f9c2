#pragma once

#include "base/choice.h"
#include "base/error.h"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace plumbline::geometry
{
  /// Sections of a .msh file that count; others are skipped.
  enum class MshSection
  {
    format,
    groups, ///< of cells, by name
    entities,
    nodes,
    elements
  };

  /// The words of a text one by one, and the lines they stand in, for messages.
  class MshWords
  {
  public:
    MshWords(const std::string &text, std::string source) : text_(text), source_(std::move(source))
    {
    }

    std::size_t line() const { return line_; } ///< of the last word, from 1

    /// The next word; empty at the end.
    std::string_view word()
    {
      skip_blanks();
      const std::size_t from = at_;
      while (at_ < text_.size() && !is_blank(text_[at_]))
        ++at_;
      return std::string_view(text_).substr(from, at_ - from);
    }

    /// The next word as a number in [lowest, highest]. @param what  that it is, e.g. "a node's
    /// number"
    long integer(const std::string &what, long lowest, long highest)
    {
      const std::string_view found = word();
      long number = 0;
      const auto parsed = std::from_chars(found.data(), found.data() + found.size(), number);
      if (parsed.ec != std::errc() || parsed.ptr != found.data() + found.size() ||
          number < lowest || number > highest)
        fail_word(found, what + ", a whole number from " + std::to_string(lowest));
      return number;
    }

    double number(const std::string &what)
    {
      const std::string_view found = word();
      const bool has_plus = found.size() > 1 && found[0] == '+' && found[1] != '-';
      double number = 0;
      const auto parsed =
          std::from_chars(found.data() + (has_plus ? 1 : 0), found.data() + found.size(), number);
      // what is too small to be represented is as good as 0
      const bool is_tiny =
          parsed.ec == std::errc::result_out_of_range && found.find("e-") != std::string_view::npos;
      if ((parsed.ec != std::errc() && !is_tiny) || parsed.ptr != found.data() + found.size() ||
          !std::isfinite(number))
        fail_word(found, what + ", a finite number");
      return is_tiny ? 0 : number;
    }

    /// A text in double quotes.
    std::string quoted(const std::string &what)
    {
      skip_blanks();
      if (at_ >= text_.size() || text_[at_] != '"')
        fail_word(word(), what + " in double quotes");
      const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
      if (end == std::string::npos || text_[end] == '\n')
        fail("the quotes of " + what + " do not end on their line; close them");
      std::string found = text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
      return found;
    }

    void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

    [[noreturn]] void fail(const std::string &what) const { fail(line_, what); }
    [[noreturn]] void fail(std::size_t line, const std::string &what) const
    {
      throw InputError(source_ + ", line " + std::to_string(line) + ": " + what);
    }

  private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    void skip_blanks()
    {
      for (; at_ < text_.size() && is_blank(text_[at_]); ++at_)
        line_ += text_[at_] == '\n' ? 1 : 0;
    }

    [[noreturn]] void fail_word(std::string_view found, const std::string &what) const
    {
      constexpr std::size_t longest = 30;
      std::string shown;
      for (const char c : found.substr(0, longest))
        shown += c >= ' ' && c <= '~' ? c : '?';
      fail((found.empty() ? "the file ends" : "'" + shown + "' stands") + " where there must be " +
           what + "; mend the file, or export it again");
    }

    const std::string &text_;
    std::string source_;
    std::size_t at_ = 0, line_ = 1;
  };
} // namespace plumbline::geometry

namespace plumbline::base
{
  template <>
  inline constexpr auto words<geometry::MshSection> =
      std::array{"MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"};
} // namespace plumbline::base
