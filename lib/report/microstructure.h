#pragma once

#include "analysis/record.h"

#include <string>

namespace plumbline::report
{
  /// G varies over the body: there is something to draw a crack over.
  bool has_microstructure(const analysis::Record &record);

  /// G of the nodes in greys [force/length] and over it the notch, the crack as it is at the end,
  /// and what parted apart from it: sides between next neighbours [length]. Commands of gnuplot
  /// that draw microstructure.svg.
  /// @pre  has_microstructure
  std::string microstructure_script(const analysis::Record &record);
} // namespace plumbline::report
