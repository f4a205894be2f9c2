#include "problem/needs.h"

namespace plumbline::problem
{
  Capabilities needs_of_cells(const Problem<2> &problem)
  {
    if (!problem.mesh())
      return {};
    return {problem.mesh()->is_quads()       ? Capability::quadrilaterals
            : problem.mesh()->is_triangles() ? Capability::triangles
                                             : Capability::mixed_cells};
  }

  Capabilities needs(const Problem<2> &problem)
  {
    using C = Capability;
    Capabilities needed = needs_of_cells(problem);
    const auto add = [&](bool is_needed, Capability capability)
    {
      if (is_needed)
        needed.insert(capability);
    };
    const bool is_body = problem.body() != nullptr, has_dilatation = problem.dilatation.has_value();
    add(problem.lattice() != nullptr, C::lattice);
    add(problem.mesh() && !is_body, C::meshes); // nodes of a body are those of a lattice
    add(is_body, C::free_boundary);
    add(problem.is_floating(), C::floating);
    add(!problem.is_homogeneous, C::heterogeneous);
    add(!problem.damage.cracks.empty(), C::cracks);
    add(static_cast<bool>(problem.damage.outside), C::free_surfaces);
    add(has_dilatation, C::dilatation);
    add(has_dilatation && problem.damage.is_there(), C::damaged_dilatation);
    add(!problem.has_collar_dilatation, C::zero_dilatation);
    add(problem.settings.solver.is_mixed, C::mixed_dilatation);
    add(problem.double_well.has_value(), C::double_well);
    add(problem.is_periodic(), C::periodic);
    add(problem.dimension() == 1, C::line);
    return needed;
  }
} // namespace plumbline::problem
