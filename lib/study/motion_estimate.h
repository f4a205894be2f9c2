#pragma once

#include "method/method.h"
#include "scene/scene.h"
#include "study/motion_data.h"

namespace plumbline::study
{
  using method::Method;
  using method::MethodFamily;

  /// What a Galerkin solution may be wrong by at the final time, of u, L2 over its nodes.
  struct MotionEstimate
  {
    double space = 0;      ///< from h/2, 2 h and degree p + 1
    double quadrature = 0; ///< change to finer quadrature of forces; 0: they are exact
    double time = 0;       ///< from the same equation, exact in time
    double sum() const { return space + quadrature + time; }
  };

  /// Whether a scene wants the errors of a method's motions estimated (Reference/estimate): of
  /// Galerkin methods, where neither a reference nor a solution is known or all are asked for.
  bool wants_estimate(const scene::Scene &scene, const Method &method);

  /// Nothing is distributed in the plane.
  inline void share_motion(const scene::Scene &, const Method &, method::Discretisation &,
                           const base::Communicator &)
  {
  }

  /// Whether ranks share the transient analysis by a method that distributes nodes in slabs: not if
  /// its error is estimated, since the estimate compares lattices, nor on unions of boxes.
  bool is_motion_shared(const scene::Scene &scene, const Method &method);

  /// Give each rank a slab if they share the transient analysis by the method.
  /// @note Collective.
  void share_motion(const scene::Scene &scene, const Method &method,
                    method::DiscretisationInSpace &discretisation, const base::Communicator &ranks);

  /// The state at the final time, exact in time (Runge-Kutta of high order, to 1e-12).
  analysis::State move_exactly(const scene::Scene &scene, const analysis::Transient &transient,
                               const analysis::State &start);

  /// Refine quadrature as statics under a load of 1 needs it, whatever moves later. A body that
  /// floats has no statics.
  void settle_quadrature(method::Discretisation &discretisation, const problem::Problem<2> &first);

  /// Nothing to refine: in three dimensions matrix entries are exact.
  inline void settle_quadrature(method::DiscretisationInSpace &, const problem::Problem<3> &) {}

  /// What a Galerkin method's motion may be wrong by in space and by quadrature, at the final time,
  /// L2 over nodes. Space: with the changes d to h/2 and d' from 2 h, at the nodes that both have,
  /// Richardson's d / (1 - q), q the larger of 2^-(p+1) and d / d' (1/2 where 2 h does not fit), or
  /// the change to degree p + 1 if that is larger; 3/2 of it. Quadrature: the change to finer one.
  /// All exact in time. A bound in practice, no theorem; nothing for discontinuous functions, whose
  /// nodes share places, and for meshes whose nodes move with h. In three dimensions the change to
  /// degree p + 1 is not available. Cost: that of the motions at h/2 (16 times as many bonds), at
  /// degree p + 1 and at 2 h.
  /// @param end   of `equation`, by move_exactly
  /// @param finer_quadrature  the same equation with forces by finer quadrature; null: exact ones
  /// @param area  of Ω
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  std::optional<MotionEstimate> estimate_in_space(const scene::Scene &scene, const Method &method,
                                                  const method::MotionOf<dim> &equation,
                                                  const method::MotionOf<dim> *finer_quadrature,
                                                  const analysis::State &end, double area,
                                                  ProblemsInTime<dim> &problems);
} // namespace plumbline::study
