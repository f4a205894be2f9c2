#pragma once

#include "method/method.h"
#include "scene/scene.h"

#include <string>

namespace plumbline::study
{
  /// Whether ranks share the work of some method, or of what it is compared with; else each method
  /// is computed by one rank alone.
  bool is_any_distributed(const scene::Scene &scene, const method::Methods &methods);

  /// What provenance says of the work of several ranks; empty: all of it is shared, as on meshes.
  std::string work_of_ranks(const scene::Scene &scene, const method::Methods &methods);

  /// Why ranks repeat work.
  std::string repetition(const scene::Scene &scene, const method::Methods &methods,
                         unsigned int n_ranks);

  /// What provenance says where ranks share methods and levels.
  inline const std::string work_of_tasks =
      "methods and levels are distributed: one rank computes each of them";
} // namespace plumbline::study
