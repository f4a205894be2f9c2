#include "base/error.h"
#include "geometry/cell_locator.h"
#include "physics/expression.h"
#include "scene/mesh.h"
#include "scene/mesh_in_space.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;

    /// The material of each group of a mesh, physical surfaces or volumes.
    std::vector<double> values_of_groups(const Scene &scene, const std::vector<std::string> &groups)
    {
      const std::string names = join(groups, ", "),
                        kind = scene.domain.is_in_space() ? "volume" : "surface";
      for (const GroupCoefficient &material : scene.kernel.materials)
      {
        if (std::find(groups.begin(), groups.end(), material.group) == groups.end())
          throw InputError("Kernel/materials: the mesh has no physical " + kind + " '" +
                           material.group + "'; it has " + names);
        require(material.value > 0 && std::isfinite(material.value),
                "Kernel/materials: the coefficient of '" + material.group + "' is " +
                    short_number(material.value) + "; it must be a positive number");
      }
      std::vector<double> values;
      for (const std::string &group : groups)
      {
        const auto material =
            std::find_if(scene.kernel.materials.begin(), scene.kernel.materials.end(),
                         [&](const GroupCoefficient &one) { return one.group == group; });
        if (material == scene.kernel.materials.end())
          throw InputError("Kernel/materials has no value for the physical " + kind + " '" + group +
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
      const std::vector<double> of_group = values_of_groups(scene, mesh.groups);
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

  std::optional<problem::GroupFactors> make_factors(const Scene &scene,
                                                    const geometry::TetrahedralMesh &mesh)
  {
    if (scene.kernel.materials.empty())
      return {};
    return problem::GroupFactors{values_of_groups(scene, mesh.groups), scene.kernel.symmetrisation};
  }
} // namespace plumbline::scene
