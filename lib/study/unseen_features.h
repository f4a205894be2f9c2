#pragma once

#include "scene/problem.h"
#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace plumbline::study
{
  using SpatialValue = problem::SpatialValue<2>;

  /// Where values are looked for between nodes.
  struct PlacesBetweenNodes
  {
    std::vector<dealii::Point<2>> nodes;
    std::vector<geometry::Polygon> cells; ///< convex; several may belong to a node
    std::vector<dealii::Point<2>> middles_of_bonds;
  };

  /// What nodes do not see: for each value that is, at samples in cells or in the middle of bonds,
  /// by a tenth out of the range that it has at the nodes about them, a sentence with numbers of
  /// cells and bonds and both ranges. A feature that is thinner than the distance between samples,
  /// which is a tenth of a cell of up to 4000 and a half of a cell of many more, may be missed.
  std::vector<std::string> unseen_features(const std::vector<SpatialValue> &values,
                                           const PlacesBetweenNodes &places, double h);

  /// The same of all values of a case on a mesh, with what to do: the constants of the material,
  /// the coefficient of the kernel. None on a lattice, where nothing varies.
  std::vector<std::string> unseen_features(const scene::Case &one);
} // namespace plumbline::study
