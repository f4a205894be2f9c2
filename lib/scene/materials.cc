#include "base/error.h"
#include "geometry/search.h"
#include "physics/expression.h"
#include "scene/mesh.h"
#include "scene/values.h"

#include <algorithm>
#include <memory>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;

    /// The coefficient of the cell that holds a point.
    class MaterialMap
    {
    public:
      MaterialMap(const geometry::Mesh &mesh, const std::vector<double> &of_group)
          : search_(boxes(mesh))
      {
        for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        {
          polygons_.push_back(mesh.polygon(cell));
          value_.push_back(of_group[mesh.cells[cell].group]);
        }
      }

      /// In between cells by rounding: of one that is near.
      double operator()(const Point<2> &x) const
      {
        std::vector<unsigned int> found;
        for (double margin = 0; found.empty(); margin = std::max(1e-12, 10 * margin))
          search_.find(
              {Point<2>(x[0] - margin, x[1] - margin), Point<2>(x[0] + margin, x[1] + margin)},
              found);
        for (const unsigned int cell : found)
          if (geometry::contains(geometry::view(polygons_[cell]), x))
            return value_[cell];
        return value_[found[0]];
      }

    private:
      static std::vector<geometry::Box> boxes(const geometry::Mesh &mesh)
      {
        std::vector<geometry::Box> result;
        for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
          result.push_back(geometry::bounding_box(geometry::view(mesh.polygon(cell))));
        return result;
      }

      std::vector<geometry::Polygon> polygons_;
      std::vector<double> value_;
      geometry::BoxSearch search_;
    };

    /// The material of each group of the mesh.
    std::vector<double> values_of_groups(const Scene &scene, const geometry::Mesh &mesh)
    {
      std::string names;
      for (const std::string &group : mesh.groups)
        names += (names.empty() ? "" : ", ") + group;
      for (const Case &material : scene.materials)
        if (std::find(mesh.groups.begin(), mesh.groups.end(), material.name) == mesh.groups.end())
          throw InputError("Kernel/materials: the mesh has no physical surface '" + material.name +
                           "'; it has " + names);
      std::vector<double> values;
      for (const std::string &group : mesh.groups)
      {
        const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                           [&](const Case &one) { return one.name == group; });
        if (material == scene.materials.end())
          throw InputError("Kernel/materials has no value for the physical surface '" + group +
                           "' of the mesh; give one for each of " + names);
        values.push_back(to_number("Kernel/materials", material->expression));
      }
      return values;
    }
  } // namespace

  std::optional<physics::Coefficient> make_coefficient(const Scene &scene,
                                                       const geometry::Mesh &mesh)
  {
    if (scene.is_homogeneous())
      return {};
    std::optional<physics::Coefficient> coefficient;
    if (scene.materials.empty())
      coefficient.emplace(physics::Expression("Kernel/coefficient", scene.coefficient),
                          scene.symmetrisation);
    else
    {
      const auto map = std::make_shared<const MaterialMap>(mesh, values_of_groups(scene, mesh));
      coefficient.emplace([map](const Point<2> &x) { return (*map)(x); }, "Kernel/materials",
                          scene.symmetrisation);
    }
    for (const Point<2> &vertex : mesh.vertices)
      (void)coefficient->at(vertex);
    for (const Point<2> &centroid : geometry::centroids(mesh))
      (void)coefficient->at(centroid);
    return coefficient;
  }
} // namespace plumbline::scene
