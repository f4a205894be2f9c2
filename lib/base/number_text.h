#pragma once

#include <string>

namespace plumbline::base
{
  /// Of so many significant digits, for people: 0.05, 1.234e-05, 12.
  std::string to_text(double value, int n_digits);

  /// A fraction of three significant digits: "4.72 %".
  std::string to_percent(double fraction);
} // namespace plumbline::base
