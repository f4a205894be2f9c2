#pragma once

#include "physics/chebyshev.h"
#include "physics/expression.h"
#include "physics/kernel.h"
#include "scene/scene.h"

#include <functional>
#include <optional>

namespace plumbline::scene
{
  /// A field given pointwise, and as a series where it is smooth.
  struct Field
  {
    std::function<double(const dealii::Point<2> &, unsigned int component)> value;
    std::optional<physics::ChebyshevField> series; ///< on the bounding box of Ω
  };

  /// One case of a scene at one level: what a method needs to know, and nothing of other levels.
  struct Problem
  {
    geometry::Lattice lattice;
    physics::Kernel<2> kernel;
    unsigned int n_components;
    Field load;                          ///< b on Ω
    Field constraint;                    ///< u in the collar
    std::optional<Field> solution;       ///< the exact nonlocal solution, if known
    std::optional<Field> local_solution; ///< the solution of the local limit, if known
    double horizon() const { return kernel.horizon(); }
  };

  /// @param case_index  into Scene::case_names()
  /// @throws InputError  an expression that is not finite somewhere in Ω or its collar
  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level);
} // namespace plumbline::scene
