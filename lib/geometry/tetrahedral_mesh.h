#pragma once

#include "geometry/cube_lattice.h"

#include <array>
#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// Corners in the order of the unit cube's: number i + 2 j + 4 k is at (i, j, k).
  using Hexahedra = std::vector<std::array<unsigned int, 8>>;

  /// A conforming mesh of tetrahedra that fills Ω and its collar. A mesh of hexahedra is also one
  /// of tetrahedra, six in each.
  struct TetrahedralMesh
  {
    std::vector<dealii::Point<3>> vertices;         ///< [length]
    std::vector<std::array<unsigned int, 4>> cells; ///< of positive volume in this order
    std::vector<char> is_inside;                    ///< the cell is in Ω, else in the collar
    /// Cells n_in_hexahedron k ... n_in_hexahedron k + 5 fill hexahedron k; empty: there are none.
    Hexahedra hexahedra = {};
    std::vector<unsigned int> group = {}; ///< of each cell, among `groups`; empty: there are none
    std::vector<std::string> groups = {}; ///< physical volumes of a file, by name
  };

  /// Tetrahedra in a hexahedron.
  inline constexpr std::size_t n_in_hexahedron = 6;

  /// Six times the volume of a tetrahedron, > 0 in the order of TetrahedralMesh. [length^3]
  double determinant(const TetrahedralMesh &mesh, std::size_t cell);

  /// Six tetrahedra for each cube, all around its diagonal from the lower to the upper corner: the
  /// points with coordinates in the same order (Freudenthal 1942, Kuhn 1960). Translations by h
  /// along an axis map this mesh onto itself.
  /// @param n_layers  of cubes around the bounding box of Ω
  /// Vertex (i, j, k), counted from the lower corner of these cubes, is number i + n (j + m k),
  /// with n and m vertices along x and y; the cells of cube (i, j, k) are 6 c ... 6 c + 5 where c
  /// is its number, counted alike.
  TetrahedralMesh six_per_cube(const CubeLattice &lattice, int n_layers);

  /// Layers of cubes as wide as the horizon.
  int layers_within(double horizon, double h);

  /// The mesh with each vertex inside Ω, and inside its collar, moved by up to `most` along each
  /// axis, uniformly, with a seed, the same on every machine; those on the surface of Ω and of the
  /// box that holds the mesh stay. A move is halved until no cell is left with less than a tenth of
  /// its volume. Few pairs of faces then have parallel edges, which
  /// would make ExactPairs slower.
  /// @param most  >= 0 [length]
  TetrahedralMesh with_moved_vertices(TetrahedralMesh mesh, double most, unsigned int seed);

  /// Of each vertex, whether all cells around it are in Ω.
  std::vector<char> inner_vertices(const TetrahedralMesh &mesh);
} // namespace plumbline::geometry
