#pragma once

#include "geometry/node_cells.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

#include <string>

namespace plumbline::reference
{
  /// A function of a mesh space on Ω and its collar.
  struct MeshField
  {
    std::shared_ptr<const MeshSpace> space;
    std::shared_ptr<const MeshCells> cells;
    unsigned int n_components = 0;
    std::vector<double> values; ///< shape (n_dofs, n_components)

    /// @param x  in Ω or its collar; where cells meet, on the one that `CellLocator` finds
    /// @throws InputError  x outside
    double value(const Point<2> &x, unsigned int component) const;

    /// On the cell that value() takes.
    dealii::Tensor<1, 2> gradient(const Point<2> &x, unsigned int component) const;

    /// Averages over the cells of the free nodes, shape (n_free, n_components): the pieces that the
    /// mesh's cells cut out of them are integrated exactly (on cells with a bilinear map, to the
    /// degree of the rule).
    std::vector<double> averages(const geometry::NodeCells<2> &nodes) const;
  };

  /// √ ∫_Ω |u|² of a field; the L2 distance of two fields is that of their difference.
  double l2_norm(const MeshField &field);

  /// Write a field through deal.II's DataOut; cubic triangles are written as quadratic ones, cells
  /// up to straight sides.
  void write_vtu(const MeshField &field, const std::string &file);
} // namespace plumbline::reference
