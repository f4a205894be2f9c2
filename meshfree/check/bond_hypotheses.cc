#include "meshfree/check/bond_hypotheses.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/bond_ramp.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumbline::meshfree
{
  namespace
  {
    /// To be explained by a cause, a defect must shrink to this part of itself ...
    constexpr double much_closer = .25;
    /// ... or to round-off of a file.
    constexpr double exact = file_tolerance;

    std::string closer(const Cause &cause)
    {
      return "; without that the moments are off by " +
             (cause.after < exact ? "nothing" : base::to_percent(cause.after)) + " instead of " +
             base::to_percent(cause.before);
    }

    bool explains(const Cause &cause)
    {
      return cause.before > exact &&
             (cause.after < exact || cause.after <= much_closer * cause.before);
    }

    double typical(const std::vector<Family> &families, const Kernel<2> &kernel)
    {
      return check_moments(families, kernel).typical();
    }

    using Change = std::function<void(Bond &bond, std::size_t node)>;

    std::vector<Family> changed(std::vector<Family> families, const Change &change)
    {
      for (std::size_t i = 0; i < families.size(); ++i)
        for (Bond &bond : families[i].bonds)
          change(bond, i);
      return families;
    }

    /// How far kernel points of most bonds are from the neighbours, in sizes of their cells.
    double misplacement(const std::vector<Family> &families)
    {
      std::vector<double> distances;
      for (const Family &family : families)
        for (const Bond &bond : family.bonds)
          distances.push_back(bond.kernel_point.distance(bond.xi) / std::sqrt(bond.area));
      return spread_of(distances).median;
    }

    /// What was done to kernel points, and how it is undone.
    struct PointHypothesis
    {
      const char *name, *text;
      double scale;
      Change undo;
    };

    std::optional<Cause> find_point_cause(const GivenBonds &given, std::vector<Family> &families)
    {
      constexpr double in_place = .5;
      const geometry::NodeCells &cells = given.cells;
      const std::vector<PointHypothesis> hypotheses = {
          {"kernel at midpoints",
           "the kernel is taken at the midpoints of the bonds, not at the neighbours", .5,
           [](Bond &bond, std::size_t) { bond.kernel_point *= 2; }},
          {"kernel points reversed",
           "the kernel points (qx, qy) are reversed: on the other side of node i, as if taken from "
           "the neighbour to it",
           -1, [](Bond &bond, std::size_t) { bond.kernel_point *= -1; }},
          {"kernel points absolute",
           "the kernel points (qx, qy) are absolute places, not relative to node i", 1,
           [&cells](Bond &bond, std::size_t i)
           { bond.kernel_point -= dealii::Tensor<1, 2>(cells.nodes[i]); }},
          {"kernel points from the neighbour",
           "the kernel points (qx, qy) are relative to node j, not to node i", 1,
           [](Bond &bond, std::size_t) { bond.kernel_point += dealii::Tensor<1, 2>(bond.xi); }}};
      const double given_misplacement = misplacement(families);
      if (given_misplacement < in_place)
        return {};
      for (const PointHypothesis &hypothesis : hypotheses)
      {
        std::vector<Family> undone = changed(families, hypothesis.undo);
        const double left = misplacement(undone);
        if (left > in_place || left > much_closer * given_misplacement)
          continue;
        Cause cause{hypothesis.name, hypothesis.text};
        cause.before = typical(families, given.kernel);
        cause.after = typical(undone, given.kernel);
        cause.point_scale = hypothesis.scale;
        if (std::abs(cause.before - cause.after) > exact)
          cause.text += closer(cause);
        else
          cause.text += "; the moments do not feel it with this kernel";
        families = std::move(undone);
        return cause;
      }
      return {};
    }

    std::string limit_text(const Kernel<2> &kernel, double factor)
    {
      const double diffusion = kernel.limit().diffusion;
      if (kernel.n_components() > 1 || !(diffusion > 0))
        return {};
      const auto laplace = [](double d)
      {
        return std::abs(d - 1) < exact ? std::string("-Laplace")
                                       : "-" + base::to_text(d, 4) + " Laplace";
      };
      return ", as if made for the limit " + laplace(factor * diffusion) + ", not " +
             laplace(diffusion);
    }

    struct FactorHypothesis
    {
      double factor;
      std::string name, text;
    };

    /// From simple to far-fetched.
    std::vector<FactorHypothesis> factor_hypotheses(const GivenBonds &given)
    {
      const double m = given.kernel.horizon() / node_size(given);
      return {{2, "factor 2", "all weights are twice too large" + limit_text(given.kernel, 2)},
              {.5, "factor 1/2",
               "all weights are half of what they should be" + limit_text(given.kernel, .5)},
              {.75 / m, "volume of a ball",
               "all weights carry the factor 3/(4 m) = " + base::to_text(.75 / m, 4) +
                   ", the volume of the horizon in 2D, pi delta^2 h, over that of a ball, 4/3 pi "
                   "delta^3: a formula for 3D on a plane of nodes"},
              {1.25 / m, "bond constant of 3D",
               "all weights carry the factor 5/(4 m) = " + base::to_text(1.25 / m, 4) +
                   ", the bond constant of 3D, 18 k / (pi delta^4), times h over that of plane "
                   "strain"}};
    }

    /// Negative where the weights are.
    double typical_ratio(const std::vector<Family> &families, const Kernel<2> &kernel)
    {
      return spread_of(check_moments(families, kernel).ratios).median;
    }

    std::optional<Cause> find_own_volume(const GivenBonds &given,
                                         const std::vector<Family> &families)
    {
      const double ball = M_PI * given.kernel.horizon() * given.kernel.horizon();
      std::vector<double> sums;
      for (const Family &family : families)
      {
        double sum = 0;
        for (const Bond &bond : family.bonds)
          sum += bond.weight;
        sums.push_back(std::abs(sum / ball - 1));
      }
      if (spread_of(sums).median > exact)
        return {};
      Cause cause{"own volume counted", "the weights of a node add up to the whole ball: its own "
                                        "volume is counted in, though it has no bond"};
      cause.before = typical(families, given.kernel);
      cause.after = typical(changed(families, [&](Bond &bond, std::size_t i)
                                    { bond.weight *= 1 - given.volumes[i] / ball; }),
                            given.kernel);
      if (cause.before < exact || cause.after > cause.before)
        return {};
      cause.factor = 1 / (1 - given.volumes[0] / ball);
      cause.text += closer(cause);
      return cause;
    }

    std::optional<Cause> find_factor(const GivenBonds &given, const std::vector<Family> &families,
                                     const std::optional<Recognised> &rule)
    {
      constexpr double same = 1e-3; // m is that of the mean volume
      const double found = rule ? rule->factor : typical_ratio(families, given.kernel);
      const double size = std::abs(found), sign = found < 0 ? -1 : 1;
      const auto undone = [&](double factor)
      {
        return typical(changed(families, [&](Bond &bond, std::size_t) { bond.weight /= factor; }),
                       given.kernel);
      };
      const double before = typical(families, given.kernel);
      std::vector<FactorHypothesis> hypotheses = {{1, "", ""}}; // but for the sign
      for (const FactorHypothesis &one : factor_hypotheses(given))
        hypotheses.push_back(one);
      std::optional<Cause> best;
      for (const FactorHypothesis &one : hypotheses)
      {
        if (one.factor == 1 && sign > 0)
          continue;
        Cause cause{one.name, one.text, before, undone(sign * one.factor), sign * one.factor};
        const bool fits = rule ? std::abs(size / one.factor - 1) < same : explains(cause);
        if (fits && (!best || cause.after < .5 * best->after))
          best = cause;
      }
      // a rule's own error is no factor: beyond it, or exact between weights
      const double m = given.kernel.horizon() / node_size(given);
      if (!best && (rule ? std::abs(found - 1) > exact : std::abs(found - 1) > 1 / m))
      {
        Cause cause{"common factor",
                    "all weights carry a common factor of " + base::to_text(size, 4), before,
                    undone(found), found};
        if (rule || explains(cause))
          best = cause;
      }
      if (!best)
        return {};
      if (sign < 0)
      {
        best->name = best->name.empty() ? "negated" : "negated, " + best->name;
        best->text =
            "all weights have the wrong sign" + (best->text.empty() ? "" : ", and " + best->text);
      }
      best->text += closer(*best);
      return best;
    }

    std::optional<Cause> find_missing_ramp(const GivenBonds &given,
                                           const std::vector<Family> &families,
                                           const std::optional<Recognised> &rule,
                                           const std::vector<std::string> &meant)
    {
      if (!rule || !rule->is_full_area())
        return {};
      const auto is_meant = [&](const std::string &name)
      { return std::find(meant.begin(), meant.end(), name) != meant.end(); };
      std::optional<Cause> best;
      for (const RampEffect &effect : ramp_effects(given, families))
      {
        Cause cause{"missing ramp",
                    "all weights are whole cells where the horizon cuts them: the partial areas "
                    "of " +
                        effect.rule + " are missing",
                    effect.before, effect.after};
        cause.is_own_error = true;
        if (is_meant(effect.rule) && !is_meant("FA") && !is_meant("all") && effect.is_seen())
        {
          cause.is_own_error = false;
          cause.text += " at " + std::to_string(effect.n_changed) + " of " +
                        std::to_string(effect.n_bonds) +
                        " bonds, though Methods/names has that rule and not FA";
          cause.text += explains(cause) ? closer(cause)
                                        : "; the moments do not tell: they are off by " +
                                              base::to_percent(cause.before) + ", and by " +
                                              base::to_percent(cause.after) + " with them";
          return cause;
        }
        if (explains(cause) && (!best || cause.after < best->after))
          best = cause;
      }
      if (best)
        best->text += closer(*best);
      return best;
    }
  } // namespace

  std::vector<Cause> find_causes(const GivenBonds &given, const std::optional<Recognised> &rule,
                                 const std::vector<std::string> &meant)
  {
    std::vector<Cause> causes;
    std::vector<Family> families = given.families;
    if (const auto cause = find_point_cause(given, families))
      causes.push_back(*cause);
    for (const auto &find :
         {std::function<std::optional<Cause>()>([&] { return find_own_volume(given, families); }),
          std::function<std::optional<Cause>()>([&] { return find_factor(given, families, rule); }),
          std::function<std::optional<Cause>()>(
              [&] { return find_missing_ramp(given, families, rule, meant); })})
      if (const auto cause = find())
      {
        causes.push_back(*cause);
        break;
      }
    return causes;
  }
} // namespace plumbline::meshfree
