#include "method/capabilities.h"

namespace plumbline::method
{
  Capabilities needs_of_cells(const problem::Problem<2> &problem)
  {
    if (!problem.mesh)
      return {};
    return {problem.mesh->is_quads()       ? Capability::quadrilaterals
            : problem.mesh->is_triangles() ? Capability::triangles
                                           : Capability::mixed_cells};
  }
} // namespace plumbline::method
