#include "reference/tetrahedra/field.h"

#include "base/error.h"
#include "geometry/hexahedron.h"
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
    using geometry::Hexahedron;

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

    /// Of degree 5 on the unit tetrahedron.
    const dealii::Quadrature<3> &simplex_rule()
    {
      static const dealii::QWitherdenVincentSimplex<3> rule(3);
      return rule;
    }

    /// visit(x, weight) of a rule of degree 5 on a convex polyhedron.
    template <class Visit>
    void for_points(const geometry::ConvexPolyhedron &part, const Visit &visit)
    {
      const Point<3> &apex = part.moments().centroid;
      for (const auto &face : part.faces())
        for (std::size_t k = 2; k < face.vertices.size(); ++k)
        {
          const Point<3> &origin = part.vertices()[face.vertices[0]];
          const dealii::Tensor<1, 3> u = part.vertices()[face.vertices[k - 1]] - origin,
                                     v = part.vertices()[face.vertices[k]] - origin,
                                     w = apex - origin;
          const double jacobian = std::abs(w * cross_product_3d(u, v));
          for (unsigned int q = 0; q < simplex_rule().size(); ++q)
          {
            const Point<3> &s = simplex_rule().point(q);
            visit(Point<3>(origin + s[0] * u + s[1] * v + s[2] * w),
                  jacobian * simplex_rule().weight(q));
          }
        }
    }

    /// visit(cube, x, weight / h³) of what the cell has in common with the cubes of a lattice, by a
    /// rule that is exact for linear functions, or of degree 5.
    template <class Visit>
    void for_common_parts(const TetrahedralMesh &mesh, std::size_t cell, bool is_of_degree_5,
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
      const auto &v = mesh.cells[cell];
      const std::array<Point<3>, 4> x = {mesh.vertices[v[0]], mesh.vertices[v[1]],
                                         mesh.vertices[v[2]], mesh.vertices[v[3]]};
      if (is_within && to[0] - from[0] == 1 && to[1] - from[1] == 1 && to[2] - from[2] == 1)
      {
        const std::size_t cube = lattice.number(from);
        if (is_of_degree_5)
          for_points(geometry::ConvexPolyhedron::tetrahedron(x),
                     [&](const Point<3> &y, double weight)
                     { visit(cube, y, weight / std::pow(h, 3)); });
        else
          visit(cube, Point<3>((x[0] + x[1] + x[2] + x[3]) / 4),
                determinant(mesh, cell) / (6 * std::pow(h, 3)));
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
            const geometry::ConvexPolyhedron common =
                part.placed([](const Point<3> &s) { return s; });
            if (is_of_degree_5)
              for_points(common, [&](const Point<3> &s, double weight)
                         { visit(lattice.number(cube), Point<3>(lower + h * s), weight); });
            else
              visit(lattice.number(cube), Point<3>(lower + h * common.moments().centroid),
                    common.moments().volume);
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

  std::size_t TetrahedralField::place(const Point<3> &x) const
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
    std::size_t found = 0;
    for (const unsigned int k : near)
    {
      const auto values = linear_functions(space_->mesh(), inner_[k], x);
      if (const double least = *std::min_element(values.begin(), values.end()); least > best)
      {
        best = least;
        found = inner_[k];
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
    return value_in(place(x), x);
  }

  double TetrahedralField::value_in(std::size_t cell, const Point<3> &x) const
  {
    double sum = 0;
    if (space_->shapes().is_trilinear())
    {
      const std::size_t hexahedron = cell / geometry::n_in_hexahedron;
      const Hexahedron::Values functions =
          Hexahedron::values(Hexahedron(space_->mesh(), hexahedron).place(x));
      for (unsigned int corner = 0; corner < functions.size(); ++corner)
        sum += functions[corner] * values_[space_->corner_dof(hexahedron, corner)];
      return sum;
    }
    const auto functions = linear_functions(space_->mesh(), cell, x);
    for (unsigned int corner = 0; corner < functions.size(); ++corner)
      sum += functions[corner] * values_[space_->dof(cell, corner)];
    return sum;
  }

  dealii::Tensor<1, 3> TetrahedralField::gradient(const Point<3> &x) const
  {
    const std::size_t cell = place(x);
    dealii::Tensor<1, 3> sum;
    if (space_->shapes().is_trilinear())
    {
      const std::size_t number = cell / geometry::n_in_hexahedron;
      const Hexahedron hexahedron(space_->mesh(), number);
      const Hexahedron::Slopes slopes = hexahedron.slopes(hexahedron.place(x));
      for (unsigned int corner = 0; corner < slopes.size(); ++corner)
        sum += values_[space_->corner_dof(number, corner)] * slopes[corner];
      return sum;
    }
    const auto slopes = gradients(space_->mesh(), cell);
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
      if (mesh.is_inside[cell] != 0)
        for_common_parts(mesh, cell, space_->shapes().is_trilinear(), lattice,
                         [&](std::size_t cube, const Point<3> &x, double share)
                         { sums[cube] += share * value_in(cell, x); });
    std::vector<double> result;
    lattice.for_each_cell([&](const std::array<int, 3> &cube)
                          { result.push_back(sums[lattice.number(cube)]); });
    return result;
  }

  namespace
  {
    /// `of_cells` is added to of the cells of Ω, by integrate(b, cell, sums).
    template <std::size_t n_corners, class Integrate>
    std::vector<std::array<double, n_corners>>
    for_cells(const problem::Field<3> &load, const TetrahedralMesh &mesh, std::size_t n_parts,
              const Integrate &integrate)
    {
      std::vector<std::array<double, n_corners>> of_cells(mesh.cells.size() / n_parts);
      constexpr unsigned int grain = 64;
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), of_cells.size(),
          [&](std::size_t begin, std::size_t end)
          {
            const problem::Field<3> b = load; // a thread's own
            for (std::size_t cell = begin; cell < end; ++cell)
              if (mesh.is_inside[n_parts * cell] != 0)
                integrate(b, cell, of_cells[cell]);
          },
          grain);
      return of_cells;
    }

    /// By a product of Gauss rules of degree 5 on each hexahedron.
    std::vector<double> tested_on_hexahedra(const problem::Field<3> &load,
                                            const TetrahedralSpace &space, unsigned int component)
    {
      static const dealii::QGauss<3> rule(3);
      const auto of_cells =
          for_cells<8>(load, space.mesh(), geometry::n_in_hexahedron,
                       [&](const problem::Field<3> &b, std::size_t cell, Hexahedron::Values &sums)
                       {
                         const Hexahedron hexahedron(space.mesh(), cell);
                         for (unsigned int q = 0; q < rule.size(); ++q)
                         {
                           const auto &s = rule.point(q);
                           const double value = rule.weight(q) *
                                                determinant(hexahedron.jacobian(s)) *
                                                b(hexahedron.at(s), component);
                           const Hexahedron::Values phi = Hexahedron::values(s);
                           for (unsigned int corner = 0; corner < phi.size(); ++corner)
                             sums[corner] += value * phi[corner];
                         }
                       });
      std::vector<double> result(space.n_free());
      for (std::size_t cell = 0; cell < of_cells.size(); ++cell)
        for (unsigned int corner = 0; corner < of_cells[cell].size(); ++corner)
          if (const unsigned int dof = space.corner_dof(cell, corner); dof < result.size())
            result[dof] += of_cells[cell][corner];
      return result;
    }
  } // namespace

  std::vector<double> tested_load(const problem::Field<3> &load, const TetrahedralSpace &space,
                                  unsigned int component)
  {
    if (space.shapes().is_trilinear())
      return tested_on_hexahedra(load, space, component);
    const TetrahedralMesh &mesh = space.mesh();
    const dealii::Quadrature<3> &rule = simplex_rule();
    const auto of_cells = for_cells<4>(
        load, mesh, 1,
        [&](const problem::Field<3> &b, std::size_t cell, std::array<double, 4> &sums)
        {
          const double jacobian = determinant(mesh, cell);
          for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto &s = rule.point(q);
            const std::array<double, 4> phi = {1 - s[0] - s[1] - s[2], s[0], s[1], s[2]};
            dealii::Tensor<1, 3> x;
            for (unsigned int corner = 0; corner < 4; ++corner)
              x += phi[corner] * mesh.vertices[mesh.cells[cell][corner]];
            const double value = jacobian * rule.weight(q) * b(Point<3>(x), component);
            for (unsigned int corner = 0; corner < 4; ++corner)
              sums[corner] += value * phi[corner];
          }
        });
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
    if (space.shapes().is_trilinear())
    {
      for (std::size_t k = 0; k < space.mesh().cells.size(); ++k)
        for (unsigned int corner = 0; corner < 8; ++corner)
          if (const unsigned int dof = space.corner_dof(k / geometry::n_in_hexahedron, corner);
              dof < result.size())
            result[dof] += determinant(space.mesh(), k) / 48;
      return result;
    }
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      for (unsigned int corner = 0; corner < 4; ++corner)
        if (const unsigned int dof = space.dof(cell, corner); dof < result.size())
          result[dof] += share * determinant(space.mesh(), cell);
    return result;
  }
} // namespace plumbline::reference
