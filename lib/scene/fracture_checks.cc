#include "base/error.h"
#include "physics/expression.h"
#include "scene/capabilities.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/values.h"

namespace plumbline::scene
{
  void check_fracture(const Scene &scene)
  {
    const FractureSection &fracture = scene.fracture;
    const DomainSection &domain = scene.domain;
    const std::string given = "Fracture/toughness = " + fracture.toughness;
    const auto needs = [&](bool is_good, const std::string &what)
    {
      if (!is_good)
        throw InputError(given + " needs " + what);
    };
    physics::Names names = scene.random.names();
    names.is_in_space = domain.is_in_space();
    const physics::Expression toughness("Fracture/toughness", fracture.toughness, names);
    needs(toughness.n_components() == 1, "one component");
    if (toughness.is_constant() &&
        !((domain.is_in_space() ? toughness.at({}, 0) : toughness({})) > 0))
      throw InputError(given + " must be positive: it is the fracture energy per unit area");
    needs(!scene.crack.is_there() && !scene.time.is_dynamic(),
          "Crack/notch = 0 and Time/final time = 0: 'plumbline grow' is quasi-static");
    needs(scene.material.model == &lps(),
          "Material/model = LPS (bond-based for nu = 1/4 in plane strain and in three dimensions)");
    needs(is_inverse_distance(scene.kernel),
          "Kernel/type = 1/r: the critical stretch is known for that influence function");
    needs(domain.mesh.is_lattice(), "Domain/mesh = lattice");
    needs(domain.is_free_body && !domain.is_floating && !domain.fixed.empty(),
          "Domain/boundary = free and Domain/fixed, the grips");
    needs(domain.outside.empty() && !domain.collar,
          "Domain/outside empty and Domain/interaction domain = auto");
    needs(scene.problem.solutions.empty() && scene.problem.loads.empty() &&
              scene.problem.constraint.has_value(),
          "Problem/constraint, the displacement of the grips at load 1, and neither solution nor "
          "load");
    needs(scene.methods.names.size() == 1 && scene.methods.nodes.kind() == NodeKind::centres,
          "one meshfree method (Methods/names) on centres (Methods/nodes)");
    needs(!domain.cracks.empty(), "an initial notch in Domain/cracks, from its mouth to its tip");
    needs(scene.study.series.size() == 1 && scene.study.series.front().levels.size() == 1,
          "one Study/h and one Study/m (or Study/horizon)");
    check_analysis(scene, Analysis::growth);
  }
} // namespace plumbline::scene
