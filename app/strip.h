#pragma once

#include "measures.h"
#include "method/method.h"
#include "scene/scene.h"
#include "study/standing_crack.h"

namespace plumbline::app
{
  struct StripOptions : MeasureOptions
  {
    bool check = false; ///< Expected/strip, and that no strip is too short
  };

  /// The methods of a scene with a strip, checked, and with memory for all of its levels.
  /// @param n_jobs  processes that each take it side by side (--jobs)
  /// @throws InputError  a method that is not for lattices, or does not fit
  method::Methods strip_methods(const scene::Scene &scene, unsigned int n_levels,
                                unsigned int n_jobs = 1);

  using StripControl = MeasureControl<study::StripRow>;

  /// Strips with a standing crack by methods at all levels of a scene.
  study::StripResults stand_cracks(const scene::Scene &scene, const method::Methods &methods,
                                   unsigned int n_levels, const StripControl &control = {});

  /// Solve strips with a standing crack by all methods at all levels of a scene; print tables,
  /// write strip.html, .md and .json, and strip/ with pictures and their data.
  /// A run that was interrupted or killed takes over what it had finished, from strip.jsonl.
  /// @return  130 if it was interrupted (what was finished is there), 1 if check is set and
  ///          something is not as expected, else 0
  /// @throws InputError  a scene or method that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn, all else is written then
  int strip(const StripOptions &options);
} // namespace plumbline::app
