#pragma once

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// A former name of a key or of a value. Scenes may still use it; written scenes have the new
  /// one.
  struct Alias
  {
    std::string key;       ///< "Section/key" today
    std::string old_key;   ///< its former name; empty: it is the value that was renamed
    std::string old_value; ///< a former word for `value`
    std::string value;
  };

  /// All former names.
  const std::vector<Alias> &aliases();

  /// Today's name of a key, which may be given by a former one.
  std::string current_key(const std::string &path);

  /// Today's word for a value of a key.
  /// @param key  its name today
  std::string current_value(const std::string &key, const std::string &value);
} // namespace plumbline::scene
