#include "scene/mesh.h"

#include "base/error.h"
#include "geometry/mesh_input.h"
#include "physics/expression.h"

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

    geometry::Mesh read_or_make(const Scene &scene, const Level &level)
    {
      const MeshSource &source = scene.mesh;
      const std::map<std::string, double> constants = {{"delta", level.horizon}};
      if (source.is_file())
        return geometry::read_mesh(path(scene, source.kind), level.h, level.horizon);
      if (source.is_of_boxes())
      {
        std::function<Point<2>(const Point<2> &)> map;
        if (!source.map.empty())
          map = [expression = physics::Expression("Domain/map", source.map, constants)](
                    const Point<2> &x) { return Point<2>(expression(x, 0), expression(x, 1)); };
        return geometry::lattice_mesh(scene.domain, level.h, level.horizon,
                                      source.kind == "triangles", map);
      }
      const physics::Expression inside("Domain/inside", source.inside, constants);
      return geometry::generate_mesh(source.kind, source.arguments, level.h,
                                     [&](const Point<2> &x) { return inside(x) > 0; });
    }
  } // namespace

  geometry::Mesh make_mesh(const Scene &scene, const Level &level)
  {
    geometry::Mesh mesh = read_or_make(scene, level);
    const double width = geometry::collar_width(mesh);
    if (width < level.horizon * (1 - 1e-9))
    {
      std::ostringstream message;
      message << "Domain/mesh = " << scene.mesh.kind << ": the collar is " << width
              << " wide at its thinnest place, thinner than the horizon " << level.horizon
              << ", so balls would reach points without data; widen the collar in the mesh, or "
                 "choose a smaller horizon (Study)";
      throw InputError(message.str());
    }
    return mesh;
  }

  geometry::NodeCells make_node_cells(const Scene &scene, const Level &level,
                                      const geometry::Mesh &mesh)
  {
    const NodeSource &source = scene.nodes;
    const bool is_file = source.kind != "mesh" && source.kind != "centres";
    const auto nodes = source.kind == "mesh" ? centroids(mesh)
                       : is_file             ? geometry::read_nodes(path(scene, source.kind))
                                 : lattice_nodes(mesh, level.h, source.perturbation, scene.seed);
    try
    {
      return voronoi_cells(nodes, mesh);
    }
    catch (const InputError &error)
    {
      throw InputError((is_file ? "node file '" + path(scene, source.kind) + "', counted from 0: "
                                : "Methods/nodes = " + source.kind + ": ") +
                       error.what());
    }
  }
} // namespace plumbline::scene
