#include "meshfree/check/rule_comparison.h"

#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/sizes.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// What weights and kernel points may differ from the rule's, relative to volumes and their √.
    struct Allowed
    {
      double weight, point;
    };

    /// Rounding of the files, and more where it is seen to be magnified: where 1 in 13 bonds
    /// differs by more, up to 50 times.
    template <int dim>
    Allowed allowed_by_rule(const GivenBonds<dim> &given, const Recognised<dim> &rule)
    {
      constexpr double most = 50;
      std::vector<double> weights, points;
      for (std::size_t i = 0; i < given.families.size(); ++i)
        for_both(given.families[i], rule.families[i],
                 [&](const Bond<dim> *own, const Bond<dim> *right, std::size_t j)
                 {
                   if (!own || !right)
                     return;
                   const double volume = given.volumes[j];
                   weights.push_back((own->weight - right->weight) /
                                     (volume * std::abs(rule.factor)));
                   points.push_back(own->kernel_point.distance(right->kernel_point) /
                                    cell_size<dim>(volume));
                 });
      const double of_weight = given.precision.weight,
                   of_point = file_tolerance + 4 * given.precision.length / node_size(given);
      const auto magnified = [&](const std::vector<double> &differences, double floor)
      {
        const double seen = spread_of(differences).allowed(floor);
        return seen < most * floor ? seen : floor;
      };
      return {magnified(weights, of_weight), magnified(points, of_point)};
    }
  } // namespace

  template <int dim>
  std::vector<Outlier<dim>> compare_with_rule(const GivenBonds<dim> &given,
                                              const Recognised<dim> &rule)
  {
    const Allowed allowed = allowed_by_rule(given, rule);
    std::vector<Outlier<dim>> outliers;
    for (std::size_t i = 0; i < given.families.size(); ++i)
    {
      const Bond<dim> *const first = given.families[i].bonds.data();
      for_both(given.families[i], rule.families[i],
               [&](const Bond<dim> *own, const Bond<dim> *right, std::size_t j)
               {
                 if (!(own && right) && is_at_horizon(given, (own ? own : right)->xi))
                   return; // see missing_at_horizon
                 const double volume = given.volumes[j];
                 Outlier<dim> one{Defect::weight, i, j,
                                  own ? static_cast<std::size_t>(own - first) : Outlier<dim>::none};
                 one.found = own ? own->weight : 0;
                 one.expected = right ? right->weight : 0;
                 one.distance = std::abs(one.found - one.expected) /
                                (allowed.weight * volume * std::abs(rule.factor));
                 if (one.distance > 1)
                 {
                   one.defect = !own ? Defect::missing : !right ? Defect::spurious : Defect::weight;
                   outliers.push_back(one);
                 }
                 if (!own || !right || !rule.has_kernel_points)
                   return;
                 one.found_point = own->kernel_point;
                 one.expected_point = right->kernel_point;
                 one.distance = one.found_point.distance(one.expected_point) /
                                (allowed.point * cell_size<dim>(volume));
                 one.defect = Defect::kernel_point;
                 if (one.distance > 1)
                   outliers.push_back(one);
               });
    }
    return outliers;
  }

  template std::vector<Outlier<2>> compare_with_rule(const GivenBonds<2> &, const Recognised<2> &);
  template std::vector<Outlier<3>> compare_with_rule(const GivenBonds<3> &, const Recognised<3> &);
} // namespace plumbline::meshfree
