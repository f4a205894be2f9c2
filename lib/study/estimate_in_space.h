#pragma once

#include "analysis/statics.h"
#include "base/communicator.h"
#include "problem/in_space.h"
#include "study/reference_estimate.h"

#include <vector>

namespace plumbline::study
{
  /// The volume that the average over a cube represents: that of the cube; on a mesh, whose cubes
  /// leave out a layer at the boundary of Ω, an equal part of Ω, so that norms at all levels are
  /// those of one domain.
  double cell_volume(const problem::Problem<3> &problem);

  /// The L2 distance of averages over the cells of a problem; `b` empty: 0.
  /// @param ranks  that each have the cells of their slab
  double averages_l2(const problem::Problem<3> &problem, const base::Communicator &ranks,
                     const std::vector<double> &a, const std::vector<double> &b = {});

  /// How far the averages of a Galerkin solution may be wrong, by the changes to h/2 and from 2 h,
  /// as estimate_error() has them in the plane. Of the field and of degree p + 1 nothing is known.
  /// @param points  where the error is estimated, too
  ErrorEstimate estimate_in_space(const Method &method, const problem::Problem<3> &problem,
                                  const analysis::SolutionInSpace &solution,
                                  const base::Communicator &ranks,
                                  const std::vector<dealii::Point<3>> &points = {});
} // namespace plumbline::study
