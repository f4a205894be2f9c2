#pragma once

#include "study/reference_estimate.h"
#include "study/statics_on_line.h"

#include <vector>

namespace plumbline::study
{
  /// The L2 distance of averages over the cells of a problem on intervals; `b` empty: 0.
  double averages_l2(const problem::Problem<1> &problem, const std::vector<double> &a,
                     const std::vector<double> &b = {});

  /// The estimated error of a Galerkin solution, its averages and its field, from changes to h/2,
  /// from 2 h and to degree p + 1, as estimate_error() does in the plane.
  /// @param points  where the error is also estimated: from the same changes there, and at least
  /// twice the root mean square of these over all points
  ErrorEstimate estimate_on_line(const Method &method, const problem::Problem<1> &problem,
                                 const SolutionOnLine &solution,
                                 const std::vector<dealii::Point<1>> &points = {});
} // namespace plumbline::study
