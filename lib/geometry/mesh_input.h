#pragma once

#include "geometry/lattice.h"
#include "geometry/mesh.h"
#include "geometry/tetrahedral_mesh.h"

#include <functional>

namespace plumbline::geometry
{
  /// A mesh from a gmsh file. .msh: as it is, first-order triangles and quadrilaterals. .geo:
  /// meshed by gmsh in two dimensions with the constants h and delta set, for
  /// DefineConstant[ h = .1, delta = .3 ]. Physical surfaces whose name begins with 'omega'
  /// make up Ω, those that begin with 'collar' the collar, if it has one, in small letters or
  /// capitals; surfaces that are not physical are left out. Clockwise cells are turned around.
  /// gmsh runs as a process of its own with limits (GmshLimits), and scripts that would start
  /// programs or write files are refused (check_script).
  /// @param is_curved  sides follow the curves of the .geo file, or the points between corners of a
  /// .msh file of second to fourth order, see follow_curves; triangles alone
  /// @throws InputError  file not readable, as read_msh, check_script and mesh_by_gmsh, and as
  /// `check`; curved sides asked for where none is curved
  Mesh read_mesh(const std::string &file, double h, double delta, bool has_collar = true,
                 bool is_curved = false);

  /// The same for tetrahedra or hexahedra of first order in physical volumes, for problems in
  /// space; .geo files are meshed in three dimensions. Inverted cells are turned around.
  /// @throws InputError  as read_mesh, read_msh_tetrahedra, check_hexahedra and `check` of such a
  /// mesh
  TetrahedralMesh read_tetrahedra(const std::string &file, double h, double delta);

  /// One of deal.II's GridGenerator functions by name, e.g. "hyper_ball_balanced" with "0, 0 : 1",
  /// refined until no side is longer than h, vertices on curved boundaries, sides straight. Ω: the
  /// cells whose centre, the mean of their vertices, satisfies is_inside.
  /// @throws InputError  unknown generator or arguments, with deal.II's words, h <= 0 or so small
  /// that there are more than 1e7 cells, and as `check`. deal.II's debug build ends the program at
  /// arguments out of range, unless its disable_abort_on_exception was called, as `plumbline` does.
  Mesh generate_mesh(const std::string &generator, const std::string &arguments, double h,
                     const std::function<bool(const Point<2> &)> &is_inside);

  /// The squares of a lattice, or their halves (cut from lower left to upper right), with all
  /// squares of the collar that reach within delta of Ω, vertices moved by a map (the identity if
  /// empty). Layers are added to the collar until it is delta wide after the map.
  /// @throws InputError  as `Lattice`, a map that inverts cells or does not widen the collar, and
  /// as `check`
  Mesh lattice_mesh(const Domain &domain, double h, double delta, bool is_triangles,
                    const std::function<Point<2>(const Point<2> &)> &map = {});
} // namespace plumbline::geometry
