#pragma once

#include <string>

namespace plumbline::app
{
  /// What to do about an error that nobody foresaw; its own text last, on one line.
  std::string explain_unexpected(const std::string &text);
} // namespace plumbline::app
