#pragma once

#include "scene/scene.h"
#include "study/dynamics.h"
#include "study/motion_data.h"

namespace plumbline::study
{
  /// The torus without a mesh at the final time.
  struct Torus
  {
    std::shared_ptr<const method::ContinuousMotion> equation;
    analysis::State state;

    /// @param of  state.u or state.v
    /// @return shape (n_nodes, n_components)
    std::vector<double> at(const std::vector<dealii::Point<2>> &nodes,
                           const std::vector<double> &of) const;
  };

  struct TorusSolution
  {
    Torus torus;
    TorusEstimate estimate;
  };

  /// Move it with more and more points, until u changes by less than 1e-8 of how far it varies, far
  /// below the errors of lattices; 54 a side at most.
  TorusSolution solve_torus(const scene::Scene &scene, const MotionControl &control,
                            const std::string &problem, double horizon, ProblemsInTime &problems);
} // namespace plumbline::study
