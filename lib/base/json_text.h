#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace plumbline::base
{
  /// A JSON text. Beyond the standard: no key comes twice in an object, and nothing is nested
  /// deeper than 64 levels (ours need 6; the library and all that walks a tree go down one call a
  /// level).
  /// @param what    opens messages, e.g. "scene 'bar.json'"
  /// @param remedy  ends them, e.g. "mend the file"
  /// @throws InputError  naming the line: no JSON, a number beyond double, a key given twice, too
  /// deep
  nlohmann::ordered_json parse_json(const std::string &text, const std::string &what,
                                    const std::string &remedy);
} // namespace plumbline::base
