#pragma once

#include "study/dynamics.h"
#include "study/motion_data.h"

namespace plumbline::study
{
  /// Whether a scene wants the errors of a method's motions estimated (Reference/estimate): of
  /// Galerkin methods, where neither a reference nor a solution is known or all are asked for.
  bool wants_estimate(const scene::Scene &scene, const Method &method);

  /// The state at the final time, exact in time.
  analysis::State move_exactly(const scene::Scene &scene, const method::EquationOfMotion &equation,
                               ProblemsInTime &problems);

  /// Refine quadrature as statics under a load of 1 needs it, whatever moves later. A body that
  /// floats has no statics.
  void settle_quadrature(const scene::Scene &scene, method::Discretisation &discretisation,
                         const scene::Problem &first);

  /// What a Galerkin method's motion may be wrong by in space and by quadrature, at the final time,
  /// L2 over nodes: the change to degree p + 1, at the nodes that both have, and to finer
  /// quadrature, both exact in time. Nothing for discontinuous functions, whose nodes share places.
  /// Cost: two motions more, one of them of degree p + 1.
  /// @param end   of `equation`, by move_exactly
  /// @param area  of Ω
  std::optional<MotionEstimate> estimate_in_space(const scene::Scene &scene, const Method &method,
                                                  const method::Discretisation &discretisation,
                                                  const method::EquationOfMotion &equation,
                                                  const analysis::State &end, double area,
                                                  ProblemsInTime &problems);
} // namespace plumbline::study
