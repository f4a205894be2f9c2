#include "problem/damage.h"

namespace plumbline::problem
{
  std::vector<char> find_ghosts(const Damage<2> &damage, const geometry::NodeCells<2> &cells)
  {
    std::vector<char> is_ghost;
    const auto outside = damage.outside; // one thread's own
    for (const dealii::Point<2> &x : outside ? cells.nodes : std::vector<dealii::Point<2>>())
      is_ghost.push_back(static_cast<char>(outside(x) > 0));
    return is_ghost;
  }
} // namespace plumbline::problem
