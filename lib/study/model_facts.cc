#include "study/model_facts.h"

#include "base/number_text.h"
#include "physics/solid_bounds.h"
#include "problem/surface_terms.h"
#include "scene/models/model.h"

#include <algorithm>
#include <optional>
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

    constexpr int n_points = 65; ///< along a side, where constants vary

    /// Of λ and μ in the boxes of Ω and in the interaction domain of the largest horizon, at the
    /// points of a grid; nothing where the material varies and Ω is no boxes.
    std::optional<physics::LameBounds> bounds_of_constants(const scene::Scene &scene)
    {
      const auto lame = scene.material.lame();
      if (scene.material.is_homogeneous)
        return physics::LameBounds{lame({}), lame({})};
      if (!scene.domain.mesh.is_of_boxes() || !scene.domain.mesh.map.empty())
        return {};
      double reach = 0;
      for (const scene::Series &series : scene.study.series)
        for (const scene::Level &level : series.levels)
          reach = std::max(reach, scene.reach(level.horizon));
      std::optional<physics::LameBounds> bounds;
      for (const geometry::Box &box : scene.domain.boxes.include)
        for (int j = 0; j < n_points; ++j)
          for (int i = 0; i < n_points; ++i)
          {
            const double s = static_cast<double>(i) / (n_points - 1),
                         t = static_cast<double>(j) / (n_points - 1);
            const physics::Lame here =
                lame({(1 - s) * (box.lower[0] - reach) + s * (box.upper[0] + reach),
                      (1 - t) * (box.lower[1] - reach) + t * (box.upper[1] + reach)});
            if (!bounds)
              bounds = {here, here};
            bounds->add(here);
          }
      return bounds;
    }

    /// Of the theorem that the linear peridynamic solid is well posed.
    /// @param is_sampled  bounds are those at points
    std::string words_of_assumption(const physics::LameBounds &bounds, bool is_sampled)
    {
      const physics::Assumption1 one = physics::assumption_1(bounds);
      const std::string numbers = "8 λ∞ = " + number(one.left) + (one.holds() ? " > " : " <= ") +
                                  "(√μ∞ + (λ∞ − λ0)/√μ0)² = " + number(one.right);
      const std::string n = std::to_string(n_points);
      return one.holds() ? (is_sampled ? "holds at " + n + " × " + n +
                                             " points of each box; not proven between them: "
                                       : "holds, so that the problem is well posed: ") +
                               numbers
                         : "does not hold, so theorem 1 does not apply (it is sufficient, not "
                           "necessary): " +
                               numbers;
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
        "model",       "dimension",         "kernel",
        "constraint",  "constants",         "local limit",
        "coefficient", "dilatation",        "varying constants",
        "potential",   "boundary function", "broken bonds"};
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
    if (model.is_state_based() && model.mean() == physics::Mean::harmonic &&
        scene.domain.dimension == 2 && !scene.domain.is_free_body && !scene.domain.is_damaged())
      if (const auto bounds = bounds_of_constants(scene))
        facts[assumption_1_fact] = words_of_assumption(*bounds, !scene.material.is_homogeneous);
    if (!scene.material.potential.is_exponential())
      facts["potential"] = scene.material.potential.text();
    if (scene.material.boundary_function == scene::BoundaryFunction::smoothstep)
      facts["boundary function"] = "t²(3 − 2t) with t = min(1, (distance to the boundary)/δ)";
    if (scene.material.boundary_function == scene::BoundaryFunction::expression)
      facts["boundary function"] = scene.material.boundary_expression + ", δ = delta";
    if (scene.domain.is_damaged())
      facts["broken bonds"] =
          std::string("bonds that cross a crack or a free surface are broken") +
          (model.is_state_based()
               ? ", and the dilatations are corrected for them; surface terms: " +
                     base::word(scene.material.surface_terms)
               : "");
  }
} // namespace plumbline::study
