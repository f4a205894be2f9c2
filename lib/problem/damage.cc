#include "problem/damage.h"

#include "physics/expression.h"

namespace plumbline::problem
{
  std::function<double(const dealii::Point<2> &)> outside(const Damage<2> &damage, double horizon)
  {
    if (damage.outside.empty())
      return {};
    physics::Names names = {{"delta", horizon}};
    names.origin = damage.origin;
    return physics::Expression("Domain/outside", damage.outside, names);
  }

  std::vector<char> find_ghosts(const Damage<2> &damage, double horizon,
                                const geometry::NodeCells &cells)
  {
    std::vector<char> is_ghost;
    const auto is_outside = outside(damage, horizon);
    for (const dealii::Point<2> &x : is_outside ? cells.nodes : std::vector<dealii::Point<2>>())
      is_ghost.push_back(static_cast<char>(is_outside(x) > 0));
    return is_ghost;
  }
} // namespace plumbline::problem
