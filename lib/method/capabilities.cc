#include "method/capabilities.h"

namespace plumbline::method
{
  Capabilities needs(const scene::Case &one)
  {
    Capabilities needed = scene::needs(one.scene);
    if (const auto &mesh = one.problem.mesh)
      needed.insert(mesh->is_quads()       ? Capability::quadrilaterals
                    : mesh->is_triangles() ? Capability::triangles
                                           : Capability::mixed_cells);
    return needed;
  }
} // namespace plumbline::method
