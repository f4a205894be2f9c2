#include "reference/mesh/space.h"

#include "base/error.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    unsigned int cell_size(const geometry::Mesh &mesh)
    {
      if (mesh.is_triangles())
        return 3;
      if (mesh.is_quads())
        return 4;
      throw InputError("the mesh has both triangles and quadrilaterals, but a space stands on one "
                       "kind; recombine all cells, or none (Domain/mesh)");
    }

    /// Numbers the points that cells share: vertices, and inner points of sides.
    class SharedPoints
    {
    public:
      explicit SharedPoints(const geometry::Mesh &mesh) : vertex_(mesh.vertices.size(), none) {}

      unsigned int at_vertex(unsigned int vertex, unsigned int &n)
      {
        if (vertex_[vertex] == none)
          vertex_[vertex] = n++;
        return vertex_[vertex];
      }

      /// The k-th of n_inner points of the side from a to b.
      unsigned int on_side(unsigned int a, unsigned int b, unsigned int k, unsigned int n_inner,
                           unsigned int &n)
      {
        const auto [side, is_new] = side_.try_emplace(std::minmax(a, b), n);
        if (is_new)
          n += n_inner;
        return side->second + (a < b ? k : n_inner - 1 - k);
      }

    private:
      static constexpr unsigned int none = -1;
      std::vector<unsigned int> vertex_;
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> side_;
    };
  } // namespace

  MeshSpace::MeshSpace(std::shared_ptr<const geometry::Mesh> mesh, bool is_continuous,
                       unsigned int degree, const Middles &middles, std::vector<unsigned int> order)
      : mesh_(std::move(mesh)), is_continuous_(is_continuous && degree > 0),
        shapes_(cell_size(*mesh_), degree), order_(std::move(order))
  {
    const unsigned int n_sides = shapes_.n_vertices(), n_inner = degree > 0 ? degree - 1 : 0;
    SharedPoints shared(*mesh_);
    unsigned int n = 0;
    const std::size_t n_cells = mesh_->cells.size();
    dofs_.resize(n_cells * shapes_.size());
    maps_.reserve(n_cells);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      maps_.emplace_back(mesh_->polygon(cell));
    for (std::size_t i = 0; i < n_cells; ++i)
    {
      const std::size_t cell = cell_at(i);
      const auto &vertex = mesh_->cells[cell].vertex;
      unsigned int *dof = &dofs_[cell * shapes_.size()], *const end = dof + shapes_.size();
      if (is_continuous_)
      {
        for (unsigned int v = 0; v < n_sides; ++v)
          *dof++ = shared.at_vertex(vertex[v], n);
        for (unsigned int side = 0; side < n_sides; ++side)
          for (unsigned int k = 0; k < n_inner; ++k)
            *dof++ = shared.on_side(vertex[side], vertex[(side + 1) % n_sides], k, n_inner, n);
      }
      while (dof != end)
        *dof++ = n++;
    }

    // free ones first, in the order of the cells
    std::vector<char> is_free(n, 1);
    for (std::size_t cell = 0; cell < mesh_->cells.size(); ++cell)
      for (unsigned int a = 0; a < shapes_.size() && !mesh_->cells[cell].is_inside; ++a)
        is_free[dofs(cell)[a]] = 0;
    std::vector<unsigned int> number(n);
    for (unsigned int i = 0; i < n; ++i)
      if (is_free[i] != 0)
        number[i] = static_cast<unsigned int>(n_free_++);
    unsigned int next = static_cast<unsigned int>(n_free_);
    for (unsigned int i = 0; i < n; ++i)
      if (is_free[i] == 0)
        number[i] = next++;
    for (unsigned int &dof : dofs_)
      dof = number[dof];

    support_.resize(n);
    for (std::size_t cell = 0; cell < mesh_->cells.size(); ++cell)
      for (unsigned int a = 0; a < shapes_.size(); ++a)
        support_[dofs(cell)[a]] = maps_[cell].point(shapes_.support()[a]);
    if (is_continuous_ && degree == 2 && !middles.empty())
      move_nodes(middles);
  }

  void MeshSpace::move_nodes(const Middles &middles)
  {
    const unsigned int n = shapes_.size();
    own_.resize(mesh_->cells.size());
    dealii::FullMatrix<double> at_nodes(n, n); // row: function, column: node
    std::vector<double> phi(n);
    for (std::size_t cell = 0; cell < mesh_->cells.size(); ++cell)
    {
      bool is_moved = false;
      for (unsigned int a = 0; a < n; ++a)
      {
        Point<2> node = maps_[cell].point(shapes_.support()[a]);
        if (a >= 3 && middles[cell][a - 3].distance(node) > 0)
        {
          // what rounding moves is not worth functions of its own
          constexpr double rounding = 1e-12;
          const double size = std::sqrt(maps_[cell].determinant({}));
          is_moved = is_moved || middles[cell][a - 3].distance(node) > rounding * size;
          node = middles[cell][a - 3];
          support_[dofs(cell)[a]] = node;
        }
        shapes_.values(maps_[cell].unit(node), phi.data());
        for (unsigned int b = 0; b < n; ++b)
          at_nodes(b, a) = phi[b];
      }
      if (!is_moved)
        continue;
      at_nodes.gauss_jordan();
      own_[cell].resize(n * n);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          own_[cell][a * n + b] = at_nodes(a, b);
    }
  }

  void MeshSpace::values(std::size_t cell, const Point<2> &unit, double *phi) const
  {
    shapes_.values(unit, phi);
    const std::vector<double> &own = own_functions(cell);
    if (own.empty())
      return;
    const unsigned int n = shapes_.size();
    const std::vector<double> before(phi, phi + n);
    for (unsigned int a = 0; a < n; ++a)
    {
      phi[a] = 0;
      for (unsigned int b = 0; b < n; ++b)
        phi[a] += own[a * n + b] * before[b];
    }
  }

  void MeshSpace::gradients(std::size_t cell, const Point<2> &unit,
                            dealii::Tensor<1, 2> *gradient) const
  {
    const unsigned int n = shapes_.size();
    std::vector<dealii::Tensor<1, 2>> of_unit(n);
    shapes_.gradients(unit, of_unit.data());
    const std::vector<double> &own = own_functions(cell);
    for (unsigned int a = 0; a < n; ++a)
    {
      dealii::Tensor<1, 2> sum = own.empty() ? of_unit[a] : dealii::Tensor<1, 2>();
      for (unsigned int b = 0; b < n && !own.empty(); ++b)
        sum += own[a * n + b] * of_unit[b];
      gradient[a] = maps_[cell].gradient(unit, sum);
    }
  }
} // namespace plumbline::reference
