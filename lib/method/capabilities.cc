#include "method/capabilities.h"

namespace plumbline::method
{
  namespace
  {
    Capability cells(const scene::Problem &problem)
    {
      if (problem.lattice)
        return Capability::lattice;
      if (problem.mesh->is_quads())
        return Capability::quadrilaterals;
      return problem.mesh->is_triangles() ? Capability::triangles : Capability::mixed_cells;
    }
  } // namespace

  Capabilities all_capabilities()
  {
    Capabilities all;
    for (std::size_t i = 0; i < base::words<Capability>.size(); ++i)
      all.insert(static_cast<Capability>(i));
    return all;
  }

  Capabilities needs(const scene::Scene &scene, const scene::Problem &problem)
  {
    Capabilities needed{cells(problem)};
    const auto add = [&](bool is_needed, Capability capability)
    {
      if (is_needed)
        needed.insert(capability);
    };
    add(scene.domain.is_free_body, Capability::free_boundary);
    add(!scene.is_homogeneous(), Capability::heterogeneous);
    add(scene.domain.is_damaged(), Capability::damage);
    add(!scene.material.has_collar_dilatation, Capability::zero_dilatation);
    add(scene.solver.is_mixed, Capability::mixed_dilatation);
    add(scene.study.regime != scene::Regime::delta &&
            scene.study.decisive_error.target != scene::Target::local,
        Capability::nonlocal);
    add(scene.time.is_dynamic(), Capability::dynamic);
    add(scene.material.is_double_well(), Capability::double_well);
    add(scene.time.is_dynamic() && scene.material.is_double_well() && !scene.domain.is_periodic,
        Capability::double_well_collar);
    add(scene.domain.is_periodic, Capability::periodic);
    return needed;
  }

  Need describe(Capability capability, const scene::Scene &scene)
  {
    const std::string mesh = "the cells of Domain/mesh = " + scene.domain.mesh.name + " are ";
    switch (capability)
    {
    case Capability::lattice:
      return {"Domain/mesh = lattice", "write Domain/mesh = squares or triangles"};
    case Capability::quadrilaterals:
      return {mesh + "quadrilaterals", ""};
    case Capability::triangles:
      return {mesh + "triangles", ""};
    case Capability::mixed_cells:
      return {mesh + "of several kinds", ""};
    case Capability::free_boundary:
      return {"Domain/boundary = free", "write Domain/boundary = constrained"};
    case Capability::heterogeneous:
      return {"the material varies in space", "write constants"};
    case Capability::damage:
      return {"Domain/cracks or Domain/outside is given", "clear both"};
    case Capability::zero_dilatation:
      return {"Material/collar dilatation = zero", "write from data"};
    case Capability::mixed_dilatation:
      return {"Solver/dilatation = kept", "write Solver/dilatation = eliminated"};
    case Capability::nonlocal:
      return {"the scene asks for a nonlocal solution",
              "write Study/regime = delta, or a decisive error against local"};
    case Capability::dynamic:
      return {"the scene moves (Time/final time > 0)", "write 0"};
    case Capability::double_well:
      return {
          "Material/model = double well: of Galerkin methods Q1 alone can, since jumps of u "
          "make e^(-beta du^2/r) a layer at r = 0 that no fixed quadrature resolves, and cracks "
          "strains of 1/h",
          "write bond-based"};
    case Capability::double_well_collar:
      return {"u is given in a collar around double wells, but nonlinear Galerkin forces are those "
              "of a torus",
              "write Domain/boundary = periodic"};
    case Capability::periodic:
      return {"Domain/boundary = periodic", "write constrained"};
    }
    return {};
  }
} // namespace plumbline::method
