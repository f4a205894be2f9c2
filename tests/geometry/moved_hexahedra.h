// The cubes of a lattice as hexahedra, with moved vertices.
#pragma once

#include "geometry/hexahedron.h"

#include <random>
#include <utility>

namespace plumbline::tests
{
  /// @param most  how far vertices move along each axis, all of them [length]
  inline geometry::TetrahedralMesh moved_hexahedra(const geometry::CubeLattice &lattice,
                                                   int n_layers, double most, unsigned int seed = 7)
  {
    const geometry::TetrahedralMesh cut = geometry::six_per_cube(lattice, n_layers);
    std::vector<dealii::Point<3>> vertices = cut.vertices;
    std::mt19937 random(seed);
    for (dealii::Point<3> &x : vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += most * (2 * (random() / 4294967296.) - 1);
    const auto along = [&](unsigned int d)
    { return static_cast<unsigned int>(lattice.n_cells()[d] + 2 * n_layers + 1); };
    geometry::Hexahedra hexahedra;
    std::vector<char> is_inside;
    for (std::size_t cell = 0; cell < cut.cells.size(); cell += geometry::n_in_hexahedron)
    {
      hexahedra.emplace_back();
      for (unsigned int corner = 0; corner < 8; ++corner)
        hexahedra.back()[corner] =
            cut.cells[cell][0] + corner % 2 + along(0) * (corner / 2 % 2 + along(1) * (corner / 4));
      is_inside.push_back(cut.is_inside[cell]);
    }
    return geometry::six_per_hexahedron(std::move(vertices), std::move(hexahedra), is_inside);
  }
} // namespace plumbline::tests
