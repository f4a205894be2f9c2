#include "scene/values.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "physics/expression.h"
#include "scene/published_names.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

namespace plumbline::scene
{
  using physics::split_outside_brackets;

  std::string trim(const std::string &text)
  {
    return split_outside_brackets(text, '\0')[0];
  }

  std::string comma_hint(const std::string &text, Comma kind)
  {
    if (text.find(',') == std::string::npos)
      return "";
    // blanks behind it are those of a list
    const std::string first = kind == Comma::after_0 ? "0" : "[0-9]+",
                      comma = kind == Comma::before_0 ? ",\\s*" : ",",
                      second = kind == Comma::before_0 ? "0[0-9]+" : "[0-9]+";
    const std::regex number("(^|[^0-9A-Za-z_.])([+-]?" + first + ")" + comma + "(" + second +
                            "([eE][+-]?[0-9]+)?)(?![0-9.])");
    std::smatch found;
    return std::regex_search(text, found, number)
               ? "; did you mean " + found[2].str() + "." + found[3].str() +
                     "? Decimals have a point, a comma separates numbers"
               : "";
  }

  namespace
  {
    double to_number(const std::string &text, const std::string &remedy)
    {
      std::size_t used = 0;
      double value = 0;
      try
      {
        value = std::stod(text, &used);
      }
      catch (const std::exception &)
      {
      }
      if (used == 0 || used != text.size() || !std::isfinite(value))
        throw InputError("'" + base::shown(text) + "' is not a number; " + remedy +
                         comma_hint(text));
      return value;
    }
  } // namespace

  double to_number(const std::string &text)
  {
    return to_number(text, "write one such as 0.05 or 1e-3");
  }

  std::vector<double> to_numbers(const std::string &text)
  {
    std::vector<double> values;
    for (const std::string &part : split_outside_brackets(text, ' '))
      if (!part.empty())
        values.push_back(
            to_number(part, "write numbers such as 0.05 or 1e-3, separated by blanks"));
    return values;
  }

  std::vector<std::string> to_names(const std::string &text)
  {
    std::vector<std::string> names;
    for (const std::string &part : split_outside_brackets(text, ','))
      if (!part.empty())
        names.push_back(part);
    return names;
  }

  std::string method_name(const std::string &given)
  {
    for (const PublishedName &one : published_names())
      if (base::to_lower(one.name) == base::to_lower(given))
      {
        if (one.ours.size() == 1)
          return one.ours.front();
        std::string ours;
        for (const std::string &name : one.ours)
          ours += (ours.empty() ? "" : ", ") + name;
        throw InputError("method '" + given + "' is the published name of several rules (" +
                         one.source + "); write one of " + ours + " ('plumbline list methods')");
      }
    return given;
  }

  std::vector<std::string> to_methods(const std::string &text)
  {
    std::vector<std::string> names = to_names(text);
    std::transform(names.begin(), names.end(), names.begin(), method_name);
    return names;
  }

  std::vector<NamedExpression> to_named_expressions(const std::string &text)
  {
    std::vector<NamedExpression> cases;
    for (const std::string &part : split_outside_brackets(text, ';'))
    {
      if (part.empty())
        continue;
      const auto colon = part.find(':');
      const std::string name = trim(part.substr(0, colon));
      const bool is_named =
          colon != std::string::npos && part.find('?') > colon && !name.empty() &&
          std::all_of(name.begin(), name.end(),
                      [](unsigned char c)
                      { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == ' '; });
      if (is_named)
        cases.push_back({name, trim(part.substr(colon + 1))});
      else
        cases.push_back({"u", part});
    }
    return cases;
  }

  std::string short_number(double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  void require(bool is_good, const std::string &otherwise)
  {
    if (!is_good)
      throw InputError(otherwise);
  }

  std::string join(const std::vector<std::string> &words, const std::string &separator)
  {
    std::string list;
    for (const std::string &word : words)
      list += (list.empty() ? "" : separator) + word;
    return list;
  }
} // namespace plumbline::scene
