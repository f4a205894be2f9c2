#pragma once

#include "method/method.h"
#include "scene/scene.h"

namespace plumbline::study
{
  /// The method of a name, which may be in another case (fa is FA) unless two differ in that
  /// alone; null if there is none.
  std::shared_ptr<const method::Method> method_called(const method::Methods &available,
                                                      const std::string &name);

  /// The same scene with its methods (those to run, the reference's, the expectations') called by
  /// their own names. Names that no method has stay as they are.
  scene::Scene with_names_of(scene::Scene scene, const method::Methods &available);
} // namespace plumbline::study
