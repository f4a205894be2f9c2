#pragma once

#include <map>
#include <string>

namespace plumbline::driver
{
  /// Versions and machine, for results.
  std::map<std::string, std::string> provenance();
} // namespace plumbline::driver
