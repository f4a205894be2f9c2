#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace plumbline::study
{
  /// Values of a smooth field at points, from its values at nodes: a cubic polynomial through the
  /// nodes nearest to a point, fitted by least squares with weights 1 / r², so that a point on a
  /// node has the node's value. Only nodes that are given are used; the fit is one-sided beside the
  /// boundary of their domain.
  /// @param nodal  shape (n_nodes, n_components)
  /// @return       shape (n_points, n_components); NaN where fewer nodes are given than a cubic
  ///               needs
  /// Accuracy: exact for cubics; for nodes of spacing h, O(h^4) for smooth fields and O(h^k) where
  /// a derivative of order k jumps. Not for fields that jump between nodes, as across cracks.
  std::vector<double> values_by_fit(const std::vector<dealii::Point<1>> &points,
                                    const std::vector<dealii::Point<1>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components);
  std::vector<double> values_by_fit(const std::vector<dealii::Point<2>> &points,
                                    const std::vector<dealii::Point<2>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components);
  std::vector<double> values_by_fit(const std::vector<dealii::Point<3>> &points,
                                    const std::vector<dealii::Point<3>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components);
} // namespace plumbline::study
