#include "scene/capabilities.h"

#include "base/error.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace plumbline::scene
{
  namespace
  {
    using C = Capability;

    const Capabilities of_double_wells = {C::double_well, C::double_well_collar};

    bool includes(const Capabilities &can, const Capabilities &needed)
    {
      return std::includes(can.begin(), can.end(), needed.begin(), needed.end());
    }

    /// The settings that need a capability, and the remedy; empty: none.
    struct Need
    {
      std::string text, remedy;
    };

    Need describe(Capability capability, const Scene &scene)
    {
      const std::string mesh = "Domain/mesh = " + scene.domain.mesh.name,
                        cells = "the cells of " + mesh + " are ",
                        model = "Material/model = " + scene.material.model->name();
      switch (capability)
      {
      case C::lattice:
        return {mesh, scene.domain.is_in_space() ? "write Domain/mesh = FILE.msh or FILE.geo"
                                                 : "write Domain/mesh = squares or triangles"};
      case C::meshes:
        return {mesh, "write Domain/mesh = lattice"};
      case C::quadrilaterals:
        return {cells + (scene.domain.is_in_space() ? "hexahedra" : "quadrilaterals"), ""};
      case C::triangles:
        return {cells + (scene.domain.is_in_space() ? "tetrahedra" : "triangles"), ""};
      case C::mixed_cells:
        return {cells + "of several kinds", ""};
      case C::free_boundary:
        return {"Domain/boundary = free", "write Domain/boundary = constrained"};
      case C::floating:
        return {"Domain/fixed = none: the body is unconstrained (3 rigid-body modes in the plane) "
                "and the solution is not unique",
                "give Domain/fixed ('plumbline stability' analyses the unconstrained body)"};
      case C::heterogeneous:
        return {"the material varies in space", "write constants"};
      case C::cracks:
        return {"Domain/cracks is given", "clear it"};
      case C::free_surfaces:
        return {"Domain/outside is given", "clear it"};
      case C::damaged_dilatation:
        return {"Domain/cracks or Domain/outside changes dilatations",
                "clear both (cracks in bonds alone: Material/model = bond-based)"};
      case C::notch:
        return {"Crack/notch > 0 ('plumbline crack' simulates it)", "write 0"};
      case C::dilatation:
        return {model + " with its dilatation",
                scene.domain.is_free_body
                    ? "give constants without a dilatation term: lambda = mu, i.e. nu = 1/4 in "
                      "plane strain, or l = 4 k"
                    : "write Material/model = bond-based"};
      case C::zero_dilatation:
        return {"Material/dilatation in interaction domain = zero", "write from data"};
      case C::mixed_dilatation:
        return {"Solver/dilatation = mixed", "write Solver/dilatation = condensed"};
      case C::nonlocal:
        return {"the scene needs a nonlocal solution",
                "write Study/regime = delta, or a decisive error against local"};
      case C::dynamic:
        return {"the scene is transient (Time/final time > 0)", "write 0"};
      case C::double_well:
        return {model + ", whose force is nonlinear (among Galerkin methods only Q1, Q2 and Q3 "
                        "support it: with jumps of u, e^(-beta du^2/r) has a layer at r = 0 that "
                        "no fixed quadrature resolves, and cracks have strains of order 1/h)",
                "write bond-based"};
      case C::double_well_collar:
        return {"u is prescribed in an interaction domain, but nonlinear Galerkin forces are "
                "implemented on a torus only",
                "write Domain/boundary = periodic"};
      case C::periodic:
        return {"Domain/boundary = periodic", "write constrained"};
      case C::line:
        return {"Domain/dimension = 1, which is for static analyses of scalar kernels on intervals "
                "and for transient analyses of double-well bonds",
                "write 2"};
      case C::space:
        return {"Domain/dimension = 3, which is available for static, transient and dispersion "
                "analyses of linear materials, for quasi-static fracture and for the check of "
                "weights",
                "write 2"};
      }
      return {};
    }

    /// Rows of a table that have all needed capabilities, separated by commas.
    std::string able(const std::vector<Capable> &all, const Capabilities &needed)
    {
      std::vector<std::string> names;
      for (const Capable &one : all)
        if (includes(one.can, needed))
          names.push_back(one.name);
      return join(names, ", ");
    }
  } // namespace

  const std::vector<Capable> &analyses()
  {
    const Capabilities on_meshes_alone =
        of_meshes() | of_damage() |
        Capabilities{C::heterogeneous, C::zero_dilatation, C::mixed_dilatation};
    const Capabilities moving = {C::dynamic, C::notch, C::periodic};
    static const std::vector<Capable> all = {
        {base::word(Analysis::statics),
         all_but(moving | of_double_wells | Capabilities{C::floating})},
        {base::word(Analysis::transient), all_but({C::notch})},
        {base::word(Analysis::crack),
         of_double_wells | Capabilities{C::lattice, C::notch, C::dynamic, C::nonlocal}},
        {base::word(Analysis::growth),
         of_damage() | of_meshes() |
             Capabilities{C::lattice, C::free_boundary, C::heterogeneous, C::dilatation,
                          C::nonlocal, C::space, C::dynamic}},
        {base::word(Analysis::strip), {C::lattice, C::nonlocal}},
        {base::word(Analysis::stability), all_but({C::line})},
        {base::word(Analysis::dispersion),
         all_but(on_meshes_alone | Capabilities{C::free_boundary, C::floating, C::line})},
        {base::word(Analysis::check),
         all_but(of_damage() | Capabilities{C::line, C::free_boundary, C::floating, C::dilatation,
                                            C::zero_dilatation, C::mixed_dilatation})}};
    return all;
  }

  Capabilities needs(const Scene &scene)
  {
    const DomainSection &domain = scene.domain;
    Capabilities needed = scene.material.model->needs(scene);
    const auto add = [&](bool is_needed, Capability capability)
    {
      if (is_needed)
        needed.insert(capability);
    };
    add(domain.mesh.is_lattice() && !domain.is_free_body, C::lattice);
    add(!domain.mesh.is_lattice(), C::meshes);
    // quasi-static fracture is constrained by grips and has its own checks
    const bool is_free = domain.is_free_body && !scene.fracture.is_there();
    add(is_free, C::free_boundary);
    add(is_free && domain.is_floating, C::floating);
    add(!scene.is_homogeneous(), C::heterogeneous);
    add(!domain.cracks.empty(), C::cracks);
    add(!domain.outside.empty(), C::free_surfaces);
    add(scene.crack.is_there(), C::notch);
    add(!scene.material.has_collar_dilatation, C::zero_dilatation);
    add(scene.solver.is_mixed, C::mixed_dilatation);
    add(scene.study.regime != Regime::delta && scene.study.decisive_error.target != Target::local,
        C::nonlocal);
    add(scene.time.is_dynamic(), C::dynamic);
    add(domain.is_periodic, C::periodic);
    add(domain.dimension == 1, C::line);
    add(domain.is_in_space(), C::space);
    return needed;
  }

  std::string refusal(const Scene &scene, const Capabilities &needed, const Capabilities &can,
                      const std::string &others)
  {
    Capabilities missing;
    std::set_difference(needed.begin(), needed.end(), can.begin(), can.end(),
                        std::inserter(missing, missing.end()));
    if (missing.empty())
      return "";
    const Need need = describe(*missing.begin(), scene);
    const std::string take = others.empty() ? "" : "take " + others;
    return need.text + "; " + take + (take.empty() || need.remedy.empty() ? "" : ", or ") +
           need.remedy;
  }

  void check_model(const Scene &scene)
  {
    const Model &model = *scene.material.model;
    const Capabilities needed = needs(scene);
    const bool is_in_space = scene.domain.is_in_space();
    if (const std::string why =
            refusal(scene, needed, is_in_space ? model.can_in_space() : model.can(),
                    able(capable_models(is_in_space), needed));
        !why.empty())
      throw InputError("Material/model = " + model.name() + " does not support this scene: " + why);
  }

  void check_analysis(const Scene &scene, Analysis analysis)
  {
    const Capable &one = analyses()[static_cast<std::size_t>(analysis)];
    if (const std::string why = refusal(scene, needs(scene), one.can, ""); !why.empty())
      throw InputError(one.name + " does not support this scene: " + why);
  }
} // namespace plumbline::scene
