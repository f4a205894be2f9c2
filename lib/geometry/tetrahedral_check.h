#pragma once

#include "geometry/tetrahedral_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace plumbline::geometry
{
  /// A face as one of its cells sees it.
  struct TetrahedralSide
  {
    std::array<unsigned int, 3> key{}; ///< vertices, ascending: two cells of a face have the same
    std::size_t cell = 0;
    unsigned int opposite = 0; ///< the cell's corner that is not in the face
  };

  /// Those of all cells, ordered by key, then by cell.
  std::vector<TetrahedralSide> sides_of(const TetrahedralMesh &mesh);

  /// Check that the mesh consists of disjoint tetrahedra that meet in whole faces.
  /// @throws InputError  naming cell and place: no cell in Ω, a coordinate that is not finite,
  /// degenerate or inverted cells, a face of more than two cells, overlapping cells, two vertices
  /// in one place, faces that cover others in part (a mesh that is not conforming)
  /// Cost: 1 s for 1e6 cells.
  void check(const TetrahedralMesh &mesh);

  /// Distance from Ω to the outside of Ω and its collar, or `up_to` if it is larger; 0 where Ω
  /// touches the outside.
  /// @pre  a mesh that passes `check`
  double collar_width(const TetrahedralMesh &mesh, double up_to);

  /// @throws InputError  collar_width() is below `reach`: balls would contain points without data
  void check_collar(const TetrahedralMesh &mesh, double reach);
} // namespace plumbline::geometry
