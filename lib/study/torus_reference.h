#pragma once

#include "scene/scene.h"
#include "study/analysis.h"
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
    unsigned int n_points = 0; ///< a side
    double change = 0;         ///< from 2/3 of the points, of u, L2
    double seconds = 0;        ///< CPU

    /// States at equal times from 0 to the end, with accelerations; empty: they were not asked for.
    struct Instant
    {
      analysis::State state;
      analysis::Vector acceleration;
    };
    std::vector<Instant> path;
    /// Between two of them by the polynomial of degree 5 through all their values.
    /// @pre !path.empty()
    analysis::State at(double t) const;
  };

  /// Move it with more and more points, until u changes by less than 1e-8 of how far it varies, far
  /// below the errors of lattices; 54 a side at most.
  /// @param available  among which there is one that solves it
  TorusSolution solve_torus(const scene::Scene &scene, const Methods &available, double horizon,
                            ProblemsInTime<2> &problems);
} // namespace plumbline::study
