#include "reference/tetrahedra/field.h"

#include "base/error.h"
#include "geometry/polyhedron_clip.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;

    geometry::Cuboid box_of(const TetrahedralMesh &mesh, std::size_t cell)
    {
      const Point<3> &first = mesh.vertices[mesh.cells[cell][0]];
      geometry::Cuboid box{first, first};
      for (const unsigned int vertex : mesh.cells[cell])
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] = std::min(box.lower[d], mesh.vertices[vertex][d]);
          box.upper[d] = std::max(box.upper[d], mesh.vertices[vertex][d]);
        }
      return box;
    }

    std::array<double, 4> linear_functions(const TetrahedralMesh &mesh, std::size_t cell,
                                           const Point<3> &x)
    {
      const auto slopes = gradients(mesh, cell);
      std::array<double, 4> values{};
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        const Point<3> &next = mesh.vertices[mesh.cells[cell][(corner + 1) % 4]];
        values[corner] = slopes[corner] * (x - next);
      }
      return values;
    }
    /// visit(cube, volume / h³, corners' linear functions at the centroid) of what the cell has in
    /// common with the cubes of a lattice.
    template <class Visit>
    void for_common_parts(const TetrahedralMesh &mesh, std::size_t cell,
                          const geometry::CubeLattice &lattice, const Visit &visit)
    {
      constexpr double rounding = 1e-9; // of h
      const double h = lattice.h();
      const geometry::Cuboid box = box_of(mesh, cell);
      std::array<int, 3> from{}, to{};
      bool is_within = true; // cells of a mesh may reach beyond its cubes
      for (unsigned int d = 0; d < 3; ++d)
      {
        from[d] = static_cast<int>(std::floor((box.lower[d] - lattice.origin()[d]) / h + rounding));
        to[d] = static_cast<int>(std::ceil((box.upper[d] - lattice.origin()[d]) / h - rounding));
        is_within = is_within && from[d] >= 0 && to[d] <= lattice.n_cells()[d];
        from[d] = std::max(from[d], 0);
        to[d] = std::min(to[d], lattice.n_cells()[d]);
      }
      if (is_within && to[0] - from[0] == 1 && to[1] - from[1] == 1 && to[2] - from[2] == 1)
      {
        constexpr double quarter = 1. / 4;
        visit(lattice.number(from), determinant(mesh, cell) / (6 * std::pow(h, 3)),
              std::array<double, 4>{quarter, quarter, quarter, quarter});
        return;
      }
      const auto slopes = gradients(mesh, cell);
      geometry::for_each_index(
          from, to,
          [&](const std::array<int, 3> &cube)
          {
            Point<3> lower;
            for (unsigned int d = 0; d < 3; ++d)
              lower[d] = lattice.coordinate(d, cube[d]);
            // in units of h from the cube's corner, where a linear function is at + slope·s >= 0
            const auto at = linear_functions(mesh, cell, lower);
            geometry::ClippedPolyhedron part({0, 0, 0}, {1, 1, 1});
            for (unsigned int corner = 0; corner < 4; ++corner)
              if (!part.clip(-h * slopes[corner], at[corner]))
                return;
            if (part.volume() < rounding * rounding)
              return;
            const geometry::SolidMoments common =
                part.placed([](const Point<3> &s) { return s; }).moments();
            visit(lattice.number(cube), common.volume,
                  linear_functions(mesh, cell, Point<3>(lower + h * common.centroid)));
          });
    }
  } // namespace

  TetrahedralField::TetrahedralField(std::shared_ptr<const TetrahedralSpace> space,
                                     std::vector<double> values)
      : space_(std::move(space)), values_(std::move(values))
  {
  }

  void TetrahedralField::make_search() const
  {
    const TetrahedralMesh &mesh = space_->mesh();
    std::vector<geometry::Cuboid> boxes;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.is_inside[cell] != 0)
      {
        inner_.push_back(cell);
        boxes.push_back(box_of(mesh, cell));
      }
    search_ = std::make_unique<const geometry::BoxSearch<3>>(std::move(boxes));
  }

  std::pair<std::size_t, std::array<double, 4>> TetrahedralField::place(const Point<3> &x) const
  {
    std::call_once(is_search_made_, [this] { make_search(); });
    constexpr double rounding = 1e-9; // of a cell, as Domain/boxes have it
    const geometry::Cuboid &typical = search_->box(0);
    const double margin = rounding * typical.lower.distance(typical.upper);
    geometry::Cuboid about{x, x};
    for (unsigned int d = 0; d < 3; ++d)
    {
      about.lower[d] -= margin;
      about.upper[d] += margin;
    }
    std::vector<unsigned int> near;
    search_->find(about, near);
    double best = -rounding;
    std::pair<std::size_t, std::array<double, 4>> found{inner_.size(), {}};
    for (const unsigned int k : near)
    {
      const auto values = linear_functions(space_->mesh(), inner_[k], x);
      if (const double least = *std::min_element(values.begin(), values.end()); least > best)
      {
        best = least;
        found = {inner_[k], values};
      }
    }
    if (best == -rounding)
    {
      std::ostringstream message;
      message << "(" << x << ") is outside the domain; take points inside it";
      throw NumericalError(message.str());
    }
    return found;
  }

  double TetrahedralField::value(const Point<3> &x) const
  {
    const auto [cell, functions] = place(x);
    double sum = 0;
    for (unsigned int corner = 0; corner < 4; ++corner)
      sum += functions[corner] * values_[space_->dof(cell, corner)];
    return sum;
  }

  dealii::Tensor<1, 3> TetrahedralField::gradient(const Point<3> &x) const
  {
    const std::size_t cell = place(x).first;
    const auto slopes = gradients(space_->mesh(), cell);
    dealii::Tensor<1, 3> sum;
    for (unsigned int corner = 0; corner < 4; ++corner)
      sum += values_[space_->dof(cell, corner)] * slopes[corner];
    return sum;
  }

  std::vector<double> TetrahedralField::averages(const geometry::CubeLattice &lattice) const
  {
    const TetrahedralMesh &mesh = space_->mesh();
    const auto &n = lattice.n_cells();
    std::vector<double> sums(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      if (mesh.is_inside[cell] == 0)
        continue;
      std::array<double, 4> values{};
      for (unsigned int corner = 0; corner < 4; ++corner)
        values[corner] = values_[space_->dof(cell, corner)];
      for_common_parts(mesh, cell, lattice,
                       [&](std::size_t cube, double share, const std::array<double, 4> &functions)
                       {
                         for (unsigned int corner = 0; corner < 4; ++corner)
                           sums[cube] += share * functions[corner] * values[corner];
                       });
    }
    std::vector<double> result;
    lattice.for_each_cell([&](const std::array<int, 3> &cube)
                          { result.push_back(sums[lattice.number(cube)]); });
    return result;
  }

  std::vector<double> tested_load(const problem::Field<3> &load, const TetrahedralSpace &space)
  {
    const TetrahedralMesh &mesh = space.mesh();
    static const dealii::QWitherdenVincentSimplex<3> rule(3); // of degree 5
    std::vector<std::array<double, 4>> of_cells(mesh.cells.size());
    constexpr unsigned int grain = 64;
    dealii::parallel::apply_to_subranges(
        static_cast<std::size_t>(0), mesh.cells.size(),
        [&](std::size_t begin, std::size_t end)
        {
          const problem::Field<3> b = load; // a thread's own
          for (std::size_t cell = begin; cell < end; ++cell)
          {
            if (mesh.is_inside[cell] == 0)
              continue;
            const double jacobian = determinant(mesh, cell);
            for (unsigned int q = 0; q < rule.size(); ++q)
            {
              const auto &s = rule.point(q);
              const std::array<double, 4> phi = {1 - s[0] - s[1] - s[2], s[0], s[1], s[2]};
              dealii::Tensor<1, 3> x;
              for (unsigned int corner = 0; corner < 4; ++corner)
                x += phi[corner] * mesh.vertices[mesh.cells[cell][corner]];
              const double value = jacobian * rule.weight(q) * b(Point<3>(x), 0);
              for (unsigned int corner = 0; corner < 4; ++corner)
                of_cells[cell][corner] += value * phi[corner];
            }
          }
        },
        grain);
    std::vector<double> result(space.n_free());
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int corner = 0; corner < 4; ++corner)
        if (const unsigned int dof = space.dof(cell, corner); dof < result.size())
          result[dof] += of_cells[cell][corner];
    return result;
  }

  std::vector<double> volumes(const TetrahedralSpace &space)
  {
    constexpr double share = 1. / 24; // a quarter of determinant / 6
    std::vector<double> result(space.n_free());
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      for (unsigned int corner = 0; corner < 4; ++corner)
        if (const unsigned int dof = space.dof(cell, corner); dof < result.size())
          result[dof] += share * determinant(space.mesh(), cell);
    return result;
  }
} // namespace plumbline::reference
