#pragma once

#include "algebra/slab_model.h"
#include "study/preflight.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// What ranks send and, by the model of algebra/slab_model.h, how long they take.
  struct TimeOfLevel
  {
    std::string method, series;
    problem::Level level;
    algebra::SlabLayout layout;
    algebra::ModelTime apply;        ///< the operator once; in time the forces once
    algebra::ModelTime precondition; ///< of static problems
    algebra::ModelTime iteration;    ///< of conjugate gradients, in static problems
  };

  /// Of the methods that are distributed over ranks in slabs, by method, series and level, where
  /// the domain is one box. Stencils are computed and nothing else, so the number of unknowns is
  /// not limited.
  /// @param n_levels  the first so many of each series; 0: all
  /// @pre scene.domain.is_in_space()
  std::vector<TimeOfLevel> predict_times(const scene::Scene &scene, const Methods &methods,
                                         unsigned int n_levels, unsigned int n_ranks,
                                         const algebra::Rates &rates);
} // namespace plumbline::study
