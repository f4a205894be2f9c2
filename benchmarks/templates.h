#pragma once

#include <map>
#include <string>

namespace plumbline::benchmarks
{
  /// The files of benchmarks/templates by their names. Written by cmake/templates.cmake.
  const std::map<std::string, std::string> &templates();
} // namespace plumbline::benchmarks
