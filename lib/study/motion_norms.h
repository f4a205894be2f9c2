#pragma once

#include "base/communicator.h"
#include "scene/problem.h"

namespace plumbline::study
{
  /// Of nodal values, shape (n_nodes, n_components): √(area × mean of squares), or the largest.
  /// @param ranks  that have some of the nodes each
  double norm_of(const std::vector<double> &nodal, unsigned int n_components, double area,
                 bool is_largest, const base::Communicator &ranks = base::Communicator::alone());

  /// Largest less least value of a component.
  /// @param ranks  that have some of the nodes each
  double extent_of(const std::vector<double> &nodal, unsigned int n_components,
                   const base::Communicator &ranks = base::Communicator::alone());

  std::vector<double> difference(std::vector<double> a, const std::vector<double> &b);

  /// Of Ω. @pre problem.lattice()
  double area_of(const problem::Problem<2> &problem);
  double area_of(const problem::Problem<3> &problem); ///< its volume
} // namespace plumbline::study
