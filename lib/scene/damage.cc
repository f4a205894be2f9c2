#include "scene/damage.h"

#include "base/error.h"
#include "geometry/cracks.h"

namespace plumbline::scene
{
  problem::Damage<2> make_damage(const Scene &scene, double horizon)
  {
    problem::Damage<2> damage;
    damage.cracks = scene.domain.cracks;
    if (scene.material.surface_terms != SurfaceTerms::automatic)
      damage.surface_terms = scene.material.surface_terms;
    if (scene.domain.outside.empty())
      return damage;
    physics::Names names = {{"delta", horizon}};
    names.origin = scene.domain.origin;
    damage.outside = physics::Expression("Domain/outside", scene.domain.outside, names);
    return damage;
  }

  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells<2> &cells)
  {
    const problem::Damage<2> damage = make_damage(scene, horizon);
    const auto is_ghost = problem::find_ghosts(damage, cells);
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
