#include "method/method.h"

#include "base/error.h"

namespace plumbline::method
{
  StripState Method::solve_strip(const RiceStrip &, const physics::Kernel<2> &) const
  {
    throw InputError("Methods/names: " + name() + " solves no strip with a crack (Strip/length)");
  }

  geometry::NodeSet comparison_nodes(const problem::Problem<2> &problem, unsigned int n_components)
  {
    const geometry::AxisSpecies nodes = problem.settings.nodes_are_vertices
                                            ? geometry::AxisSpecies{0, true, 0}
                                            : geometry::AxisSpecies{.5, false, 0};
    return free_nodes(*problem.lattice, {nodes}, n_components);
  }
} // namespace plumbline::method
