#pragma once

#include "geometry/convex_polyhedron.h"
#include "geometry/mesh.h"
#include "geometry/search.h"

#include <optional>
#include <string>
#include <type_traits>

namespace plumbline::geometry
{
  /// Nodes anywhere in Ω and its collar, each with a cell: a union of convex pieces. Nodes of Ω
  /// (free) come first, each kind in the order given.
  template <int dim>
  struct NodeCells
  {
    using Piece = std::conditional_t<dim == 2, Polygon, ConvexPolyhedron>;

    std::vector<Point<dim>> nodes;        ///< [length]
    std::size_t n_free = 0;               ///< nodes[0 ... n_free - 1] lie in Ω
    std::vector<std::size_t> source;      ///< the index each node was given with
    std::vector<double> area;             ///< of each cell, in space its volume [length^dim]
    std::vector<Point<dim>> centroid;     ///< of each cell
    std::vector<Piece> pieces;            ///< of all cells
    std::vector<std::size_t> first_piece; ///< of each cell, shape (n_nodes + 1)

    std::size_t size() const { return nodes.size(); }
    typename BoxSearch<dim>::Box bounding_box(std::size_t cell) const;
  };

  /// Two nodes that are too near each other for cells of their own.
  struct CoincidentNodes
  {
    std::size_t first = 0, second = 0; ///< indices, ascending
    double distance = 0, size = 0;     ///< between them, and of a cell

    /// "lies where NAME is", or how near to it.
    std::string place(const std::string &name) const;
  };

  /// Nodes nearer to each other than 1e-12 of a cell's size, if there are such.
  /// @param size  of a cell, in the mean [length]
  template <int dim>
  std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<dim>> &nodes,
                                                       double size);

  /// The same with cell size √(area of the mesh / number of nodes).
  std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<2>> &nodes,
                                                       const Mesh &mesh);

  /// Voronoi cells of the nodes of Ω clipped to Ω, and of the nodes of the collar clipped to the
  /// collar, so that the cells tile both: the areas add up to those of the mesh to 1e-12, where
  /// coordinates are no larger than the domain. A cell that no boundary cuts is one piece; else its
  /// pieces are its overlaps with the mesh's cells. A node on the boundary of Ω lies in Ω.
  /// @param mesh  of Ω and collar; decides which nodes are free
  /// @throws InputError  two nodes in one place (see find_coincident_nodes), a node outside Ω and
  /// collar, a coordinate that is not finite, naming the node by its index; no node in Ω, or none
  /// in a collar that has cells Cost: .3 s for 1e5 nodes.
  NodeCells<2> voronoi_cells(const std::vector<Point<2>> &nodes, const Mesh &mesh);

  /// The centroids of a mesh's cells, of whole ones where they have parts.
  std::vector<Point<2>> centroids(const Mesh &mesh);

  /// Centres of the cells, of side h, of a lattice that begins at the lower corner of Ω's bounding
  /// box, as far as they lie in a cell of the mesh, row by row; each moved by up to perturbation h
  /// in x and in y, uniformly, with a seed, the same on every machine. A node stays on its side of
  /// the boundary of Ω and in the mesh: where the move would take it out, it is halved until it
  /// does not.
  /// @throws InputError  h <= 0
  std::vector<Point<2>> lattice_nodes(const Mesh &mesh, double h, double perturbation,
                                      unsigned int seed);
} // namespace plumbline::geometry
