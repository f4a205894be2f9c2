#include "base/error.h"
#include "geometry/cell_locator.h"
#include "physics/expression.h"
#include "scene/mesh.h"
#include "scene/models/model.h"

#include <algorithm>
#include <memory>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;

    /// The material of each group of the mesh.
    std::vector<double> values_of_groups(const Scene &scene, const geometry::Mesh &mesh)
    {
      std::string names;
      for (const std::string &group : mesh.groups)
        names += (names.empty() ? "" : ", ") + group;
      for (const GroupCoefficient &material : scene.kernel.materials)
        if (std::find(mesh.groups.begin(), mesh.groups.end(), material.group) == mesh.groups.end())
          throw InputError("Kernel/materials: the mesh has no physical surface '" + material.group +
                           "'; it has " + names);
      std::vector<double> values;
      for (const std::string &group : mesh.groups)
      {
        const auto material =
            std::find_if(scene.kernel.materials.begin(), scene.kernel.materials.end(),
                         [&](const GroupCoefficient &one) { return one.group == group; });
        if (material == scene.kernel.materials.end())
          throw InputError("Kernel/materials has no value for the physical surface '" + group +
                           "' of the mesh; give one for each of " + names);
        values.push_back(material->value);
      }
      return values;
    }
  } // namespace

  std::optional<physics::Coefficient> make_coefficient(const Scene &scene,
                                                       const geometry::Mesh &mesh)
  {
    if (scene.is_homogeneous() && !scene.domain.is_free_body)
      return {};
    std::optional<physics::Coefficient> coefficient;
    if (scene.material.model->is_state_based())
      coefficient.emplace([lame = scene.material.lame()](const Point<2> &x) { return lame(x).mu; },
                          "Material/" + scene.material.keys[1], scene.material.model->mean());
    else if (scene.kernel.materials.empty())
      coefficient.emplace(
          physics::Expression("Kernel/coefficient", scene.kernel.coefficient, scene.random.names()),
          scene.kernel.symmetrisation);
    else
    {
      std::vector<double> values;
      const std::vector<double> of_group = values_of_groups(scene, mesh);
      for (const geometry::MeshCell &cell : mesh.cells)
        values.push_back(of_group[cell.group]);
      coefficient.emplace([values, cells = std::make_shared<const geometry::CellLocator>(mesh)](
                              const Point<2> &x) { return values[cells->at(x)]; },
                          "Kernel/materials", scene.kernel.symmetrisation);
    }
    for (const Point<2> &vertex : mesh.vertices)
      (void)coefficient->at(vertex);
    for (const Point<2> &centroid : geometry::centroids(mesh))
      (void)coefficient->at(centroid);
    return coefficient;
  }
} // namespace plumbline::scene
