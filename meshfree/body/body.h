#pragma once

#include "algebra/operator.h"
#include "geometry/lattice.h"
#include "geometry/vertex_cells.h"

#include <functional>

namespace plumbline::meshfree
{
  using dealii::Point;
  using dealii::Tensor;

  /// A solid on the nodes of a square lattice: each node stands for its cell's part in the solid.
  /// Fields on it are algebra::Vectors of shape (2, n[1], n[0]), zero where nothing is free.
  struct VariationalBody
  {
    double h = 0;               ///< of the lattice [length]
    Point<2> origin;            ///< node (0, 0)
    std::array<int, 2> n;       ///< nodes along each axis
    std::vector<double> V;      ///< |cell ∩ Ω|, 0 outside, shape (n[1], n[0]) [length^2]
    std::vector<char> is_fixed; ///< the cell shares area with the fixed region; same shape
    std::vector<double> k, l;   ///< bulk and shear constant [force/length^2]; same shape

    std::size_t size() const { return static_cast<std::size_t>(n[0]) * n[1]; }
    Point<2> node(std::size_t i) const; ///< i = i1 + n[0] i2
  };

  /// Constants of the solid by place, asked at nodes. A node of a cut cell may lie outside Ω, by up
  /// to h/√2.
  struct VariationalMaterial
  {
    std::function<double(const Point<2> &)> k, l;
  };

  using Polygons = std::vector<geometry::Polygon>;

  /// A solid on the vertices of lattice cells: nodes on its boundary have quarter, half or
  /// three-quarter cells.
  /// @param fixed  convex, in Ω
  /// @throws InputError  the fixed region leaves no node free
  VariationalBody body_on_vertices(const geometry::Lattice &lattice, const Polygons &fixed,
                                   const VariationalMaterial &material);

  /// A solid on the cells of lattice nodes.
  /// @param cells  of the lattice, by `source`; those beyond n_free are fixed
  VariationalBody body_of_cells(const geometry::NodeLattice &lattice,
                                const geometry::NodeCells<2> &cells,
                                const VariationalMaterial &material);

  /// A solid of any shape on the nodes hZ².
  /// @param pieces  convex, disjoint; their union is Ω (a curved boundary by its polygon)
  /// @throws InputError  h <= 0, pieces that overlap, or as above
  /// Accuracy of the areas: that of geometry::overlap.
  VariationalBody body_of_pieces(const Polygons &pieces, const Polygons &fixed,
                                 const VariationalMaterial &material, double h);

  /// The right-hand side b(x_i) V_i at free nodes. Source: Pflug, Stingl & Zetzmann 2026, eq. (20).
  algebra::Vector nodal_load(const VariationalBody &body,
                             const std::function<Tensor<1, 2>(const Point<2> &)> &b);

  /// A force per area that is uniform on a convex region in Ω.
  struct UniformLoad
  {
    geometry::Polygon region;
    Tensor<1, 2> force; ///< [force/length^2]
  };

  /// The right-hand side ∫ b over the cells of free nodes, exact.
  algebra::Vector cell_load(const VariationalBody &body, const std::vector<UniformLoad> &loads);

  /// ‖u - v‖ in L2(Ω) of two fields that are constant in the cells of their bodies, exact.
  /// @param pieces  of Ω, as above; both bodies are of this Ω
  double distance(const Polygons &pieces, const VariationalBody &body_of_u,
                  const algebra::Vector &u, const VariationalBody &body_of_v,
                  const algebra::Vector &v);
} // namespace plumbline::meshfree
