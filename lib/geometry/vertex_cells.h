#pragma once

#include "geometry/node_cells.h"

namespace plumbline::geometry
{
  /// A body on the vertices of a lattice: every vertex, those on the boundary among them, stands
  /// for the part of its square in the body: a half on sides, a quarter at corners.
  struct VertexCells
  {
    std::shared_ptr<const Mesh> mesh; ///< these parts, rectangles; inside: free
    std::shared_ptr<const NodeCells> cells;
  };

  /// @param body   a box of lattice cells
  /// @param fixed  vertices whose part shares area with one of these are not free
  /// @throws InputError  a body that is no box, nothing fixed, nothing free
  VertexCells vertex_cells(const Lattice &body, const std::vector<Box> &fixed);

  /// The vertices of a lattice of Ω and of its collar, each with a square of side h about it. Those
  /// inside Ω are free; those on its boundary are data.
  /// @param reach  of the collar [length]
  /// @throws InputError  no vertex inside Ω
  NodeCells vertex_squares(const Lattice &lattice, double reach);
} // namespace plumbline::geometry
