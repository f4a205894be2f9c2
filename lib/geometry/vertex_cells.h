#pragma once

#include "geometry/node_cells.h"

#include <functional>
#include <memory>

namespace plumbline::geometry
{
  /// Rows of nodes of a square lattice, numbered i1 + n[0] i2; each has a square of side h
  /// about it.
  struct NodeLattice
  {
    double h = 0;         ///< [length]
    Point<2> origin;      ///< node 0
    std::array<int, 2> n; ///< nodes along each axis

    std::size_t size() const { return static_cast<std::size_t>(n[0]) * n[1]; }
    Point<2> node(std::size_t i) const;
  };

  /// Calls visit(i, common) for all nodes whose squares share an area with a convex polygon.
  void for_squares_in(const NodeLattice &lattice, const Polygon &polygon,
                      const std::function<void(std::size_t i, const Polygon &common)> &visit);

  /// A body on the nodes of a lattice: each stands for the part of its square in the body.
  struct VertexCells
  {
    NodeLattice lattice;
    std::shared_ptr<const NodeCells<2>> cells; ///< `source`: the node's number in the lattice
    std::shared_ptr<const Mesh> mesh;          ///< of the body; inside: free
  };

  /// On the vertices of a lattice: a half on sides, a quarter at corners.
  /// @param body   a box of lattice cells
  /// @param fixed  vertices whose part shares area with one of these are not free; empty: all are
  /// @return       the mesh is that of the parts, rectangles
  /// @throws InputError  a body that is no box, a fixed box beside the body, nothing free
  VertexCells vertex_cells(const Lattice &body, const std::vector<Box> &fixed);

  /// On the nodes of origin + hZ²: squares cut by the cells of a mesh, all of which are the body. A
  /// part of less than 1e-9 of a square, as rounding makes them, has no node. A node of a cut
  /// square may lie outside of the body, by up to h/√2.
  /// @param mesh  of convex cells that do not overlap
  /// @throws InputError  h <= 0, a fixed box beside the body, nothing free
  /// Cost: .5 s for 1e5 nodes and 2e5 triangles.
  VertexCells vertex_cells(std::shared_ptr<const Mesh> mesh, const Point<2> &origin, double h,
                           const std::vector<Box> &fixed);

  /// The vertices of a lattice of Ω and of its collar, each with a square of side h about it. Those
  /// inside Ω are free; those on its boundary are data.
  /// @param reach  of the collar [length]
  /// @throws InputError  no vertex inside Ω
  NodeCells<2> vertex_squares(const Lattice &lattice, double reach);
} // namespace plumbline::geometry
