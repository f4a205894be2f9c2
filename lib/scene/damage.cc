#include "scene/damage.h"

#include "base/error.h"
#include "geometry/cracks.h"

namespace plumbline::scene
{
  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells &cells)
  {
    const problem::Damage<2> damage{scene.domain.cracks, scene.domain.outside, SurfaceTerms::published,
                        scene.domain.origin};
    const auto is_ghost = problem::find_ghosts(damage, horizon, cells);
    std::string key = "Domain/outside";
    try
    {
      geometry::check_ghosts(is_ghost, cells);
      key = "Domain/cracks";
      geometry::check_cracks(damage.cracks, cells, is_ghost, horizon);
    }
    catch (const InputError &error)
    {
      throw InputError(key + ": " + error.what());
    }
  }
} // namespace plumbline::scene
