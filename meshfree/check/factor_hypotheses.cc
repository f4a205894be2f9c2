#include "meshfree/check/hypothesis.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/bond_ramp.h"
#include "meshfree/check/length_profile.h"
#include "meshfree/check/sizes.h"
#include "meshfree/check/volume_check.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double exact = file_tolerance;

    template <int dim>
    std::vector<Family<dim>> undone(std::vector<Family<dim>> families,
                                    const std::function<void(std::vector<Family<dim>> &)> &undo)
    {
      undo(families);
      return families;
    }

    /// How far kernel points of most bonds are from the rule's, or from the neighbours, in sizes of
    /// their cells.
    template <int dim>
    double misplacement(const std::vector<Family<dim>> &families,
                        const std::optional<Recognised<dim>> &rule)
    {
      std::vector<double> distances;
      for (std::size_t i = 0; i < families.size(); ++i)
        for (std::size_t k = 0; k < families[i].bonds.size(); ++k)
        {
          const Bond<dim> &bond = families[i].bonds[k];
          const Bond<dim> *const right =
              rule ? find_bond(rule->families[i], families[i].neighbours[k]) : nullptr;
          distances.push_back(bond.kernel_point.distance(right ? right->kernel_point : bond.xi) /
                              cell_size<dim>(bond.area));
        }
      return spread_of(distances).median;
    }

    /// What was done to kernel points, and how it is undone.
    template <int dim>
    struct PointHypothesis
    {
      std::string name, text;
      double scale;
      Change<dim> undo;
    };

    template <int dim>
    std::vector<PointHypothesis<dim>> point_hypotheses(const GivenBonds<dim> &given)
    {
      const std::string q = dim == 2 ? "(qx, qy)" : "(qx, qy, qz)";
      return {{"kernel at midpoints",
               "the kernel is evaluated at the midpoints of the bonds, not at the neighbours", .5,
               [](Bond<dim> &bond, std::size_t, std::size_t) { bond.kernel_point *= 2; }},
              {"kernel points reversed",
               "the kernel points " + q +
                   " are reversed: on the other side of node i, as if taken "
                   "from the neighbour to it",
               -1, [](Bond<dim> &bond, std::size_t, std::size_t) { bond.kernel_point *= -1; }},
              {"kernel points absolute",
               "the kernel points " + q + " are absolute positions, not relative to node i", 1,
               [&given](Bond<dim> &bond, std::size_t i, std::size_t)
               { bond.kernel_point -= given.origin + given.cells.nodes[i]; }},
              {"kernel points from the neighbour",
               "the kernel points " + q + " are relative to node j, not to node i", 1,
               [](Bond<dim> &bond, std::size_t, std::size_t)
               { bond.kernel_point += dealii::Tensor<1, dim>(bond.xi); }}};
    }
  } // namespace

  template <int dim>
  std::optional<Mend<dim>> kernel_points(const Evidence<dim> &evidence)
  {
    constexpr double in_place = .5, much_closer = .25;
    const std::vector<Family<dim>> &families = evidence.given.families;
    const double given_misplacement = misplacement(families, evidence.rule);
    if (given_misplacement < in_place)
      return {};
    for (const PointHypothesis<dim> &hypothesis : point_hypotheses(evidence.given))
    {
      const auto undo = for_each_bond<dim>(hypothesis.undo);
      const double left = misplacement(undone<dim>(families, undo), evidence.rule);
      if (left > in_place || left > much_closer * given_misplacement)
        continue;
      Mend<dim> mend{{hypothesis.name, hypothesis.text}, undo};
      mend.cause.point_scale = hypothesis.scale;
      mend.need = Need::not_worse;
      return mend;
    }
    return {};
  }

  template <int dim>
  std::optional<Mend<dim>> kernel_at_nodes(const Evidence<dim> &evidence)
  {
    const std::vector<Family<dim>> &families = evidence.given.families;
    if (!evidence.rule || evidence.rule->has_kernel_points)
      return {};
    constexpr double same = 1e-6; // of cells
    std::size_t n = 0, n_at_nodes = 0;
    for (const Family<dim> &family : families)
      for (const Bond<dim> &bond : family.bonds)
      {
        ++n;
        n_at_nodes +=
            bond.kernel_point.distance(bond.xi) < same * cell_size<dim>(bond.area) ? 1 : 0;
      }
    if (2 * n_at_nodes < n)
      return {};
    const std::string q = dim == 2 ? "qx and qy" : "qx, qy and qz";
    Mend<dim> mend{
        {"kernel at nodes", "the kernel is evaluated at the nodes; " + evidence.rule->rule +
                                " evaluates it at the centroid of ball and cell; give " + q},
        [right = evidence.rule->families](std::vector<Family<dim>> &all)
        {
          for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t k = 0; k < all[i].bonds.size(); ++k)
              if (const Bond<dim> *one = find_bond(right[i], all[i].neighbours[k]))
                all[i].bonds[k].kernel_point = one->kernel_point;
        }};
    return mend;
  }

  template <int dim>
  std::optional<Mend<dim>> whole_ball(const Evidence<dim> &evidence)
  {
    const GivenBonds<dim> &given = evidence.given;
    const double ball = ball_volume<dim>(given.kernel.horizon());
    std::vector<double> sums;
    for (const Family<dim> &family : given.families)
    {
      double sum = 0;
      for (const Bond<dim> &bond : family.bonds)
        sum += bond.weight;
      sums.push_back(std::abs(sum / ball - 1));
    }
    if (spread_of(sums).median > given.precision.weight)
      return {};
    Mend<dim> mend{{"own volume counted", "the weights of a node add up to the whole ball: its own "
                                          "volume is included, although it has no bond"},
                   for_each_bond<dim>(
                       [&volumes = given.volumes, ball](Bond<dim> &bond, std::size_t i, std::size_t)
                       { bond.weight *= 1 - volumes[i] / ball; })};
    mend.cause.factor = 1 / (1 - given.volumes[0] / ball);
    mend.changes_rule = true;
    return mend;
  }

  namespace
  {
    template <int dim>
    std::string limit_text(const Kernel<dim> &kernel, double factor)
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

    /// The constant of a kernel in the plane over that in space, times the length that a plate is
    /// thick, where both have the same limit. With the profile g, c ∫ g(r) n_x² r² dV is the same
    /// for scalars, so that c_2/c_3 = 4/3 ∫ g r⁴ dr / ∫ g r³ dr; for bond tensors c ∫ g n_x² n_y²
    /// r² dV, with means of n_x² n_y² of 1/8 over the circle and 1/15 over the sphere: 16/15 of the
    /// integrals. With g = 1/r that is 4/5 δ, as in c_2 = 48 E/(5 π h δ³) of plane strain and
    /// c_3 = 12 E/(π δ⁴) (Silling & Askari 2005, doi:10.1016/j.compstruc.2004.11.026); of plane
    /// stress, 9 E/(π h δ³), it is 15/16 of that.
    double plane_constant(const Kernel<3> &kernel)
    {
      static const dealii::QIterated<1> rule(dealii::QGauss<1>(8), 32);
      double third = 0, fourth = 0;
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double r = kernel.horizon() * rule.point(q)[0],
                     value = rule.weight(q) * kernel.radial(r) * r * r * r;
        third += value;
        fourth += value * r;
      }
      return (kernel.n_components() == 1 ? 4. / 3 : 16. / 15) * fourth / third;
    }

    struct FactorHypothesis
    {
      double factor;
      std::string name, text;
      bool is_far_fetched = false; ///< where no rule is recognised, the moments must be near it
    };

    /// Factors that come from formulas of the other dimension.
    template <int dim>
    std::vector<FactorHypothesis> factors_of_dimensions(const GivenBonds<dim> &given)
    {
      const double m = given.kernel.horizon() / node_size(given);
      const auto text = [](double factor) { return base::to_text(factor, 4); };
      if constexpr (dim == 2)
        return {{.75 / m, "volume of a ball",
                 "all weights carry the factor 3/(4 m) = " + text(.75 / m) +
                     ", the volume of the horizon in 2D, pi delta^2 h, over that of a ball, 4/3 pi "
                     "delta^3: a 3D formula used in 2D"},
                {1.25 / m, "bond constant of 3D",
                 "all weights carry the factor 5/(4 m) = " + text(1.25 / m) +
                     ", the bond constant of 3D, 18 k / (pi delta^4), times h over that of plane "
                     "strain"}};
      else
      {
        std::vector<FactorHypothesis> result = {
            {4 * m / 3, "area of a disc",
             "all weights carry the factor 4 m/3 = " + text(4 * m / 3) +
                 ", the volume of a ball, 4/3 pi delta^3, over that of the horizon in a plate of "
                 "thickness h, pi delta^2 h: a 2D formula used in 3D",
             true}};
        const double plane = plane_constant(given.kernel) / node_size(given);
        if (given.kernel.n_components() == 1)
          result.push_back({plane, "kernel constant of 2D",
                            "all weights carry the factor " + text(plane) +
                                ", the kernel's constant in a plate of thickness h over that of "
                                "3D: a 2D constant used in 3D",
                            true});
        else
          for (const auto &[state, ratio] :
               {std::pair{"plane strain", 1.}, std::pair{"plane stress", 15. / 16}})
            result.push_back({ratio * plane, std::string("bond constant of ") + state,
                              "all weights carry the factor " + text(ratio * plane) +
                                  ", the bond constant of " + state +
                                  " in a plate of thickness h over that of 3D at the same Young's "
                                  "modulus: a 2D constant used in 3D",
                              true});
        return result;
      }
    }

    /// From simple to far-fetched; the first is for weights with the wrong sign alone.
    template <int dim>
    std::vector<FactorHypothesis> factor_hypotheses(const Evidence<dim> &evidence)
    {
      const GivenBonds<dim> &given = evidence.given;
      const double of_volumes = evidence.circumstances.volume_factor, h = node_size(given),
                   constant = given.kernel.constant();
      std::vector<FactorHypothesis> result = {{1, "", ""}};
      if (of_volumes != 1)
        result.push_back(
            {of_volumes, "factor of the volumes", "all weights carry the same factor"});
      const std::string cell = dim == 2 ? "area h^2" : "volume h^3";
      const std::vector<FactorHypothesis> others = {
          {2, "factor 2",
           "all weights are twice too large" + limit_text(given.kernel, 2) +
               "; each pair may be counted from both ends (directed and undirected bonds)"},
          {.5, "factor 1/2",
           "all weights are half of what they should be" + limit_text(given.kernel, .5) +
               "; each pair may be shared between both ends (directed and undirected bonds)"},
          {1 / std::pow(h, dim), "no volume",
           "all weights lack the " + cell + " of the neighbour's cell, h = " + base::to_text(h, 4),
           true},
          {std::pow(h, dim), "volume twice",
           "all weights contain the " + cell +
               " of the neighbour's cell twice, h = " + base::to_text(h, 4) +
               "; if they are force constants, choose --bonds-are 'force constants'",
           true},
          {1 / constant, "no constant",
           "all weights lack the kernel's constant c = " + base::to_text(constant, 4) +
               ": the normalisation of the kernel is missing",
           true},
          {constant, "constant in the weights",
           "all weights contain the kernel's constant c = " + base::to_text(constant, 4) +
               ", which is then applied twice",
           true}};
      result.insert(result.end(), others.begin(), others.end());
      if (dim == 3)
        result.push_back({1 / h, "areas for volumes",
                          "all weights are areas, h^2 in place of h^3, h = " + base::to_text(h, 4),
                          true});
      const std::vector<FactorHypothesis> of_dimensions = factors_of_dimensions(given);
      result.insert(result.end(), of_dimensions.begin(), of_dimensions.end());
      return result;
    }

    /// Negative where the weights are.
    template <int dim>
    double typical_ratio(const GivenBonds<dim> &given)
    {
      return spread_of(check_moments(given.families, given.kernel, 2).ratios).median;
    }

    template <int dim>
    std::function<void(std::vector<Family<dim>> &)> divide_by(double factor)
    {
      return for_each_bond<dim>([factor](Bond<dim> &bond, std::size_t, std::size_t)
                                { bond.weight /= factor; });
    }

    /// That it is one factor: of a rule's weights, or where weights over volumes hardly depend on
    /// the length of bonds, as those that correct moments do.
    template <int dim>
    bool is_constant(const Evidence<dim> &evidence)
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
    template <int dim>
    std::optional<Factor> find_known_factor(const Evidence<dim> &evidence, double found)
    {
      constexpr double same = 1e-3; // m is that of the mean cell
      constexpr double near = .1;   // more than a rule's own error
      const GivenBonds<dim> &given = evidence.given;
      if (evidence.rule && std::abs(found - 1) <= given.precision.weight)
        return {};
      const double before = typical(given.families, given.kernel);
      std::optional<Factor> best;
      for (FactorHypothesis one : factor_hypotheses<dim>(evidence))
      {
        const bool is_like_none = one.factor != evidence.circumstances.volume_factor &&
                                  std::abs(one.factor - 1) < same; // as 1/h^3 where h is near 1
        if ((one.factor == 1 && found > 0) || (one.factor != 1 && is_like_none))
          continue;
        const double signed_factor = found < 0 ? -one.factor : one.factor;
        if (one.is_far_fetched && !(std::abs(found / signed_factor - 1) < near))
          continue;
        const double after =
            typical(undone<dim>(given.families, divide_by<dim>(signed_factor)), given.kernel);
        const bool fits =
            evidence.rule ? std::abs(found / signed_factor - 1) < same : explains(before, after);
        if (fits && (!best || after < .5 * best->after))
          best = Factor{one, after};
      }
      return best;
    }
  } // namespace

  template <int dim>
  std::optional<Mend<dim>> factor_of_weights(const Evidence<dim> &evidence)
  {
    const GivenBonds<dim> &given = evidence.given;
    if (evidence.has_factor || !is_constant(evidence))
      return {};
    const double found = evidence.rule ? evidence.rule->factor : typical_ratio(given);
    const std::optional<Factor> known = find_known_factor(evidence, found);
    Mend<dim> mend{{}, {}};
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
          evidence.rule ? std::abs(found - 1) > given.precision.weight
                        : std::abs(found - 1) > 1 / m &&
                              explains(typical(given.families, given.kernel),
                                       typical(undone<dim>(given.families, divide_by<dim>(found)),
                                               given.kernel));
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
    mend.undo = divide_by<dim>(cause.factor);
    return mend;
  }

  template <int dim>
  std::optional<Mend<dim>> missing_ramp(const Evidence<dim> &evidence)
  {
    const GivenBonds<dim> &given = evidence.given;
    if (!evidence.rule || !evidence.rule->is_full_area())
      return {};
    const std::vector<std::string> &meant = evidence.circumstances.meant;
    const auto is_meant = [&](const std::string &name)
    { return std::find(meant.begin(), meant.end(), name) != meant.end(); };
    if (is_meant("FA"))
      return {};
    std::optional<Mend<dim>> best;
    double best_after = 0;
    for (const RampEffect &effect : ramp_effects(given, given.families))
    {
      Mend<dim> mend{{"missing ramp",
                      "all weights are whole cells where the horizon cuts them: the partial " +
                          std::string(measure<dim>()) + "s of " + effect.rule + " are missing"},
                     [right = rule_families(effect.rule, given)](std::vector<Family<dim>> &families)
                     {
                       const double ratio = common_ratio(families);
                       families = right;
                       for (Family<dim> &family : families)
                         for (Bond<dim> &bond : family.bonds)
                           bond.weight *= ratio;
                     }};
      if (is_meant(effect.rule) && !is_meant("all") && effect.is_seen())
      {
        mend.need = Need::nothing;
        mend.cause.text += " at " + std::to_string(effect.n_changed) + " of " +
                           std::to_string(effect.n_bonds) +
                           " bonds, though Methods/names has that rule and not FA";
        mend.says_closer = explains(effect.before, effect.after);
        if (!mend.says_closer)
          mend.cause.text +=
              "; the moments cannot decide: their error is " + base::to_percent(effect.before) +
              ", and " + base::to_percent(effect.after) + " with partial " + measure<dim>() + "s";
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

  template std::optional<Mend<2>> kernel_points(const Evidence<2> &);
  template std::optional<Mend<2>> kernel_at_nodes(const Evidence<2> &);
  template std::optional<Mend<2>> whole_ball(const Evidence<2> &);
  template std::optional<Mend<2>> factor_of_weights(const Evidence<2> &);
  template std::optional<Mend<2>> missing_ramp(const Evidence<2> &);
  template std::optional<Mend<3>> kernel_points(const Evidence<3> &);
  template std::optional<Mend<3>> kernel_at_nodes(const Evidence<3> &);
  template std::optional<Mend<3>> whole_ball(const Evidence<3> &);
  template std::optional<Mend<3>> factor_of_weights(const Evidence<3> &);
  template std::optional<Mend<3>> missing_ramp(const Evidence<3> &);
} // namespace plumbline::meshfree
