#include "reference/tetrahedra/tetrahedral_mesh.h"

namespace plumbline::reference
{
  double determinant(const TetrahedralMesh &mesh, std::size_t cell)
  {
    const auto &[a, b, c, d] = mesh.cells[cell];
    const dealii::Point<3> &x = mesh.vertices[a];
    return (mesh.vertices[b] - x) * cross_product_3d(mesh.vertices[c] - x, mesh.vertices[d] - x);
  }

  TetrahedralMesh six_per_cube(const geometry::CubeLattice &lattice, int n_layers)
  {
    // from the lower corner along three axes in turn; odd orders of the axes turn the other way
    static constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    std::array<int, 3> from{}, to{}, n_vertices{};
    for (unsigned int d = 0; d < 3; ++d)
    {
      from[d] = -n_layers;
      to[d] = lattice.n_cells()[d] + n_layers;
      n_vertices[d] = to[d] - from[d] + 1;
    }
    TetrahedralMesh mesh;
    geometry::for_each_index(from, {to[0] + 1, to[1] + 1, to[2] + 1},
                             [&](const std::array<int, 3> &at)
                             {
                               mesh.vertices.emplace_back(lattice.coordinate(0, at[0]),
                                                          lattice.coordinate(1, at[1]),
                                                          lattice.coordinate(2, at[2]));
                             });
    geometry::for_each_index(
        from, to,
        [&](const std::array<int, 3> &cube)
        {
          for (std::size_t k = 0; k < orders.size(); ++k)
          {
            std::array<int, 3> at = {cube[0] - from[0], cube[1] - from[1], cube[2] - from[2]};
            std::array<unsigned int, 4> cell{};
            for (std::size_t corner = 0; corner < 4; ++corner)
            {
              cell[corner] = static_cast<unsigned int>(geometry::number_within(at, n_vertices));
              if (corner < 3)
                ++at[orders[k][corner]];
            }
            if (k >= 3)
              std::swap(cell[2], cell[3]);
            mesh.cells.push_back(cell);
            mesh.is_inside.push_back(lattice.is_inside(cube) ? 1 : 0);
          }
        });
    return mesh;
  }
} // namespace plumbline::reference
