#pragma once

#include "geometry/node_cells.h"
#include "geometry/search.h"
#include "geometry/tetrahedral_mesh.h"

#include <optional>

namespace plumbline::geometry
{
  /// Finds the cells of Ω that contain given points.
  class TetrahedronSearch
  {
  public:
    /// @param mesh  must outlive the search
    explicit TetrahedronSearch(const TetrahedralMesh &mesh);

    /// A cell of Ω that holds x or has it on its boundary, to 1e-9 of the cell; none outside Ω.
    /// Thread safe.
    std::optional<std::size_t> find(const dealii::Point<3> &x) const;

  private:
    static std::vector<Cuboid> boxes_of(const TetrahedralMesh &mesh,
                                        std::vector<std::size_t> &cells);

    const TetrahedralMesh &mesh_;
    std::vector<std::size_t> cells_; ///< those of Ω
    BoxSearch<3> search_;
  };

  /// Of the cells of Ω.
  Cuboid bounding_box(const TetrahedralMesh &mesh);

  /// Of the cells of Ω. [length^3]
  double volume(const TetrahedralMesh &mesh);

  /// The cubes of side h in Ω. The lattice is centred in Ω's bounding box and has as many whole
  /// cubes as fit into it; cubes that a face of Ω's boundary cuts are left out. The others fill Ω
  /// if it is a union of cubes of this lattice, else all of Ω except a layer at its boundary.
  /// @throws InputError  h <= 0, no such cube
  CubeLattice cubes_within(const TetrahedralMesh &mesh, double h);

  /// A node at the centroid of each cell (each hexahedron, if there are such), whose cell it is;
  /// those in Ω first.
  NodeCells<3> centroid_nodes(const TetrahedralMesh &mesh);

  /// Every cell cut into eight by the midpoints of its edges: four at its corners, and the
  /// octahedron between them along its shortest diagonal (Bey 1995, doi:10.1007/BF02238487). Cell c
  /// becomes cells 8 c ... 8 c + 7, and the vertices keep their numbers. Of hexahedra:
  /// refine_hexahedra.
  TetrahedralMesh refine(const TetrahedralMesh &mesh);

  /// The same tetrahedra, without hexahedra, with vertices and cells renumbered so that the n
  /// thinnest cells of Ω come first, by volume over longest edge cubed, and their vertices, too.
  TetrahedralMesh with_thinnest_first(TetrahedralMesh mesh, std::size_t n);
} // namespace plumbline::geometry
