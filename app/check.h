#pragma once

#include "scene/scene.h"

namespace plumbline::app
{
  struct CheckOptions
  {
    std::string nodes_file, bonds_file, scene_file;
    std::vector<scene::Override> overrides;
    bool quiet = false, json = false;
  };

  /// Check quadrature weights of another code on its own nodes: moments, symmetry, matrix,
  /// solutions; print what is found. Nothing is written.
  /// @return exit code: 0, or 1: second moments off by more than 30 %, a matrix that is not
  ///         positive definite, or nodes out of line with the others
  /// @throws InputError  files or a scene that cannot be used
  /// @throws NumericalError  no solution, where the weights are not found wrong
  int check(const CheckOptions &options);
} // namespace plumbline::app
