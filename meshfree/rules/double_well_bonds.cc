#include "meshfree/rules/double_well_bonds.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    WellBond make_bond(const physics::DoubleWell &law, std::array<int, 2> k, double weight,
                       double influence, const Point<2> &xi)
    {
      const double r = xi.norm(), scale = std::sqrt(law.beta() / r) / r;
      return {k, {scale * xi[0], scale * xi[1]}, law.force_factor() * law.c() * weight * influence};
    }

    struct AxisRule
    {
      const char *name;
      bool is_cut, at_centre, is_recalibrated;
    };

    constexpr std::array<AxisRule, 4> axis_rules = {{{"FA", false, false, false},
                                                     {"PA-AC", true, false, false},
                                                     {"IPA-AC", true, true, false},
                                                     {"IPA-AC-R2", true, false, true}}};

    const AxisRule &axis_rule(const std::string &name)
    {
      for (const AxisRule &rule : axis_rules)
        if (rule.name == name)
          return rule;
      throw InputError("Methods/names = '" + name +
                       "' is no rule for lattices with one axis; choose FA, PA-AC, IPA-AC or "
                       "IPA-AC-R2");
    }

    /// min Σ (w_new - w)²/w such that Σ w_new J r = wanted.
    void recalibrate(std::vector<double> &weights, const std::vector<double> &integrand,
                     double wanted)
    {
      double first = 0, second = 0;
      for (std::size_t i = 0; i < weights.size(); ++i)
      {
        first += weights[i] * integrand[i];
        second += weights[i] * integrand[i] * integrand[i];
      }
      for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] *= 1 - (first - wanted) / second * integrand[i];
    }
  } // namespace

  WellBond well_bond(const physics::DoubleWell &law, double weight, const Point<2> &kernel_point)
  {
    return make_bond(law, {}, weight, law.influence(kernel_point.norm()), kernel_point);
  }

  std::vector<WellBond> well_bonds(const physics::DoubleWell &law, const Bonds<2> &bonds)
  {
    std::vector<WellBond> result;
    for (const Bond<2> &bond : bonds.family)
    {
      result.push_back(well_bond(law, bond.weight, bond.kernel_point));
      result.back().k = {static_cast<int>(std::lround(bond.xi[0] / bonds.h)),
                         static_cast<int>(std::lround(bond.xi[1] / bonds.h))};
    }
    return result;
  }

  bool is_axis_rule(const std::string &name)
  {
    return std::any_of(axis_rules.begin(), axis_rules.end(),
                       [&](const AxisRule &rule) { return rule.name == name; });
  }

  std::vector<WellBond> axis_bonds(const physics::DoubleWell &law, double h,
                                   const std::string &rule)
  {
    const AxisRule &how = axis_rule(rule);
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("lattice: h = " + std::to_string(h) + " must be positive and finite");
    const double horizon = law.horizon();
    std::vector<double> weights, influences, integrand;
    for (int k = 1; (k - (how.is_cut ? .5 : 0)) * h <= horizon * (1 + tie_tolerance); ++k)
    {
      const double from = (k - .5) * h,
                   to = how.is_cut ? std::min(horizon, (k + .5) * h) : from + h;
      if (!(to - from > tie_tolerance * h))
        break;
      weights.push_back(to - from);
      influences.push_back(law.influence(how.at_centre ? .5 * (from + to) : k * h));
      integrand.push_back(influences.back() * k * h);
    }
    if (weights.empty())
      throw InputError("horizon = " + std::to_string(horizon) + " holds no neighbour at h = " +
                       std::to_string(h) + "; raise m = horizon / h");
    if (how.is_recalibrated)
      recalibrate(weights, integrand, horizon * horizon * law.moment(1));
    std::vector<WellBond> bonds;
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (const int sign : {1, -1})
      {
        const int k = sign * (static_cast<int>(i) + 1);
        bonds.push_back(make_bond(law, {k, 0}, weights[i], influences[i], Point<2>(k * h, 0)));
      }
    return bonds;
  }

  double lattice_toughness(const std::vector<WellBond> &bonds, int dim, double h)
  {
    // bonds up from a row of nodes cross k lines each; both directions count in PD
    const unsigned int axis = dim == 1 ? 0 : 1;
    double sum = 0;
    for (const WellBond &bond : bonds)
      sum += .25 * bond.strength * std::abs(bond.k[axis]) * h;
    return sum;
  }
} // namespace plumbline::meshfree
