#include "meshfree/check/bond_ramp.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// Adds what differs from one family to the other; largest is of |w C|.
    template <int dim>
    void compare(const Family<dim> &mine, const Family<dim> &ramped, const Kernel<dim> &kernel,
                 RampEffect &effect, double &largest)
    {
      const auto entry = [&](const Bond<dim> &bond)
      { return bond.weight * radial_value(kernel, bond); };
      for_both(mine, ramped,
               [&](const Bond<dim> *one, const Bond<dim> *other, std::size_t)
               {
                 const double weight = one ? one->weight : 0,
                              ramped_weight = other ? other->weight : 0;
                 const double allowed = file_tolerance * (one ? one->area : other->area);
                 ++effect.n_bonds;
                 effect.n_changed += std::abs(weight - ramped_weight) > allowed ? 1 : 0;
                 const double before = one ? entry(*one) : 0, after = other ? entry(*other) : 0;
                 effect.change = std::max(effect.change, std::abs(before - after));
                 largest = std::max(largest, std::abs(before));
               });
    }

  } // namespace

  template <int dim>
  std::vector<RampEffect> ramp_effects(const GivenBonds<dim> &given,
                                       const std::vector<Family<dim>> &families)
  {
    const double before = check_moments(families, given.kernel, 2).typical();
    std::vector<RampEffect> effects;
    for (const std::string name : {"LAMMPS", "QWJ", "PA-AC"})
    {
      const std::vector<Family<dim>> ramped = rule_families(name, given);
      RampEffect effect;
      effect.rule = name;
      double largest = 0;
      for (std::size_t i = 0; i < families.size(); ++i)
        compare(families[i], ramped[i], given.kernel, effect, largest);
      effect.change /= largest > 0 ? largest : 1;
      effect.before = before;
      effect.after = check_moments(ramped, given.kernel, 2).typical();
      effects.push_back(effect);
    }
    return effects;
  }

  std::string ramp_text(const std::vector<RampEffect> &effects, const std::string &measure)
  {
    std::string same, others;
    for (const RampEffect &effect : effects)
      if (effect.is_seen())
        others += (others.empty() ? "" : ", ") + base::to_percent(effect.after) +
                  " with those of " + effect.rule;
      else
        same += (same.empty() ? "" : " and ") + effect.rule;
    std::string text = "whole cells where the horizon cuts them";
    if (!others.empty())
      text += "; with partial " + measure + "s the moments of most nodes would be off by " +
              others + ", instead of " + base::to_percent(effects.front().before) +
              ", so that moments do not tell whether a ramp was left out: name the rule that is "
              "meant in Methods/names";
    if (!same.empty())
      text += "; " + same + " would make the same operator here" +
              (others.empty() ? "" : ", its ramp being where no node or no kernel is");
    return text;
  }

  template std::vector<RampEffect> ramp_effects(const GivenBonds<2> &,
                                                const std::vector<Family<2>> &);
  template std::vector<RampEffect> ramp_effects(const GivenBonds<3> &,
                                                const std::vector<Family<3>> &);
} // namespace plumbline::meshfree
