#pragma once

#include "scene/scene.h"

#include <deal.II/base/parameter_handler.h>

namespace plumbline::scene
{
  /// Declare every key of a scene with default, pattern and help. The one place where keys are
  /// named.
  void declare(dealii::ParameterHandler &parameters);

  /// The value of "Section/key" (or of a key outside sections).
  std::string get(dealii::ParameterHandler &parameters, const std::string &key);

  /// @throws InputError  unknown key, or a value that its pattern does not allow
  void set(dealii::ParameterHandler &parameters, const std::string &key, const std::string &value);
} // namespace plumbline::scene
