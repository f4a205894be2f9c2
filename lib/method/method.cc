#include "method/method.h"

#include "method/discretisation_in_space.h"
#include "method/equation_of_motion.h"

namespace plumbline::method
{
  std::unique_ptr<ContinuousMotion> Method::continuous_motion(const physics::DoubleWell &,
                                                              const geometry::Box &, unsigned int,
                                                              unsigned int) const
  {
    return nullptr;
  }

  std::unique_ptr<DiscretisationInSpace>
  Method::discretise_in_space(const problem::Problem<3> &) const
  {
    return nullptr;
  }

  geometry::NodeSet comparison_nodes(const problem::Problem<2> &problem, unsigned int n_components)
  {
    const geometry::AxisSpecies nodes = problem.settings.nodes_are_vertices
                                            ? geometry::AxisSpecies{0, true, 0}
                                            : geometry::AxisSpecies{.5, false, 0};
    return free_nodes(*problem.lattice(), {nodes}, n_components);
  }
} // namespace plumbline::method
