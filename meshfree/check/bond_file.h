#pragma once

#include "geometry/node_cells.h"
#include "geometry/periodic_box.h"
#include "meshfree/rules/quadrature_rule.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace plumbline::meshfree
{
  /// Nodes of another code, in the order of their file.
  template <int dim>
  struct GivenNodes
  {
    std::string file;
    std::vector<std::int64_t> id;
    std::vector<Point<dim>> places;      ///< relative to `origin` [length]
    std::vector<double> volume;          ///< [length^dim]
    std::vector<std::size_t> line;       ///< in the file, for messages
    double rounding = 0;                 ///< of the places, by their digits [length]
    double volume_rounding = 0;          ///< of the volumes, relative
    std::vector<std::string> notes = {}; ///< how the file was read, where it is not plain CSV
    Point<dim> origin = {};              ///< in the file's coordinates
    std::optional<geometry::PeriodicBox<dim>> box = {}; ///< that they lie in, where it is periodic
    /// In a periodic box, whose images follow the nodes: which node each of them is; else empty.
    std::vector<std::size_t> original = {};
    std::size_t n_images = 0;

    std::size_t size() const { return id.size(); }
  };

  /// Nodes from a CSV file with the columns id (an integer), x, y, in space z, and volume, others
  /// ignored; or from a text file of Peridigm, "# x y z block_id volume", where the ids are the
  /// numbers of the rows, from 1. In the plane a column z must be constant.
  /// @throws InputError  file not readable, missing columns, not a number, volume <= 0, an id given
  /// twice, two nodes in one place; naming file, line and value
  template <int dim>
  GivenNodes<dim> read_given_nodes(const std::string &file);

  /// Which of the nodes lie in Ω.
  /// @throws InputError  none does
  std::vector<std::size_t> nodes_inside(const GivenNodes<2> &nodes, const geometry::Mesh &mesh);

  /// The spacing of the nodes in Ω: √ of the area of Ω over their number, nodes on its boundary
  /// counted half. It does not depend on the volumes that are given.
  /// @throws InputError  no node lies in Ω
  double node_spacing(const GivenNodes<2> &nodes, const geometry::Mesh &mesh);

  /// @param level  which the mesh is of, for the message
  /// @throws InputError  a node outside of Ω and its collar
  void check_places(const GivenNodes<2> &nodes, const geometry::Mesh &mesh,
                    const std::string &level);

  /// The Voronoi cells of given nodes.
  template <int dim>
  struct GivenCells
  {
    geometry::NodeCells<dim> cells;
    std::vector<double> uncut_areas; ///< numbered as the cells; not cut at the boundary of Ω
    std::size_t n_on_boundary = 0;   ///< nodes on the boundary of Ω
  };

  /// @param boundary_is_data  nodes on the boundary of Ω belong to the collar and no cell is cut
  /// there, as with Methods/nodes = vertices; else they are free, and cells are cut. In a periodic
  /// box all nodes but the images are free, and no cell is cut.
  /// @throws InputError  as geometry::voronoi_cells; all nodes of Ω lie on its boundary
  GivenCells<2> given_cells(const GivenNodes<2> &nodes, const geometry::Mesh &mesh,
                            bool boundary_is_data);

  /// The same cells in another order.
  /// @param n_free  how many of them lie in Ω then
  template <int dim>
  geometry::NodeCells<dim> reordered(const geometry::NodeCells<dim> &cells,
                                     const std::vector<std::size_t> &order, std::size_t n_free);

  /// A bond of a node in the collar, whose family has no part in the operator.
  template <int dim>
  struct CollarBond
  {
    std::size_t node = 0, neighbour = 0; ///< numbered as the cells
    Bond<dim> bond;
    std::size_t line = 0; ///< in the file
  };

  /// Families of another code.
  template <int dim>
  struct GivenFamilies
  {
    std::vector<Family<dim>> families; ///< of the free nodes; the area of a bond is the neighbour's
                                       ///< volume
    std::size_t n_ignored = 0;         ///< bonds of nodes in the collar
    std::vector<std::vector<std::size_t>> lines = {}; ///< of the bonds in the file
    std::vector<CollarBond<dim>> of_collar = {};      ///< those that are ignored
    std::string unit = "line";                        ///< what `lines` count, for messages
    bool is_half_list = false;  ///< every pair stands once: some nodes may have no bonds
    double weight_rounding = 0; ///< of the weights by their digits, relative to most of them
    std::vector<std::string> notes = {}; ///< as of GivenNodes
  };

  /// Bonds from a CSV file with the columns i and j (ids), weight [length^dim] and, if they
  /// are there, qx, qy and in space qz [length]: where the kernel is evaluated, relative to node i.
  /// If a row leaves them empty, or the file has no such columns, it is evaluated at node j.
  /// @param cells  of the nodes, where source is the index into them
  /// @throws InputError  file not readable, missing columns, not a finite number, unknown ids, a
  /// bond of a node with itself or given twice, a kernel point at 0, a free node without bonds (but
  /// in half lists); ids that are off those of the nodes by one are told as such
  template <int dim>
  GivenFamilies<dim> read_given_families(const std::string &file, const GivenNodes<dim> &nodes,
                                         const geometry::NodeCells<dim> &cells);
} // namespace plumbline::meshfree
