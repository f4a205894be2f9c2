#include "scene/origin.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/local_coordinates.h"
#include "geometry/search.h"
#include "physics/expression.h"
#include "scene/mesh_files.h"

#include <filesystem>
#include <limits>
#include <optional>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;

    std::vector<Point<2>> corners(const DomainSection &domain)
    {
      std::vector<Point<2>> result;
      for (const geometry::Box &box : domain.boxes.include)
        for (const Point<2> &corner : {box.lower, box.upper, Point<2>(box.lower[0], box.upper[1]),
                                       Point<2>(box.upper[0], box.lower[1])})
          result.push_back(corner);
      return result;
    }

    std::vector<Point<2>> mapped_corners(const Scene &scene)
    {
      const physics::Expression map("Domain/map", scene.domain.mesh.map, {{"delta", 1}});
      std::vector<Point<2>> result;
      for (const Point<2> &corner : corners(scene.domain))
        result.emplace_back(map(corner, 0), map(corner, 1));
      return result;
    }

    std::vector<Point<2>> vertices_of_file(const Scene &scene)
    {
      const MeshSource &source = scene.domain.mesh;
      if (!source.is_msh() || scene.domain.is_in_space())
        return {};
      constexpr double any = 1; // mesh size and horizon, which the file does not depend on
      return scene.domain.mesh_files
          ->read((std::filesystem::path(scene.folder) / source.name).string(), any, any,
                 !scene.domain.is_free_body, source.is_curved)
          .vertices;
    }

    std::vector<Point<2>> vertices_of_generator(const MeshSource &source)
    {
      return geometry::generate_mesh(source.name, source.arguments,
                                     std::numeric_limits<double>::max(),
                                     [](const Point<2> &) { return true; })
          .vertices;
    }

    /// Some places that tell where the domain is; none where the scene's keys do not tell: what is
    /// wrong with them is said where they are used.
    std::vector<Point<2>> places(const Scene &scene)
    try
    {
      const MeshSource &mesh = scene.domain.mesh;
      if (mesh.is_of_boxes())
        return mesh.map.empty() ? corners(scene.domain) : mapped_corners(scene);
      return mesh.is_file() ? vertices_of_file(scene) : vertices_of_generator(mesh);
    }
    catch (const InputError &)
    {
      return {};
    }
  } // namespace

  std::string with_origin(const std::string &message, const Point<2> &origin)
  {
    constexpr int digits = 15;
    if (origin == Point<2>() || message.find("(x, y) = (") != std::string::npos)
      return message;
    return message + " (coordinates count from (" + base::to_text(origin[0], digits) + ", " +
           base::to_text(origin[1], digits) + "))";
  }

  void move_to_domain(Scene &scene)
  {
    DomainSection &domain = scene.domain;
    const std::vector<Point<2>> known = places(scene);
    const Point<2> origin =
        known.empty() ? Point<2>()
                      : geometry::local_origin(geometry::bounding_box(
                            geometry::ArrayView<const Point<2>>(known.data(), known.size())));
    domain.origin = scene.random.origin = origin;
    if (domain.mesh.map.empty())
    {
      geometry::move_to(origin, domain.boxes.include);
      geometry::move_to(origin, domain.boxes.exclude);
    }
    geometry::move_to(origin, domain.fixed);
    for (auto &crack : domain.cracks)
      geometry::move_to(origin, crack);
    geometry::move_to(origin, scene.fracture.unbreaking);
    for (auto &line : scene.fracture.interfaces)
      geometry::move_to(origin, line);
    geometry::move_to(origin, scene.random.box);
  }
} // namespace plumbline::scene
