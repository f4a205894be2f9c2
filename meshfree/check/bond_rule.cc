#include "meshfree/check/bond_rule.h"

#include "base/error.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// The factor between the weights of most bonds.
    double common_factor(const std::vector<Family<2>> &given, const std::vector<Family<2>> &rule)
    {
      constexpr double small = .1; // weights of which say little
      std::vector<double> ratios;
      for (std::size_t i = 0; i < given.size(); ++i)
        for_both(given[i], rule[i],
                 [&](const Bond<2> *a, const Bond<2> *b, std::size_t)
                 {
                   if (a && b && std::abs(b->weight) > small * a->area)
                     ratios.push_back(a->weight / b->weight);
                 });
      return spread_of(ratios).median;
    }

    struct Agreement
    {
      std::size_t n_bonds = 0, n_weights = 0, n_points = 0;
    };

    Agreement agreement(const GivenBonds &given, const std::vector<Family<2>> &rule, double factor)
    {
      const Precision &precision = given.precision;
      Agreement result;
      for (std::size_t i = 0; i < rule.size(); ++i)
        for_both(given.families[i], rule[i],
                 [&](const Bond<2> *a, const Bond<2> *b, std::size_t)
                 {
                   if (!(a && b) && is_at_horizon(given, (a ? a : b)->xi))
                     return;
                   const double volume = a ? a->area : b->area;
                   const double difference =
                       std::abs((a ? a->weight : 0) / factor - (b ? b->weight : 0));
                   ++result.n_bonds;
                   result.n_weights += difference <= precision.weight * volume ? 1 : 0;
                   if (a && b)
                     result.n_points +=
                         a->kernel_point.distance(b->kernel_point) <=
                                 file_tolerance * std::sqrt(volume) + 4 * precision.length
                             ? 1
                             : 0;
                 });
      return result;
    }

    std::vector<Family<2>> families_of(const Rule &rule, const GivenBonds &given)
    {
      geometry::NodeCells<2> cells = given.cells;
      cells.area = given.volumes;
      const Families<2> families(rule.in_plane(given.kernel), given.kernel, cells, Backend::fast);
      std::vector<Family<2>> result(families.size());
      for (std::size_t i = 0; i < families.size(); ++i)
        families.make(i, result[i]);
      return result;
    }
  } // namespace

  bool is_at_horizon(const GivenBonds &given, const Point<2> &xi)
  {
    const double horizon = given.kernel.horizon();
    return std::abs(xi.norm() - horizon) <=
           std::max(tie_tolerance * horizon, 4 * given.precision.length);
  }

  std::vector<Family<2>> rule_families(const std::string &name, const GivenBonds &given)
  {
    return families_of(find_rule(name, "rule"), given);
  }

  bool Recognised::is_full_area() const
  {
    using Of = NeighbourhoodQuadrature<2> (*)(const Kernel<2> &);
    const auto is_whole = [](const Rule &one)
    {
      const Of *of = one.in_plane.target<Of>();
      return of != nullptr && *of == full_area<2>;
    };
    return std::any_of(rules().begin(), rules().end(),
                       [&](const Rule &one) { return one.name == rule && is_whole(one); });
  }

  std::optional<Recognised> recognise(const GivenBonds &given)
  {
    constexpr double enough = .9;
    std::vector<Rule> candidates = rules();
    candidates.insert(candidates.end(), rules_on_request().begin(), rules_on_request().end());
    std::optional<Recognised> best;
    std::size_t best_score = 0;
    const bool is_tensor = given.kernel.n_components() > 1;
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&](const Rule &rule) { return is_tensor && rule.is_scalar; }),
                     candidates.end());
    for (const Rule &rule : candidates)
      try
      {
        std::vector<Family<2>> families = families_of(rule, given);
        const double factor = common_factor(given.families, families);
        if (factor == 0)
          continue;
        const Agreement found = agreement(given, families, factor);
        const double wanted = enough * static_cast<double>(found.n_bonds);
        const std::size_t score = found.n_weights + found.n_points;
        if (static_cast<double>(found.n_weights) < wanted || score <= best_score)
          continue;
        best_score = score;
        for (Family<2> &family : families)
          for (Bond<2> &bond : family.bonds)
            bond.weight *= factor;
        best = {rule.name, factor, static_cast<double>(found.n_points) >= wanted,
                std::move(families)};
      }
      catch (const NumericalError &)
      {
        // infeasible on these nodes: it is not what the code did
      }
    return best;
  }
} // namespace plumbline::meshfree
