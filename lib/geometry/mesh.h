#pragma once

#include "geometry/lattice.h"
#include "geometry/polygon.h"

#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// A straight-sided triangle or quadrilateral of a mesh.
  struct MeshCell
  {
    std::array<unsigned int, 4> vertex; ///< counter-clockwise; the first n_vertices count
    unsigned int n_vertices = 0;        ///< 3 or 4
    bool is_inside = false;             ///< in Ω, else in the interaction collar
    unsigned int group = 0;             ///< index into the mesh's groups, if it has any
  };

  /// A triangle whose sides follow curves.
  struct WholeCell
  {
    MeshCell corners;           ///< the triangle with straight sides
    std::size_t first_part = 0; ///< of the mesh's cells; the last ends where the next whole begins
    std::vector<unsigned int> outline; ///< vertices of its boundary, counter-clockwise
    std::array<Point<2>, 3> middles;   ///< of its sides, on their curves
  };

  /// A conforming mesh of Ω and its interaction collar.
  struct Mesh
  {
    std::vector<Point<2>> vertices; ///< [length]
    std::vector<MeshCell> cells;
    std::vector<std::string> groups; ///< gmsh's physical surfaces by name, for materials
    /// Where sides follow curves: the triangles that `cells` are parts of, each of a run of them;
    /// else empty, each cell being whole.
    std::vector<WholeCell> wholes;

    std::size_t n_wholes() const { return wholes.empty() ? cells.size() : wholes.size(); }
    Polygon polygon(std::size_t cell) const;
    bool is_triangles() const;   ///< all cells are
    bool is_quads() const;       ///< all cells are
    double longest_side() const; ///< of the cells of Ω [length]
  };

  /// Of the cells of Ω.
  Box bounding_box(const Mesh &mesh);

  /// @throws InputError  naming cell and place: no cells in Ω, inverted (clockwise), degenerate or
  /// non-convex cells, hanging vertices (a vertex inside the side of a cell), two vertices in one
  /// place, a side of more than two cells, overlapping cells, a coordinate that is not finite
  /// Cost: .05 s for 1e5 cells.
  void check(const Mesh &mesh);

  /// Distance from Ω to the outside of Ω and collar: the widest ball radius that has data. 0 where
  /// Ω touches the outside.
  /// @pre  a mesh that passes `check`
  double collar_width(const Mesh &mesh);

  /// Every cell cut into four by the midpoints of its sides: cell c becomes cells 4 c ... 4 c + 3,
  /// and the vertices keep their numbers. Of a mesh that follows curves the parts are cut, as cells
  /// of their own.
  Mesh refine(const Mesh &mesh);

  /// The triangles with straight sides of a mesh that follows curves, in their order; of another
  /// one, itself.
  Mesh straightened(const Mesh &mesh);
} // namespace plumbline::geometry
