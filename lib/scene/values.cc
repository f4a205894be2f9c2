#include "scene/values.h"

#include "base/error.h"
#include "base/text_file.h"
#include "physics/expression.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace plumbline::scene
{
  using physics::split_outside_brackets;

  std::string trim(const std::string &text)
  {
    return split_outside_brackets(text, '\0')[0];
  }

  namespace
  {
    const std::string one_number = "write one such as 0.05 or 1e-3";

    double to_number(const std::string &key, const std::string &text, const std::string &remedy)
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
        throw InputError(key + ": '" + base::shown(text) + "' is not a number; " + remedy);
      return value;
    }
  } // namespace

  double to_number(const std::string &key, const std::string &text)
  {
    return to_number(key, text, one_number);
  }

  std::vector<double> to_numbers(const std::string &key, const std::string &text, char separator)
  {
    const bool is_by_commas = separator == ',';
    const std::string remedy = "write numbers such as 0.05 or 1e-3, separated by " +
                               std::string(is_by_commas ? "','" : "blanks");
    const auto parts = split_outside_brackets(text, separator);
    std::vector<double> values;
    for (const std::string &part : parts)
      if (!part.empty())
        values.push_back(to_number(key, part, remedy));
      else if (is_by_commas && parts.size() > 1)
        throw InputError(key + ": '" + base::shown(text) +
                         "' has nothing between two commas, or behind the last one; take the comma "
                         "out, or write a number there");
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
    return given == "HHB" ? "QWJ" : given;
  }

  std::vector<std::string> to_methods(const std::string &text)
  {
    std::vector<std::string> names = to_names(text);
    std::transform(names.begin(), names.end(), names.begin(), method_name);
    return names;
  }

  namespace
  {
    /// "x0, y0 : x1, y1 : ..."
    std::vector<dealii::Point<2>> to_points(const std::string &key, const std::string &text)
    {
      std::vector<dealii::Point<2>> points;
      for (const std::string &one : split_outside_brackets(text, ':'))
      {
        const auto numbers = to_numbers(key, one, ',');
        if (numbers.size() != 2)
          throw InputError(key + ": '" + one + "' is not a point; write 'x, y'");
        points.emplace_back(numbers[0], numbers[1]);
      }
      return points;
    }
  } // namespace

  std::vector<geometry::Box> to_boxes(const std::string &key, const std::string &text)
  {
    std::vector<geometry::Box> boxes;
    for (const std::string &part : split_outside_brackets(text, ';'))
    {
      if (part.empty())
        continue;
      if (std::count(part.begin(), part.end(), ':') != 1 ||
          std::count(part.begin(), part.end(), ',') != 2)
        throw InputError(key + ": '" + part + "' is not a box; write 'x0, y0 : x1, y1'");
      const auto corners = to_points(key, part);
      if (!(corners[0][0] < corners[1][0]) || !(corners[0][1] < corners[1][1]))
        throw InputError(key + ": the box '" + part +
                         "' is empty; its second corner must be above and right of its first");
      boxes.push_back({corners[0], corners[1]});
    }
    return boxes;
  }

  std::vector<std::vector<dealii::Point<2>>> to_polylines(const std::string &key,
                                                          const std::string &text)
  {
    std::vector<std::vector<dealii::Point<2>>> lines;
    for (const std::string &part : split_outside_brackets(text, ';'))
    {
      if (part.empty())
        continue;
      lines.push_back(to_points(key, part));
      if (lines.back().size() < 2)
        throw InputError(key + ": '" + part +
                         "' is not a line; write 'x0, y0 : x1, y1', with more points if it bends");
    }
    return lines;
  }

  std::vector<Case> to_cases(const std::string &text)
  {
    std::vector<Case> cases;
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

  std::vector<Expected> to_expected(const std::string &key, const std::string &text,
                                    const std::vector<std::string> &cases,
                                    const std::set<std::string> &words)
  {
    const bool is_verdict = !words.empty();
    std::vector<Expected> list;
    for (const std::string &part : split_outside_brackets(text, ';'))
    {
      if (part.empty())
        continue;
      const auto colon = part.rfind(':');
      if (colon == std::string::npos)
        throw InputError(key + ": '" + part + "' has no ':'; write 'method[, case][, series]: " +
                         (is_verdict ? "verdict'" : "numbers'"));
      Expected expected;
      expected.text = part;
      const auto subject = to_names(part.substr(0, colon));
      for (std::size_t i = 0; i < subject.size(); ++i)
        if (i == 0)
          expected.method = method_name(subject[i]);
        else if (subject[i].find('=') != std::string::npos)
          expected.series = subject[i];
        else if (std::find(cases.begin(), cases.end(), subject[i]) != cases.end())
          expected.problem = subject[i];
        else
          throw InputError(key + ": '" + subject[i] + "' in '" + part +
                           "' is neither a case of Problem nor a series like 'm = 3'");
      if (is_verdict)
        expected.verdict = trim(part.substr(colon + 1));
      else
        expected.values = to_numbers(key, part.substr(colon + 1), ' ');
      if (!is_verdict && expected.values.empty())
        throw InputError(key + ": '" + part + "' has no numbers after the ':'");
      if (is_verdict && words.count(expected.verdict) == 0)
      {
        std::string allowed;
        for (const std::string &word : words)
          allowed += (allowed.empty() ? "" : ", ") + word;
        throw InputError(key + ": '" + expected.verdict + "' is not a verdict; write one of " +
                         allowed);
      }
      list.push_back(expected);
    }
    return list;
  }
} // namespace plumbline::scene
