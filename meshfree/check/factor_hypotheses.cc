#include "meshfree/check/hypothesis.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/bond_ramp.h"
#include "meshfree/check/length_profile.h"
#include "meshfree/check/volume_check.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double exact = file_tolerance;

    std::vector<Family<2>> undone(std::vector<Family<2>> families,
                                  const std::function<void(std::vector<Family<2>> &)> &undo)
    {
      undo(families);
      return families;
    }

    /// How far kernel points of most bonds are from the neighbours, in sizes of their cells.
    double misplacement(const std::vector<Family<2>> &families)
    {
      std::vector<double> distances;
      for (const Family<2> &family : families)
        for (const Bond<2> &bond : family.bonds)
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

    std::vector<PointHypothesis> point_hypotheses(const GivenBonds &given)
    {
      return {{"kernel at midpoints",
               "the kernel is taken at the midpoints of the bonds, not at the neighbours", .5,
               [](Bond<2> &bond, std::size_t, std::size_t) { bond.kernel_point *= 2; }},
              {"kernel points reversed",
               "the kernel points (qx, qy) are reversed: on the other side of node i, as if taken "
               "from the neighbour to it",
               -1, [](Bond<2> &bond, std::size_t, std::size_t) { bond.kernel_point *= -1; }},
              {"kernel points absolute",
               "the kernel points (qx, qy) are absolute places, not relative to node i", 1,
               [&given](Bond<2> &bond, std::size_t i, std::size_t)
               { bond.kernel_point -= given.origin + given.cells.nodes[i]; }},
              {"kernel points from the neighbour",
               "the kernel points (qx, qy) are relative to node j, not to node i", 1,
               [](Bond<2> &bond, std::size_t, std::size_t)
               { bond.kernel_point += dealii::Tensor<1, 2>(bond.xi); }}};
    }
  } // namespace

  std::optional<Mend> kernel_points(const Evidence &evidence)
  {
    constexpr double in_place = .5, much_closer = .25;
    const std::vector<Family<2>> &families = evidence.given.families;
    const double given_misplacement = misplacement(families);
    if (given_misplacement < in_place)
      return {};
    for (const PointHypothesis &hypothesis : point_hypotheses(evidence.given))
    {
      const auto undo = for_each_bond(hypothesis.undo);
      const double left = misplacement(undone(families, undo));
      if (left > in_place || left > much_closer * given_misplacement)
        continue;
      Mend mend{{hypothesis.name, hypothesis.text}, undo};
      mend.cause.point_scale = hypothesis.scale;
      mend.need = Need::not_worse;
      return mend;
    }
    return {};
  }

  std::optional<Mend> whole_ball(const Evidence &evidence)
  {
    const GivenBonds &given = evidence.given;
    const double ball = M_PI * given.kernel.horizon() * given.kernel.horizon();
    std::vector<double> sums;
    for (const Family<2> &family : given.families)
    {
      double sum = 0;
      for (const Bond<2> &bond : family.bonds)
        sum += bond.weight;
      sums.push_back(std::abs(sum / ball - 1));
    }
    if (spread_of(sums).median > given.precision.weight)
      return {};
    Mend mend{
        {"own volume counted", "the weights of a node add up to the whole ball: its own "
                               "volume is counted in, though it has no bond"},
        for_each_bond([&volumes = given.volumes, ball](Bond<2> &bond, std::size_t i, std::size_t)
                      { bond.weight *= 1 - volumes[i] / ball; })};
    mend.cause.factor = 1 / (1 - given.volumes[0] / ball);
    mend.changes_rule = true;
    return mend;
  }

  namespace
  {
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

    /// From simple to far-fetched; the first is for weights with the wrong sign alone.
    std::vector<FactorHypothesis> factor_hypotheses(const Evidence &evidence)
    {
      const GivenBonds &given = evidence.given;
      const double m = given.kernel.horizon() / node_size(given),
                   of_volumes = evidence.circumstances.volume_factor;
      std::vector<FactorHypothesis> result = {{1, "", ""}};
      if (of_volumes != 1)
        result.push_back(
            {of_volumes, "factor of the volumes", "all weights carry the same factor"});
      const std::vector<FactorHypothesis> others = {
          {2, "factor 2", "all weights are twice too large" + limit_text(given.kernel, 2)},
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
      result.insert(result.end(), others.begin(), others.end());
      return result;
    }

    /// Negative where the weights are.
    double typical_ratio(const GivenBonds &given)
    {
      return spread_of(check_moments(given.families, given.kernel).ratios).median;
    }

    std::function<void(std::vector<Family<2>> &)> divide_by(double factor)
    {
      return for_each_bond([factor](Bond<2> &bond, std::size_t, std::size_t)
                           { bond.weight /= factor; });
    }

    /// That it is one factor: of a rule's weights, or where weights over volumes hardly depend on
    /// the length of bonds, as those that correct moments do.
    bool is_constant(const Evidence &evidence)
    {
      constexpr double little = .25;
      return evidence.rule || length_profile(evidence.given).variation() < little;
    }

    struct Factor
    {
      FactorHypothesis hypothesis;
      double after = 0;
    };

    /// The one of the hypotheses that fits best, if one does.
    std::optional<Factor> find_known_factor(const Evidence &evidence, double found)
    {
      constexpr double same = 1e-3; // m is that of the mean cell
      const GivenBonds &given = evidence.given;
      const double before = typical(given.families, given.kernel);
      std::optional<Factor> best;
      for (FactorHypothesis one : factor_hypotheses(evidence))
      {
        if (one.factor == 1 && found > 0)
          continue;
        const double signed_factor = found < 0 ? -one.factor : one.factor;
        const double after =
            typical(undone(given.families, divide_by(signed_factor)), given.kernel);
        const bool fits =
            evidence.rule ? std::abs(found / signed_factor - 1) < same : explains(before, after);
        if (fits && (!best || after < .5 * best->after))
          best = Factor{one, after};
      }
      return best;
    }
  } // namespace

  std::optional<Mend> factor_of_weights(const Evidence &evidence)
  {
    const GivenBonds &given = evidence.given;
    if (evidence.has_factor || !is_constant(evidence))
      return {};
    const double found = evidence.rule ? evidence.rule->factor : typical_ratio(given);
    const std::optional<Factor> known = find_known_factor(evidence, found);
    Mend mend{{}, {}};
    Cause &cause = mend.cause;
    if (known)
    {
      cause = {known->hypothesis.name, known->hypothesis.text};
      cause.factor = (found < 0 ? -1 : 1) * known->hypothesis.factor;
    }
    else
    { // a rule's own error is no factor: beyond it, or exact between weights
      const double m = given.kernel.horizon() / node_size(given), size = std::abs(found);
      const bool is_seen =
          evidence.rule
              ? std::abs(found - 1) > given.precision.weight
              : std::abs(found - 1) > 1 / m &&
                    explains(typical(given.families, given.kernel),
                             typical(undone(given.families, divide_by(found)), given.kernel));
      if (found == 0 || !is_seen)
        return {};
      cause = {"common factor", "all weights carry a common factor of " + base::to_text(size, 4)};
      cause.factor = found;
    }
    if (found < 0)
    {
      cause.name = cause.name.empty() ? "negated" : "negated, " + cause.name;
      cause.text =
          "all weights have the wrong sign" + (cause.text.empty() ? "" : ", and " + cause.text);
    }
    mend.undo = divide_by(cause.factor);
    return mend;
  }

  std::optional<Mend> missing_ramp(const Evidence &evidence)
  {
    const GivenBonds &given = evidence.given;
    if (!evidence.rule || !evidence.rule->is_full_area())
      return {};
    const std::vector<std::string> &meant = evidence.circumstances.meant;
    const auto is_meant = [&](const std::string &name)
    { return std::find(meant.begin(), meant.end(), name) != meant.end(); };
    std::optional<Mend> best;
    double best_after = 0;
    for (const RampEffect &effect : ramp_effects(given, given.families))
    {
      Mend mend{{"missing ramp",
                 "all weights are whole cells where the horizon cuts them: the partial areas of " +
                     effect.rule + " are missing"},
                [right = rule_families(effect.rule, given)](std::vector<Family<2>> &families)
                {
                  const double ratio = common_ratio(families);
                  families = right;
                  for (Family<2> &family : families)
                    for (Bond<2> &bond : family.bonds)
                      bond.weight *= ratio;
                }};
      if (is_meant(effect.rule) && !is_meant("FA") && !is_meant("all") && effect.is_seen())
      {
        mend.need = Need::nothing;
        mend.cause.text += " at " + std::to_string(effect.n_changed) + " of " +
                           std::to_string(effect.n_bonds) +
                           " bonds, though Methods/names has that rule and not FA";
        mend.says_closer = explains(effect.before, effect.after);
        if (!mend.says_closer)
          mend.cause.text += "; the moments cannot decide: their error is " +
                             base::to_percent(effect.before) + ", and " +
                             base::to_percent(effect.after) + " with partial areas";
        return mend;
      }
      mend.cause.is_own_error = true;
      if (explains(effect.before, effect.after) && (!best || effect.after < best_after))
      {
        best = mend;
        best_after = effect.after;
      }
    }
    return best;
  }
} // namespace plumbline::meshfree
