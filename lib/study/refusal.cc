#include "study/refusal.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace plumbline::study
{
  namespace
  {
    using method::Capabilities;
    using method::Capability;

    bool can_do(const Method &method, const Capabilities &needed)
    {
      const Capabilities can = method.can();
      return std::includes(can.begin(), can.end(), needed.begin(), needed.end());
    }

    /// The first few; those of the same family, if there are any.
    std::string others(const Method &method, const Capabilities &needed, const Methods &available)
    {
      constexpr std::size_t n_shown = 3;
      std::vector<std::string> alike, all;
      for (const auto &other : available)
        if (other->is_in_all() && can_do(*other, needed))
        {
          all.push_back(other->name());
          if (other->side() == method.side())
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

  std::string refusal(const Method &method, const scene::Scene &scene,
                      const scene::Problem &problem, const Methods &available)
  {
    const Capabilities needed = method::needs(scene, problem), can = method.can();
    for (const Capability capability : needed)
      if (can.count(capability) == 0)
      {
        const method::Need need = method::describe(capability, scene);
        const std::string names = others(method, needed, available);
        const std::string take = names.empty() ? "" : "take " + names;
        return need.text + "; " + take + (take.empty() || need.remedy.empty() ? "" : ", or ") +
               need.remedy;
      }
    return method.why_not(problem);
  }

  std::string capability_table(const Methods &methods)
  {
    std::vector<std::pair<Capabilities, std::string>> rows;
    for (const auto &method : methods)
    {
      const auto row =
          std::find_if(rows.begin(), rows.end(),
                       [can = method->can()](const auto &one) { return one.first == can; });
      if (row == rows.end())
        rows.emplace_back(method->can(), method->name());
      else
        row->second += ", " + method->name();
    }
    const Capabilities all = method::all_capabilities();
    std::string head = "| methods |", rule = "|---|", text;
    for (const Capability capability : all)
    {
      head += " " + base::word(capability) + " |";
      rule += "---|";
    }
    for (const auto &[can, names] : rows)
    {
      text += "| " + names + " |";
      for (const Capability capability : all)
        text += can.count(capability) > 0 ? " yes |" : " - |";
      text += "\n";
    }
    return head + "\n" + rule + "\n" + text;
  }
} // namespace plumbline::study
