#include "meshfree/body/body.h"

#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  using geometry::Polygon;

  namespace
  {
    /// Calls visit(i, common) for all nodes whose cells share an area with a convex polygon.
    template <class Visit>
    void for_cells_in(const VariationalBody &body, const Polygon &polygon, const Visit &visit)
    {
      geometry::for_squares_in({body.h, body.origin, body.n}, polygon, visit);
    }

    void add_constraint_and_material(VariationalBody &body, const Polygons &fixed,
                                     const VariationalMaterial &material)
    {
      body.is_fixed.assign(body.size(), 0);
      body.k.assign(body.size(), 0);
      body.l.assign(body.size(), 0);
      for (const Polygon &region : fixed)
        for_cells_in(body, region, [&](std::size_t i, const Polygon &) { body.is_fixed[i] = 1; });
      bool is_any_free = false;
      for (std::size_t i = 0; i < body.size(); ++i)
        if (body.V[i] > 0)
        {
          is_any_free = is_any_free || body.is_fixed[i] == 0;
          body.k[i] = material.k(body.node(i));
          body.l[i] = material.l(body.node(i));
        }
      if (!is_any_free)
      {
        std::ostringstream message;
        message << "lattice size h = " << body.h
                << " leaves no free node outside the fixed region; choose a smaller h";
        throw InputError(message.str());
      }
    }
  } // namespace

  Point<2> VariationalBody::node(std::size_t i) const
  {
    return {origin[0] + h * static_cast<double>(i % n[0]),
            origin[1] + h * static_cast<double>(i / n[0])};
  }

  VariationalBody body_on_vertices(const geometry::Lattice &lattice, const Polygons &fixed,
                                   const VariationalMaterial &material)
  {
    const auto &n_cells = lattice.n_cells();
    VariationalBody body{
        lattice.h(), lattice.origin(), {n_cells[0] + 1, n_cells[1] + 1}, {}, {}, {}, {}};
    for (int i2 = 0; i2 < body.n[1]; ++i2)
      for (int i1 = 0; i1 < body.n[0]; ++i1)
      {
        const int n_quarters = lattice.is_inside(i1 - 1, i2 - 1) + lattice.is_inside(i1, i2 - 1) +
                               lattice.is_inside(i1 - 1, i2) + lattice.is_inside(i1, i2);
        body.V.push_back(.25 * n_quarters * body.h * body.h);
      }
    add_constraint_and_material(body, fixed, material);
    return body;
  }

  VariationalBody body_of_cells(const geometry::NodeLattice &lattice,
                                const geometry::NodeCells<2> &cells,
                                const VariationalMaterial &material)
  {
    VariationalBody body{lattice.h, lattice.origin, lattice.n, {}, {}, {}, {}};
    body.V.assign(body.size(), 0);
    body.is_fixed.assign(body.size(), 0);
    body.k = body.l = body.V;
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      const std::size_t i = cells.source[c];
      body.V[i] = cells.area[c];
      body.is_fixed[i] = static_cast<char>(c >= cells.n_free);
      body.k[i] = material.k(cells.nodes[c]);
      body.l[i] = material.l(cells.nodes[c]);
    }
    return body;
  }

  VariationalBody body_of_pieces(const Polygons &pieces, const Polygons &fixed,
                                 const VariationalMaterial &material, double h)
  {
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("lattice size h = " + std::to_string(h) + " must be a positive length");
    if (pieces.empty())
      throw InputError("the body has no pieces; give at least one convex polygon");
    VariationalBody body{h, {}, {}, {}, {}, {}, {}};
    for (unsigned int d = 0; d < 2; ++d)
    {
      double low = pieces[0][0][d], high = low;
      for (const Polygon &piece : pieces)
        for (const Point<2> &vertex : piece)
        {
          low = std::min(low, vertex[d]);
          high = std::max(high, vertex[d]);
        }
      const double first = std::floor(low / h + .5);
      body.origin[d] = h * first;
      body.n[d] = static_cast<int>(std::floor(high / h + .5) - first) + 1;
    }
    body.V.assign(body.size(), 0);
    for (const Polygon &piece : pieces)
      for_cells_in(body, piece,
                   [&](std::size_t i, const Polygon &common)
                   { body.V[i] += geometry::area(geometry::view(common)); });
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body.V[i] > h * h * (1 + 1e-10))
      {
        std::ostringstream message;
        message << "the pieces of the body overlap at (" << body.node(i)
                << "); give pieces that only touch";
        throw InputError(message.str());
      }
    add_constraint_and_material(body, fixed, material);
    return body;
  }

  algebra::Vector nodal_load(const VariationalBody &body,
                             const std::function<Tensor<1, 2>(const Point<2> &)> &b)
  {
    algebra::Vector result(2 * body.size());
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body.V[i] > 0 && body.is_fixed[i] == 0)
      {
        const Tensor<1, 2> force = b(body.node(i));
        for (unsigned int d = 0; d < 2; ++d)
          result[d * body.size() + i] = force[d] * body.V[i];
      }
    return result;
  }

  algebra::Vector cell_load(const VariationalBody &body, const std::vector<UniformLoad> &loads)
  {
    algebra::Vector result(2 * body.size());
    for (const UniformLoad &load : loads)
      for_cells_in(body, load.region,
                   [&](std::size_t i, const Polygon &common)
                   {
                     if (body.is_fixed[i] == 0)
                       for (unsigned int d = 0; d < 2; ++d)
                         result[d * body.size() + i] +=
                             load.force[d] * geometry::area(geometry::view(common));
                   });
    return result;
  }

  double distance(const Polygons &pieces, const VariationalBody &body_of_u,
                  const algebra::Vector &u, const VariationalBody &body_of_v,
                  const algebra::Vector &v)
  {
    const std::size_t n_u = body_of_u.size(), n_v = body_of_v.size();
    double sum = 0;
    for (const Polygon &piece : pieces)
      for_cells_in(body_of_u, piece,
                   [&](std::size_t i, const Polygon &part)
                   {
                     for_cells_in(body_of_v, part,
                                  [&](std::size_t j, const Polygon &common)
                                  {
                                    const double d0 = u[i] - v[j], d1 = u[n_u + i] - v[n_v + j];
                                    sum += geometry::area(geometry::view(common)) *
                                           (d0 * d0 + d1 * d1);
                                  });
                   });
    return std::sqrt(sum);
  }
} // namespace plumbline::meshfree
