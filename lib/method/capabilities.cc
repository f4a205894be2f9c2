#include "method/capabilities.h"

namespace plumbline::method
{
  Capabilities needs(const scene::Scene &scene, const scene::Problem &problem)
  {
    Capabilities needed = scene::needs(scene);
    if (problem.mesh)
      needed.insert(problem.mesh->is_quads()       ? Capability::quadrilaterals
                    : problem.mesh->is_triangles() ? Capability::triangles
                                                   : Capability::mixed_cells);
    return needed;
  }
} // namespace plumbline::method
