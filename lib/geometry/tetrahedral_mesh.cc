#include "geometry/tetrahedral_mesh.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace plumbline::geometry
{
  double determinant(const TetrahedralMesh &mesh, std::size_t cell)
  {
    const auto &[a, b, c, d] = mesh.cells[cell];
    const dealii::Point<3> &x = mesh.vertices[a];
    return (mesh.vertices[b] - x) * cross_product_3d(mesh.vertices[c] - x, mesh.vertices[d] - x);
  }

  TetrahedralMesh six_per_cube(const CubeLattice &lattice, int n_layers)
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
    for_each_index(from, {to[0] + 1, to[1] + 1, to[2] + 1},
                   [&](const std::array<int, 3> &at)
                   {
                     mesh.vertices.emplace_back(lattice.coordinate(0, at[0]),
                                                lattice.coordinate(1, at[1]),
                                                lattice.coordinate(2, at[2]));
                   });
    for_each_index(
        from, to,
        [&](const std::array<int, 3> &cube)
        {
          for (std::size_t k = 0; k < orders.size(); ++k)
          {
            std::array<int, 3> at = {cube[0] - from[0], cube[1] - from[1], cube[2] - from[2]};
            std::array<unsigned int, 4> cell{};
            for (std::size_t corner = 0; corner < 4; ++corner)
            {
              cell[corner] = static_cast<unsigned int>(number_within(at, n_vertices));
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

  int layers_within(double horizon, double h)
  {
    constexpr double rounding = 1e-9;
    return static_cast<int>(std::ceil(horizon / h - rounding));
  }

  namespace
  {
    /// Vertices with all cells in the collar, but not those on the sides of the box about the mesh.
    std::vector<char> vertices_around(const TetrahedralMesh &mesh)
    {
      dealii::Point<3> lower = mesh.vertices.front(), upper = lower;
      for (const dealii::Point<3> &x : mesh.vertices)
        for (unsigned int d = 0; d < 3; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
      constexpr double off = 1e-6; // of the box; rounding
      std::vector<char> is_around;
      for (const dealii::Point<3> &x : mesh.vertices)
      {
        bool is_clear = true;
        for (unsigned int d = 0; d < 3; ++d)
          is_clear =
              is_clear && std::min(x[d] - lower[d], upper[d] - x[d]) > off * (upper[d] - lower[d]);
        is_around.push_back(is_clear ? 1 : 0);
      }
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (const unsigned int vertex : mesh.cells[cell])
          if (mesh.is_inside[cell] != 0)
            is_around[vertex] = 0;
      return is_around;
    }
  } // namespace

  TetrahedralMesh with_moved_vertices(TetrahedralMesh mesh, double most, unsigned int seed)
  {
    constexpr double least_share = .1;
    constexpr unsigned int n_trials = 20;
    std::vector<std::vector<std::size_t>> cells(mesh.vertices.size());
    std::vector<double> least;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      least.push_back(least_share * determinant(mesh, cell));
      for (const unsigned int vertex : mesh.cells[cell])
        cells[vertex].push_back(cell);
    }
    std::mt19937 random(seed);
    const auto draw = [&] { return most * (2 * (random() * 0x1p-32) - 1); };
    const auto move_vertex = [&](std::size_t vertex)
    {
      const dealii::Point<3> place = mesh.vertices[vertex];
      dealii::Tensor<1, 3> move;
      for (unsigned int d = 0; d < 3; ++d)
        move[d] = draw();
      const auto is_good = [&]
      {
        return std::all_of(cells[vertex].begin(), cells[vertex].end(),
                           [&](std::size_t cell)
                           { return determinant(mesh, cell) >= least[cell]; });
      };
      mesh.vertices[vertex] = place + move;
      for (unsigned int trial = 0; trial < n_trials && !is_good(); ++trial)
        mesh.vertices[vertex] = place + (move /= 2);
      if (!is_good())
        mesh.vertices[vertex] = place;
    };
    for (const std::vector<char> &is_moved : {inner_vertices(mesh), vertices_around(mesh)})
      for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex)
        if (is_moved[vertex] != 0)
          move_vertex(vertex);
    return mesh;
  }

  std::vector<char> inner_vertices(const TetrahedralMesh &mesh)
  {
    std::vector<char> is_inner(mesh.vertices.size(), 1);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (const unsigned int vertex : mesh.cells[cell])
        if (mesh.is_inside[cell] == 0)
          is_inner[vertex] = 0;
    return is_inner;
  }
} // namespace plumbline::geometry
