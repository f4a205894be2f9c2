#pragma once

#include "reference/mesh/cell_shapes.h"

#include <vector>

namespace plumbline::reference
{
  /// A rule on the unit cell with the shape functions at its points.
  struct ShapeRule
  {
    std::vector<Point<2>> unit;
    std::vector<double> weight; ///< adds up to the area of the unit cell
    std::vector<double> phi;    ///< shape (n_points, n_shapes)
  };

  /// What pairs of cells are integrated by, an outer E and an inner E'.
  struct PairRules
  {
    ShapeRule outer;                     ///< on all of E
    ShapeRule refined;                   ///< on parts of E, of higher degree
    std::vector<ShapeRule> graded;       ///< on parts at sides of E': index i is of size 2^i
    std::vector<ShapeRule> whole;        ///< on all of a cell: index i is exact to degree 2 i + 1
    std::vector<double> integrals, mass; ///< of the shape functions over an affine cell's area
  };

  /// @param refinement  how often parts of E are halved
  PairRules pair_rules(const CellShapes &shapes, unsigned int refinement);
} // namespace plumbline::reference
