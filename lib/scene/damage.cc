#include "scene/damage.h"

#include "base/error.h"
#include "geometry/cracks.h"
#include "physics/expression.h"

namespace plumbline::scene
{
  std::function<double(const dealii::Point<2> &)> outside(const Damage &damage, double horizon)
  {
    if (damage.outside.empty())
      return {};
    physics::Names names = {{"delta", horizon}};
    names.origin = damage.origin;
    return physics::Expression("Domain/outside", damage.outside, names);
  }

  std::vector<char> find_ghosts(const Damage &damage, double horizon,
                                const geometry::NodeCells &cells)
  {
    std::vector<char> is_ghost;
    const auto is_outside = outside(damage, horizon);
    for (const dealii::Point<2> &x : is_outside ? cells.nodes : std::vector<dealii::Point<2>>())
      is_ghost.push_back(static_cast<char>(is_outside(x) > 0));
    return is_ghost;
  }

  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells &cells)
  {
    const Damage damage{scene.domain.cracks, scene.domain.outside, SurfaceTerms::published,
                        scene.domain.origin};
    const auto is_ghost = find_ghosts(damage, horizon, cells);
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
