#pragma once

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// One value of a scene file and its location.
  struct Setting
  {
    std::string key;   ///< "Section/key", or a key outside sections
    std::string value; ///< trimmed
    std::string place; ///< for messages: "line 3", "line 3 of 'common.prm'", or the JSON key
  };

  /// The settings of a text in .prm syntax: lines 'set key = value', 'subsection NAME' ... 'end',
  /// 'include FILE' (named from the folder of the file that includes it); '#' begins a comment, and
  /// '\' at its end continues a line.
  /// @param file  origin of the text: included files are relative to its folder
  /// @param what  opens messages, e.g. "scene 'bar.prm'"
  /// @throws InputError  naming the line: anything else, a section that is not closed, a key given
  /// twice, a file that cannot be read or includes itself
  std::vector<Setting> read_settings(const std::string &file, const std::string &text,
                                     const std::string &what);

  /// The same of a JSON text: {"Section": {"key": "value"}}; values are texts, numbers or truth
  /// values.
  /// @throws InputError  as base::parse_json, and other values
  std::vector<Setting> read_json_settings(const std::string &text, const std::string &what);
} // namespace plumbline::scene
