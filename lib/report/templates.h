#pragma once

#include <map>
#include <string>

namespace plumbline::report
{
  /// The files of templates/ by their names, without what follows a dot. Written by
  /// cmake/templates.cmake.
  const std::map<std::string, std::string> &templates();
} // namespace plumbline::report
