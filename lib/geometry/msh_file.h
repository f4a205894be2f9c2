#pragma once

#include "geometry/curved_mesh.h"
#include "geometry/tetrahedral_mesh.h"

#include <string>

namespace plumbline::geometry
{
  /// A text of gmsh's formats that `read_msh` cannot read itself: 1, 4.0, or binary.
  bool is_other_msh(const std::string &text);

  /// Cells of the physical surfaces of a mesh in gmsh's format 2.0 to 2.2 or 4.1 as text, ordered
  /// by surface; names and rules as `read_mesh`. Vertices are those of the whole file. Our own
  /// reader: gmsh's says "Error loading" to whatever is wrong, and some files crash it.
  /// @param source  opens messages, e.g. "mesh file 'disk.msh'"
  /// @param curves  if given: triangles may be of second to fourth order, and their points between
  /// corners are put there
  /// @throws InputError  naming the line: another format, a section that is missing, does not end
  /// or holds less than it announces, words that are no numbers, vertices that are not there or
  /// given twice; physical surfaces missing or others than these, a surface in two of them, cells
  /// of higher order, a mesh out of the plane z = 0 Limits: 2^31 vertices. Cost: .5 s for 1e6
  /// cells.
  Mesh read_msh(const std::string &text, const std::string &source, bool has_collar,
                SideCurves *curves = nullptr);

  /// The same for tetrahedra or hexahedra of first order in physical volumes, in the order of the
  /// file's nodes, as they are: inverted ones, too. Of hexahedra the cells are left out, and
  /// is_inside and group are theirs, see six_per_hexahedron.
  /// @throws InputError  as read_msh, and other cells or cells of both kinds in physical volumes
  TetrahedralMesh read_msh_tetrahedra(const std::string &text, const std::string &source);
} // namespace plumbline::geometry
