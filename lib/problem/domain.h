#pragma once

#include "geometry/vertex_cells.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace plumbline::problem
{
  /// Ω is made of the cells of a lattice. Everything around it is its interaction domain.
  struct LatticeDomain
  {
    geometry::Lattice lattice;
    bool is_periodic = false;   ///< a torus: it has no interaction domain
    unsigned int dimension = 2; ///< 1: one row of cells, fields of x alone
  };

  /// Ω and its interaction domain are made of the cells of a mesh; each node has a cell of its own.
  struct MeshDomain
  {
    std::shared_ptr<const geometry::Mesh> mesh;
    std::shared_ptr<const geometry::NodeCells<2>> cells; ///< of the nodes
    double reach = 0;      ///< the interaction domain is at least so wide [length]
    std::string name = {}; ///< of the mesh, for messages
    /// How fast the mesh tends to the domain that it stands for: a polygon's sides to its curve
    /// like h², those that follow it like h⁴ (see geometry::follow_curves), cells chosen by their
    /// centres like h. 0: the domain is the polygon of the mesh.
    unsigned int boundary_order = 0;
    double mesh_seconds = 0;  ///< what making the mesh (and a body's cells) took [CPU s]
    double cells_seconds = 0; ///< what making the nodes' cells took besides [CPU s]
  };

  /// A body with a free boundary, without an interaction domain. Its nodes are those of a lattice,
  /// which `cells` number by `source`.
  struct BodyDomain : MeshDomain
  {
    geometry::NodeLattice lattice = {};
    bool is_floating = false; ///< no part of it is constrained
  };

  using Domain = std::variant<LatticeDomain, MeshDomain, BodyDomain>;

  /// A mesh with its interaction domain, and nodes with their Voronoi cells in it.
  /// @param mesh   cells with is_inside make up Ω, the others its interaction domain
  /// @param nodes  in Ω and in its interaction domain; empty: the centroids of the mesh's cells
  /// @param reach  how wide the interaction domain must be: the horizon, twice as much where the
  /// material has a dilatation [length]
  /// @throws InputError  a mesh or nodes that cannot be used (geometry::check, voronoi_cells), an
  /// interaction domain that is too narrow
  MeshDomain mesh_domain(geometry::Mesh mesh, std::vector<dealii::Point<2>> nodes, double reach);

  /// The same on squares of side h of boxes.
  MeshDomain mesh_domain(const geometry::Domain &boxes, double h,
                         std::vector<dealii::Point<2>> nodes, double reach);

  /// A box with a free boundary, of nodes at the vertices of its lattice.
  /// @param constrained  u is given at nodes whose cells share area with one of these boxes
  /// @throws InputError  as geometry::vertex_cells
  BodyDomain body_domain(const geometry::Box &box, double h,
                         const std::vector<geometry::Box> &constrained);
} // namespace plumbline::problem
