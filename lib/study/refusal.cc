#include "study/refusal.h"

#include "scene/capabilities.h"

#include <algorithm>
#include <vector>

namespace plumbline::study
{
  namespace
  {
    using method::Capabilities;

    Capabilities capabilities_for(const Capabilities &needed, const Method &method)
    {
      return needed.count(method::Capability::space) > 0 ? method.can_in_space() : method.can();
    }

    bool can_do(const Method &method, const Capabilities &needed)
    {
      const Capabilities can = capabilities_for(needed, method);
      return std::includes(can.begin(), can.end(), needed.begin(), needed.end());
    }

    /// The first few; those of the same side, if there are any.
    std::string others(const Method &method, const Capabilities &needed, const Methods &available)
    {
      constexpr std::size_t n_shown = 3;
      std::vector<std::string> alike, all;
      for (const auto &other : available)
        if (other->is_in_all() && can_do(*other, needed))
        {
          all.push_back(other->name());
          if (other->family() == method.family())
            alike.push_back(other->name());
        }
      const auto &names = alike.empty() ? all : alike;
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
    std::string refusal(const Method &method, const scene::Scene &scene, const Capabilities &needed,
                        const Methods &available)
    {
      const scene::DecisiveError &decisive = scene.study.decisive_error;
      if (scene::quantity(decisive.norm) == scene::Quantity::truncation &&
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
    const std::string why = refusal(method, scene, scene::needs(scene), available);
    return why.empty() ? method.why_not_in_space(scene::make_kernel_in_space(
                             scene, scene.study.series.front().levels.front().horizon))
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
