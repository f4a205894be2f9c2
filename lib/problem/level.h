#pragma once

#include <string>
#include <vector>

namespace plumbline::problem
{
  /// A point of a study.
  struct Level
  {
    double h = 0, horizon = 0; ///< [length]
    double value = 0;          ///< of the number that varies, where one does
  };

  /// Levels, from coarse to fine where they refine, with what is held fixed as name, e.g. "m = 3".
  struct Series
  {
    std::string name;
    std::vector<Level> levels;
  };
} // namespace plumbline::problem
