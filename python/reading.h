#pragma once

#include "scene/problem.h"
#include "scene/scene.h"

#include <pybind11/pytypes.h>

#include <string>
#include <vector>

namespace plumbline::python
{
  /// @param text  name of a file, or a scene itself: several lines
  scene::Scene scene_of(const std::string &text, const std::vector<scene::Override> &overrides);

  /// {"Section/key": value}, values being texts, numbers or truth values.
  std::vector<scene::Override> to_overrides(const pybind11::dict &set);
} // namespace plumbline::python
