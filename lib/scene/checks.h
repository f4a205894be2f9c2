#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  // Whether the values of a scene fit together. Each throws InputError naming keys, values and the
  // remedy.

  /// Mesh sizes divide the domain, horizons reach a neighbour, the collar holds the ball.
  void check_levels(const Scene &scene);

  /// Kernel, limit, coefficient, and the number of components of every expression.
  void check_kernel_and_problem(const Scene &scene);

  /// A scene has boxes of its dimension, and in space nothing that is for the plane.
  void check_space(const Scene &scene);

  /// Keys of Domain and Methods/nodes fit together.
  void check_mesh_and_nodes(const Scene &scene);

  /// The norm that decides is among the others, and what its target needs is given.
  void check_norms(const Scene &scene);

  /// What moves, or cannot: Time, double wells and the torus fit the rest.
  void check_motion(const Scene &scene);

  /// Where a random scene is taken, and in how many samples.
  void check_sampling(const Scene &scene);

  /// A strip with a notch has bonds with two wells: no dilatation, no other Poisson ratio.
  void check_model_of_crack(const Scene &scene);

  /// A strip with a notch, and nothing else that would move it.
  void check_crack(const Scene &scene);

  /// The influence function that cracks are known for: c δ/r, by its name among kernels.
  bool is_inverse_distance(const KernelSection &kernel);

  /// A body with a notch and grips whose bonds break in equilibrium.
  void check_fracture(const Scene &scene);

  /// A strip with a standing crack, if there is one.
  void check_strip(const Scene &scene);

  /// Solver/iteration and Solver/dilatation fit the rest.
  void check_solver(const Scene &scene);
} // namespace plumbline::scene
