#pragma once

#include "scene/scene.h"

#include <set>
#include <string>
#include <vector>

namespace plumbline::scene
{

  // From the text of a key to its value. Each throws InputError naming the key and what is allowed.

  std::string trim(const std::string &text);
  double to_number(const std::string &key, const std::string &text);
  std::vector<double> to_numbers(const std::string &key, const std::string &text, char separator);
  std::vector<std::string> to_names(const std::string &text); ///< separated by commas

  /// The name that a method has here; some rules have several in the literature: HHB is QWJ.
  std::string method_name(const std::string &given);

  /// Names of methods separated by commas, those that they have here.
  std::vector<std::string> to_methods(const std::string &text);

  /// "x0, y0 : x1, y1; ..."
  std::vector<geometry::Box> to_boxes(const std::string &key, const std::string &text);

  /// "x0, y0 : x1, y1 : x2, y2; ..."
  std::vector<std::vector<dealii::Point<2>>> to_polylines(const std::string &key,
                                                          const std::string &text);

  /// "name: expression; ..." or a single expression, whose case is called "u".
  std::vector<Case> to_cases(const std::string &text);

  /// "method[, case][, series]: value; ..."; the series is the part with '='. Values are
  /// numbers, or one of the given words.
  std::vector<Expected> to_expected(const std::string &key, const std::string &text,
                                    const std::vector<std::string> &cases,
                                    const std::set<std::string> &words = {});

  /// A short decimal text, as in series names: 3, 0.4, 2.5.
  std::string short_number(double value);
} // namespace plumbline::scene
