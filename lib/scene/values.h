#pragma once

#include "scene/problem_sections.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  // From the text of a key to its value. Each throws InputError saying what is wrong and what is
  // allowed; Keys names the key.

  /// Words in place of values: there is none; it is found; there is no need to list them.
  constexpr const char *const none = "none", *const automatic = "auto", *const all = "all";

  std::string trim(const std::string &text);

  /// Between whole numbers, the first that may be a decimal comma.
  enum class Comma
  {
    any,     ///< 3,5: where one number is due
    after_0, ///< 0,5: where numbers are above 0
    before_0 ///< 3,05: no number of a list begins with 0 and goes on with digits
  };

  /// "; did you mean 3.5? ..." of a text with such a comma, else empty.
  std::string comma_hint(const std::string &text, Comma kind = Comma::any);

  double to_number(const std::string &text);
  std::vector<double> to_numbers(const std::string &text);    ///< separated by blanks
  std::vector<std::string> to_names(const std::string &text); ///< separated by commas

  /// The name that a method has here; some rules have several in the literature: HHB is QWJ.
  std::string method_name(const std::string &given);

  /// Names of methods separated by commas, those that they have here.
  std::vector<std::string> to_methods(const std::string &text);

  /// "name: expression; ..." or a single expression, whose case is called "u".
  std::vector<NamedExpression> to_named_expressions(const std::string &text);

  /// A short decimal text, as in series names: 3, 0.4, 2.5.
  std::string short_number(double value);

  /// @throw InputError saying what is wrong
  void require(bool is_good, const std::string &otherwise);

  std::string join(const std::vector<std::string> &words, const std::string &separator);
} // namespace plumbline::scene
