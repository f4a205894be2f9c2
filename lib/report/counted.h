#pragma once

#include <cstddef>
#include <string>

namespace plumbline::report
{
  /// "1 method", "0 methods", "3 methods".
  inline std::string counted(std::size_t n, const std::string &one)
  {
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
  }
} // namespace plumbline::report
