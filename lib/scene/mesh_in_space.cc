#include "scene/mesh_in_space.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/tetrahedral_check.h"
#include "scene/mesh_files.h"

#include <cmath>
#include <filesystem>

namespace plumbline::scene
{
  namespace
  {
    /// That cells and mesh sizes are lengths in the same unit.
    void check_units(const Scene &scene, const Level &level, const geometry::TetrahedralMesh &mesh)
    {
      constexpr double far = 30;         // times as long
      constexpr double cells_a_cube = 6; // about as many tetrahedra as edges long
      double volume = 0;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        volume += geometry::determinant(mesh, cell) / 6;
      const double side = std::cbrt(cells_a_cube * volume / static_cast<double>(mesh.cells.size()));
      if (side < far * level.h && side * far > level.h)
        return;
      throw InputError("Domain/mesh = " + scene.domain.mesh.name +
                       ": edges of its cells are about " + base::to_text(side, 3) +
                       " long, but Study/h = " + base::to_text(level.h, 4) +
                       " and the horizon = " + base::to_text(level.horizon, 4) +
                       "; are the lengths of mesh and scene in the same unit? Scale the mesh, or "
                       "give Study/h and the horizon in its unit");
    }
  } // namespace

  std::shared_ptr<const geometry::TetrahedralMesh> make_mesh_in_space(const Scene &scene,
                                                                      const Level &level)
  {
    const std::string &name = scene.domain.mesh.name;
    const auto saying = [](const std::string &what, const auto &action)
    {
      try
      {
        return action();
      }
      catch (const InputError &error)
      {
        throw InputError(what + ": " + error.what());
      }
    };
    const auto mesh =
        saying("Domain/mesh",
               [&]
               {
                 return scene.domain.mesh_files->read_in_space(
                     (std::filesystem::path(scene.folder) / name).string(), level.h, level.horizon);
               });
    check_units(scene, level, *mesh);
    if (!scene.domain.is_free_body)
      saying("Domain/mesh = " + name,
             [&] { geometry::check_collar(*mesh, scene.reach(level.horizon)); });
    return mesh;
  }
} // namespace plumbline::scene
