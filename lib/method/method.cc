#include "method/method.h"

namespace plumbline::method
{
  geometry::NodeSet comparison_nodes(const scene::Scene &scene, const geometry::Lattice &lattice,
                                     unsigned int n_components)
  {
    const geometry::AxisSpecies nodes = scene.methods.nodes.are_vertices()
                                            ? geometry::AxisSpecies{0, true, 0}
                                            : geometry::AxisSpecies{.5, false, 0};
    return free_nodes(lattice, {nodes}, n_components);
  }
} // namespace plumbline::method
