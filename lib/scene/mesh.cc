#include "scene/mesh.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "geometry/local_coordinates.h"
#include "geometry/mesh_input.h"
#include "physics/expression.h"
#include "scene/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;

    std::string path(const Scene &scene, const std::string &file)
    {
      return (std::filesystem::path(scene.folder) / file).string();
    }

    /// What a mesh of the boxes takes is known before it is made.
    void check_cells(const Scene &scene, const Level &level)
    {
      constexpr double of_cell = 1000; // mesh, geometry of its cells, nodes and theirs [bytes]
      const geometry::Lattice lattice(scene.domain.boxes, level.h);
      const double collar =
          scene.domain.is_free_body ? 0 : scene.reach(level.horizon) / level.h + 1;
      const double n = (lattice.n_cells()[0] + 2 * collar) * (lattice.n_cells()[1] + 2 * collar) *
                       (scene.domain.mesh.kind() == MeshKind::triangles ? 2 : 1);
      std::ostringstream what;
      what << "Domain/mesh = " << scene.domain.mesh.name << " at h = " << level.h
           << ", horizon = " << level.horizon << " (some " << std::round(n) << " cells)";
      base::require_memory(n * of_cell, what.str(),
                           "choose a larger h or a smaller horizon (Study), or lattice where the "
                           "scene allows it");
    }

    geometry::Mesh moved(geometry::Mesh mesh, const Point<2> &origin)
    {
      geometry::move_to(origin, mesh.vertices);
      return mesh;
    }

    geometry::Mesh read_or_make(const Scene &scene, const Level &level)
    {
      const MeshSource &source = scene.domain.mesh;
      const physics::Names constants = {{"delta", level.horizon}};
      if (source.is_file())
        try
        {
          return moved(scene.domain.mesh_files->read(path(scene, source.name), level.h,
                                                     level.horizon, !scene.domain.is_free_body,
                                                     source.is_curved),
                       scene.domain.origin);
        }
        catch (const InputError &error)
        {
          throw InputError("Domain/mesh: " + std::string(error.what()));
        }
      if (source.is_of_boxes())
      {
        std::function<Point<2>(const Point<2> &)> map;
        if (!source.map.empty())
          map = [expression = physics::Expression("Domain/map", source.map, constants),
                 origin = scene.domain.origin](const Point<2> &x) {
            return geometry::local_point({expression(x, 0), expression(x, 1)}, origin);
          };
        check_cells(scene, level);
        return geometry::lattice_mesh(scene.domain.boxes, level.h,
                                      scene.domain.is_free_body ? 0 : scene.reach(level.horizon),
                                      source.kind() == MeshKind::triangles, map);
      }
      const std::string everywhere = "1";
      const physics::Expression inside(
          "Domain/inside", source.inside.empty() ? everywhere : source.inside, constants);
      return moved(geometry::generate_mesh(source.name, source.arguments, level.h,
                                           [&](const Point<2> &x) { return inside(x) > 0; }),
                   scene.domain.origin);
    }

    /// That cells and mesh sizes are lengths in the same unit.
    void check_units(const Scene &scene, const Level &level, const geometry::Mesh &mesh)
    {
      constexpr double far = 30;       // times as long
      constexpr double is_small = 1e6; // nodes: large cells may hold them
      double area = 0;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        area += geometry::area(geometry::view(mesh.polygon(c)));
      const double side = std::sqrt(area / static_cast<double>(mesh.cells.size())),
                   n_nodes = area / (level.h * level.h),
                   n_in_ball = M_PI * std::pow(level.horizon / side, 2);
      const bool is_coarse = side > far * level.h && n_nodes > is_small;
      if (!is_coarse && side * far > level.h)
        return;
      throw InputError(
          "Domain/mesh = " + scene.domain.mesh.name + ": its cells are some " +
          base::to_text(side, 3) + " long, but Study/h = " + base::to_text(level.h, 4) +
          " and the horizon = " + base::to_text(level.horizon, 4) +
          ", so that there would be some " +
          (is_coarse ? base::to_text(n_nodes, 2) + " nodes"
                     : base::to_text(n_in_ball, 2) + " cells in each ball") +
          "; are the lengths of mesh and scene in the same unit? Scale the mesh, or give Study/h "
          "and the horizon in its unit");
    }

    /// Nodes at distances h in a box, before they are made.
    void check_node_memory(const geometry::Box &box, const Level &level, const std::string &what)
    {
      constexpr double of_node = 1000; // with its cell and what methods find of it [bytes]
      const dealii::Tensor<1, 2> sides = box.upper - box.lower;
      const double n = sides[0] * sides[1] / (level.h * level.h);
      base::require_memory(n * of_node,
                           what + " at h = " + base::to_text(level.h, 4) + " (some " +
                               base::to_text(n, 2) + " nodes)",
                           "choose a larger h (Study/h)");
    }

    /// A body has no collar.
    void keep_inside(geometry::Mesh &mesh)
    {
      mesh.cells.erase(std::remove_if(mesh.cells.begin(), mesh.cells.end(),
                                      [](const geometry::MeshCell &cell)
                                      { return !cell.is_inside; }),
                       mesh.cells.end());
    }

    /// The vertex of hZ² in the scene's coordinates that is below a point, relative to it.
    Point<2> vertex_near(const Point<2> &x, double h)
    {
      return geometry::local_point({h * std::floor(x[0] / h), h * std::floor(x[1] / h)}, x);
    }

    /// Cells with their centroid in one of the boxes are fixed.
    void fix_parts(const std::vector<geometry::Box> &fixed, geometry::Mesh &mesh)
    {
      const auto centroids = geometry::centroids(mesh);
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const geometry::Box &box : fixed)
          if (box.lower[0] < centroids[c][0] && centroids[c][0] < box.upper[0] &&
              box.lower[1] < centroids[c][1] && centroids[c][1] < box.upper[1])
            mesh.cells[c].is_inside = false;
    }
  } // namespace

  geometry::Mesh make_mesh(const Scene &scene, const Level &level)
  {
    geometry::Mesh mesh = read_or_make(scene, level);
    if (scene.domain.is_free_body)
      keep_inside(mesh);
    check_units(scene, level, mesh);
    if (scene.domain.is_free_body)
      return mesh;
    const double width = geometry::collar_width(mesh);
    if (width < scene.reach(level.horizon) * (1 - 1e-9))
    {
      std::ostringstream message;
      message << "Domain/mesh = " << scene.domain.mesh.name << ": the collar is " << width
              << " wide at its thinnest place, thinner than "
              << (scene.has_dilatation() ? "twice the horizon, which the dilatation needs, "
                                         : "the horizon ")
              << scene.reach(level.horizon)
              << ", so that balls would contain points without data; widen the collar in the "
                 "mesh, or choose a smaller horizon (Study)";
      throw InputError(message.str());
    }
    return mesh;
  }

  geometry::VertexCells make_body(const Scene &scene, const Level &level)
  {
    const MeshSource &source = scene.domain.mesh;
    const bool is_on_boxes = source.is_of_boxes() && source.map.empty();
    const auto lame = scene.material.lame();
    const auto on_lattice = [&]
    {
      return geometry::vertex_cells(geometry::Lattice(scene.domain.boxes, level.h),
                                    scene.domain.fixed);
    };
    const auto on_mesh = [&]
    {
      geometry::Mesh mesh = read_or_make(scene, level);
      keep_inside(mesh);
      check_units(scene, level, mesh);
      check_node_memory(bounding_box(mesh), level, "Methods/nodes = vertices");
      fix_parts(scene.domain.fixed, mesh);
      const Point<2> origin = is_on_boxes ? geometry::Lattice(scene.domain.boxes, level.h).origin()
                                          : vertex_near(scene.domain.origin, level.h);
      return geometry::vertex_cells(std::make_shared<const geometry::Mesh>(std::move(mesh)), origin,
                                    level.h, scene.domain.fixed);
    };
    geometry::VertexCells body = source.is_lattice() ? on_lattice() : on_mesh();
    for (const Point<2> &node : body.cells->nodes)
      (void)lame(node);
    return body;
  }

  namespace
  {
    /// From the file of a level.
    std::vector<Point<2>> read_level_nodes(const Scene &scene, const Level &level,
                                           std::vector<std::size_t> *lines)
    try
    {
      return read_nodes(path(scene, scene.methods.nodes.file_at(level.h)), lines);
    }
    catch (const InputError &error)
    {
      throw InputError("Methods/nodes = " + scene.methods.nodes.name + ": " + error.what());
    }
  } // namespace

  std::vector<Point<2>> read_nodes(const std::string &file, std::vector<std::size_t> *lines)
  {
    base::Csv csv(file, {"x", "y"});
    std::vector<Point<2>> nodes;
    while (csv.next())
    {
      nodes.emplace_back(csv.number("x"), csv.number("y"));
      if (lines != nullptr)
        lines->push_back(csv.line());
    }
    return nodes;
  }

  geometry::NodeCells<2> make_node_cells(const Scene &scene, const Level &level,
                                         const geometry::Mesh &mesh)
  {
    const NodeSource &source = scene.methods.nodes;
    if (source.are_vertices())
      return geometry::vertex_squares(geometry::Lattice(scene.domain.boxes, level.h),
                                      scene.reach(level.horizon));
    if (source.kind() == NodeKind::centres)
      check_node_memory(bounding_box(mesh), level, "Methods/nodes = centres");
    const bool is_file = source.kind() == NodeKind::file;
    const std::string file = is_file ? path(scene, source.file_at(level.h)) : source.name;
    std::vector<std::size_t> lines;
    auto nodes = source.kind() == NodeKind::mesh ? centroids(mesh)
                 : is_file                       ? read_level_nodes(scene, level, &lines)
                           : lattice_nodes(mesh, level.h, source.perturbation, scene.geometry.seed);
    if (is_file)
      geometry::move_to(scene.domain.origin, nodes);
    try
    {
      return voronoi_cells(nodes, mesh);
    }
    catch (const InputError &error)
    {
      if (const auto twins = is_file ? geometry::find_coincident_nodes(nodes, mesh) : std::nullopt)
        throw InputError("node file '" + file + "', line " + std::to_string(lines[twins->second]) +
                         ": the node there " +
                         twins->place("that of line " + std::to_string(lines[twins->first])) +
                         "; take one of them out");
      throw InputError((is_file ? "node file '" + file + "', counted from 0: "
                                : "Methods/nodes = " + source.name + ": ") +
                       error.what());
    }
  }
} // namespace plumbline::scene
