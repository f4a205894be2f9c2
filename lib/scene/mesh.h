#pragma once

#include "geometry/node_cells.h"
#include "geometry/vertex_cells.h"
#include "scene/scene.h"

namespace plumbline::scene
{
  /// The mesh of a scene at a level, checked; its collar holds the ball. Of a body with a free
  /// boundary, its cells alone.
  /// @throws InputError  a mesh that cannot be used, or a collar thinner than the horizon
  geometry::Mesh make_mesh(const Scene &scene, const Level &level);

  /// A body with a free boundary at a level: nodes on the vertices of the boxes' lattice, on hZ²
  /// where a map, a file or a generator says what the body is. On one box with Domain/mesh =
  /// lattice the mesh is that of the nodes' cells, else the scene's, whose cells are fixed where
  /// their centroid is.
  /// @throws InputError  a mesh that cannot be used, constants of no solid at a node, and as
  /// geometry::vertex_cells
  geometry::VertexCells make_body(const Scene &scene, const Level &level);

  /// The scene's coefficient, by expression or by materials; nothing if it is homogeneous.
  /// @throws InputError  a group of the mesh without a material or a material without a group, a
  /// coefficient that is not a positive number at a vertex or centroid; later, where materials are
  /// asked for outside of the mesh
  std::optional<physics::Coefficient> make_coefficient(const Scene &scene,
                                                       const geometry::Mesh &mesh);

  /// Nodes from a CSV file with the columns x and y [length], others ignored.
  /// @param lines  if given: where each node stands in the file
  /// @throws InputError  as `Csv`
  std::vector<dealii::Point<2>> read_nodes(const std::string &file,
                                           std::vector<std::size_t> *lines = nullptr);

  /// The nodes of a scene at a level and their cells.
  /// @throws InputError  nodes that cannot be used
  geometry::NodeCells<2> make_node_cells(const Scene &scene, const Level &level,
                                         const geometry::Mesh &mesh);
} // namespace plumbline::scene
