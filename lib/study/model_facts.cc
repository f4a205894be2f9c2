#include "study/model_facts.h"

#include "base/number_text.h"
#include "problem/surface_terms.h"
#include "scene/models/model.h"

#include <set>

namespace plumbline::study
{
  namespace
  {
    std::string number(double value)
    {
      return base::to_text(value, 6);
    }

    /// As the scene gives them.
    std::string constants(const scene::Scene &scene)
    {
      const scene::MaterialSection &material = scene.material;
      const auto &[E, nu] = material.given[0];
      if (!E.empty())
        return "E = " + E + (nu.empty() ? "" : ", nu = " + nu) +
               (material.toughness ? ", toughness = " + number(*material.toughness) : "") +
               (scene.domain.dimension != 2                     ? ""
                : material.plane == physics::PlaneState::stress ? ", plane stress"
                                                                : ", plane strain");
      if (material.model->is_state_based())
        return material.keys[0] + " = " + material.expressions[0] + ", " + material.keys[1] +
               " = " + material.expressions[1];
      if (!material.model->is_linear())
        return "c = " + number(material.c) + ", beta = " + number(material.beta);
      if (scene.kernel.limit == scene::Limit::navier)
        return "bulk modulus = " + number(scene.kernel.bulk_modulus);
      return scene.kernel.limit == scene::Limit::none ? "c = " + number(scene.kernel.constant) : "";
    }

    std::string constraint(const scene::DomainSection &domain)
    {
      if (domain.is_periodic)
        return "on a torus";
      if (!domain.is_free_body)
        return "u = g in the interaction domain";
      return std::string(domain.is_floating ? "unconstrained (rigid-body modes)"
                                            : "u = g in the constrained parts") +
             "; families are truncated at the free boundary";
    }
  } // namespace

  bool is_of_equation(const std::string &fact)
  {
    static const std::set<std::string> all = {
        "model",       "dimension",   "kernel",     "constraint",        "constants",
        "local limit", "coefficient", "dilatation", "varying constants", "boundary function",
        "broken bonds"};
    return all.count(fact) > 0;
  }

  void add_model_facts(const scene::Scene &scene, std::map<std::string, std::string> &facts)
  {
    const scene::Model &model = *scene.material.model;
    const scene::KernelSection &kernel = scene.kernel;
    facts["model"] = model.name();
    facts["dimension"] = std::to_string(scene.domain.dimension);
    facts["kernel"] = kernel.type;
    facts["constraint"] = constraint(scene.domain);
    if (const std::string given = constants(scene); !given.empty())
      facts["constants"] = given;
    if (!model.takes_influence() && kernel.limit != scene::Limit::none)
      facts["local limit"] = base::word(kernel.limit);
    if (!kernel.coefficient.empty() || !kernel.materials.empty())
      facts["coefficient"] = kernel.symmetrisation == physics::Mean::harmonic
                                 ? "harmonic mean of the coefficient at the two ends of the bond"
                                 : "arithmetic mean of the coefficient at the two ends of the bond";
    if (model.is_state_based() && !scene.has_dilatation())
      facts["dilatation"] = "none, as lambda = mu";
    if (model.is_state_based() && !scene.material.is_homogeneous)
      facts["varying constants"] = model.mean() == physics::Mean::harmonic
                                       ? "λ and μ are harmonic means over the two ends of a bond"
                                       : "μ is the arithmetic mean over the two ends of a bond; f "
                                         "is evaluated at the same point as θ";
    if (scene.material.boundary_function == scene::BoundaryFunction::smoothstep)
      facts["boundary function"] = "t²(3 − 2t) with t = min(1, (distance to the boundary)/δ)";
    if (scene.domain.is_damaged())
      facts["broken bonds"] =
          std::string("bonds that cross a crack or a free surface are broken") +
          (model.is_state_based()
               ? ", and the dilatations are corrected for them; surface terms: " +
                     base::word(scene.material.surface_terms)
               : "");
  }
} // namespace plumbline::study
