#include "study/refusal.h"

#include "scene/capabilities.h"
#include "scene/mesh_in_space.h"

#include <algorithm>
#include <vector>

namespace plumbline::study
{
  namespace
  {
    using method::Capabilities;

    Capabilities capabilities_for(const Capabilities &needed, const Method &method)
    {
      using method::Capability;
      if (needed.count(Capability::space) == 0)
        return method.can();
      const Capabilities all = method.can_in_space();
      if (needed.count(Capability::quadrilaterals) == 0)
        return all;
      Capabilities on_hexahedra; // those that are of lattices in space are not
      for (const Capability one :
           {Capability::meshes, Capability::quadrilaterals, Capability::nonlocal,
            Capability::dilatation, Capability::dynamic, Capability::space})
        if (all.count(one) > 0)
          on_hexahedra.insert(one);
      return on_hexahedra;
    }

    bool can_do(const Method &method, const Capabilities &needed)
    {
      const Capabilities can = capabilities_for(needed, method);
      return std::includes(can.begin(), can.end(), needed.begin(), needed.end());
    }

    /// The first few; those of the same side, if there are any, and of these in space those on
    /// cells of the same kind.
    std::string others(const Method &method, const Capabilities &needed, const Methods &available)
    {
      constexpr std::size_t n_shown = 3;
      const auto is_on_tetrahedra = [](const Method &one)
      { return one.can().count(method::Capability::lattice) == 0; };
      const bool is_in_space = needed.count(method::Capability::space) > 0;
      std::vector<std::string> nearest, alike, all;
      for (const auto &other : available)
        if (other->is_in_all() && can_do(*other, needed))
        {
          all.push_back(other->name());
          if (other->family() != method.family())
            continue;
          alike.push_back(other->name());
          if (is_in_space && is_on_tetrahedra(*other) == is_on_tetrahedra(method))
            nearest.push_back(other->name());
        }
      const auto &names = !nearest.empty() ? nearest : !alike.empty() ? alike : all;
      std::string text;
      for (std::size_t i = 0; i < std::min(names.size(), n_shown); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
      if (names.size() > n_shown)
        text += " or another ('plumbline list methods --matrix')";
      return text;
    }
  } // namespace

  namespace
  {
    /// Of a mesh in space: hexahedra, or for methods that have none tetrahedra, which may be those
    /// in hexahedra.
    method::Capability cells_for(const Method &method, const scene::Scene &scene)
    {
      const Capabilities can = method.can_in_space();
      const bool is_on_hexahedra =
          can.count(method::Capability::triangles) == 0 &&
          can.count(method::Capability::space) > 0 &&
          !make_mesh_in_space(scene, scene.study.series.front().levels.front())->hexahedra.empty();
      return is_on_hexahedra ? method::Capability::quadrilaterals : method::Capability::triangles;
    }

    std::string refusal(const Method &method, const scene::Scene &scene, const Capabilities &needed,
                        const Methods &available)
    {
      const scene::DecisiveError &decisive = scene.study.decisive_error;
      const scene::Quantity decided = scene::quantity(decisive.norm);
      if ((decided == scene::Quantity::truncation || decided == scene::Quantity::bound) &&
          method.family() != method::MethodFamily::meshfree)
        return "Study/decisive error = " + decisive.text() +
               " is defined for meshfree rules, whose equations hold at nodes; Galerkin equations "
               "are "
               "tested with shape functions. Name meshfree rules only, or write a nodal or "
               "averages norm";
      return scene::refusal(scene, needed, capabilities_for(needed, method),
                            others(method, needed, available));
    }
  } // namespace

  std::string refusal(const Method &method, const scene::Scene &scene,
                      const problem::Problem<2> &problem, const Methods &available)
  {
    const std::string why =
        refusal(method, scene, scene::needs(scene) | problem::needs_of_cells(problem), available);
    return why.empty() ? method.why_not(problem) : why;
  }

  std::string refusal_in_space(const Method &method, const scene::Scene &scene,
                               const Methods &available)
  {
    scene::Capabilities needed = scene::needs(scene);
    const scene::MeshSource &mesh = scene.domain.mesh;
    if (mesh.is_file())
    {
      if (method.family() == method::MethodFamily::meshfree &&
          scene.methods.nodes.kind() == scene::NodeKind::centres)
        return "its nodes are lattice centres, which Domain/mesh = " + mesh.name +
               " does not have in three dimensions; write Methods/nodes = mesh (the centroids of "
               "the cells), or take P1, DGP0 or DGP1";
      needed.insert(cells_for(method, scene));
    }
    if (method.can().count(method::Capability::space) == 0)
      return "it is implemented in two dimensions only, and Domain/dimension = 3; take " +
             others(method, needed, available);
    const std::string why = refusal(method, scene, needed, available);
    return why.empty() ? method.why_not_in_space(
                             scene::make_kernel_in_space(
                                 scene, scene.study.series.front().levels.front().horizon),
                             scene.has_dilatation(), mesh.is_file())
                       : why;
  }

  bool can_solve(const Method &method, const problem::Problem<2> &problem)
  {
    return can_do(method, problem::needs(problem)) && method.why_not(problem).empty();
  }

  std::string capability_table(const Methods &methods)
  {
    std::vector<problem::Capable> all;
    for (const auto &method : methods)
      all.push_back({method->name(), method->can()});
    return problem::capability_table("methods", all);
  }
} // namespace plumbline::study
