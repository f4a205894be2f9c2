#pragma once

#include "scene/scene.h"

#include <map>
#include <string>

namespace plumbline::study
{
  /// The equation that a scene poses, by name: model, dimension, kernel, constraint, and, where
  /// there are some, constants, local limit, coefficient, dilatation, varying constants, boundary
  /// function, broken bonds. Reports write the equation by them.
  void add_model_facts(const scene::Scene &scene, std::map<std::string, std::string> &facts);
  bool is_of_equation(const std::string &fact); ///< one of these names

  /// Of a solid of the plane whether it fulfils Assumption 1, see physics/solid_bounds.h; too long
  /// for summaries.
  inline const std::string assumption_1_fact = "Assumption 1 (Fan et al. 2022)";
} // namespace plumbline::study
