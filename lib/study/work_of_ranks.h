#pragma once

#include "method/method.h"
#include "scene/scene.h"

#include <string>

namespace plumbline::study
{
  /// What provenance says of the work of several ranks; empty: all of it is shared, as on meshes.
  std::string work_of_ranks(const scene::Scene &scene, const method::Methods &methods);

  /// Why ranks repeat work.
  std::string repetition(const scene::Scene &scene, const method::Methods &methods,
                         unsigned int n_ranks);

  /// The same of a scene with a time whose work the first rank does while others have none.
  inline const std::string work_of_first_rank =
      "all by the first rank: transient analyses by these methods are not distributed";
} // namespace plumbline::study
