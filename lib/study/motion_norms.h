#pragma once

#include "scene/problem.h"

namespace plumbline::study
{
  /// Of nodal values, shape (n_nodes, n_components): √(area × mean of squares), or the largest.
  double norm_of(const std::vector<double> &nodal, unsigned int n_components, double area,
                 bool is_largest);

  /// Largest less least value of a component.
  double extent_of(const std::vector<double> &nodal, unsigned int n_components);

  std::vector<double> difference(std::vector<double> a, const std::vector<double> &b);

  /// Of Ω. @pre problem.lattice()
  double area_of(const problem::Problem<2> &problem);
  double area_of(const problem::Problem<3> &problem); ///< its volume
} // namespace plumbline::study
