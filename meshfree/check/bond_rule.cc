#include "meshfree/check/bond_rule.h"

#include "base/error.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/lattice_families.h"
#include "meshfree/check/sizes.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    NeighbourhoodQuadrature<dim> quadrature_of(const Rule &rule, const Kernel<dim> &kernel)
    {
      if constexpr (dim == 2)
        return rule.in_plane(kernel);
      else
        return rule.in_space(kernel);
    }

    /// The factor between the weights of most bonds.
    template <int dim>
    double common_factor(const std::vector<Family<dim>> &given,
                         const std::vector<Family<dim>> &rule)
    {
      constexpr double small = .1; // weights of which say little
      std::vector<double> ratios;
      for (std::size_t i = 0; i < given.size(); ++i)
        for_both(given[i], rule[i],
                 [&](const Bond<dim> *a, const Bond<dim> *b, std::size_t)
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

    template <int dim>
    Agreement agreement(const GivenBonds<dim> &given, const std::vector<Family<dim>> &rule,
                        double factor)
    {
      const Precision &precision = given.precision;
      Agreement result;
      for (std::size_t i = 0; i < rule.size(); ++i)
        for_both(given.families[i], rule[i],
                 [&](const Bond<dim> *a, const Bond<dim> *b, std::size_t)
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
                                 file_tolerance * cell_size<dim>(volume) + 4 * precision.length
                             ? 1
                             : 0;
                 });
      return result;
    }

    /// What rules make of given nodes and volumes, node by node.
    template <int dim>
    class RuleFamilies
    {
    public:
      /// @throws NumericalError  on a lattice, as Families::make
      RuleFamilies(const Rule &rule, const GivenBonds<dim> &given) : cells_(given.cells)
      {
        const NeighbourhoodQuadrature<dim> quadrature = quadrature_of(rule, given.kernel);
        if (given.lattice > 0)
        {
          lattice_.emplace(quadrature, given.kernel, given.cells, given.lattice);
          return;
        }
        cells_.area = given.volumes;
        families_.emplace(quadrature, given.kernel, cells_, Backend::fast);
      }

      Family<dim> family(std::size_t node) const
      {
        if (lattice_)
          return lattice_->family(node);
        Family<dim> result;
        families_->make(node, result);
        return result;
      }

    private:
      geometry::NodeCells<dim> cells_;
      std::optional<LatticeFamilies<dim>> lattice_;
      std::optional<Families<dim>> families_;
    };

    template <int dim>
    std::vector<Family<dim>> families_of(const Rule &rule, const GivenBonds<dim> &given)
    {
      const RuleFamilies<dim> families(rule, given);
      std::vector<Family<dim>> result;
      for (std::size_t i = 0; i < given.cells.n_free; ++i)
        result.push_back(families.family(i));
      return result;
    }

    /// Whether the weights of some nodes may be the rule's.
    template <int dim>
    bool is_likely(const Rule &rule, const GivenBonds<dim> &given)
    {
      constexpr std::size_t n_sample = 60;
      constexpr double half = .5;
      const std::size_t n = given.families.size();
      if (n <= 2 * n_sample)
        return true;
      const RuleFamilies<dim> families(rule, given);
      std::vector<Family<dim>> own, other;
      for (std::size_t k = 0; k < n_sample; ++k)
      {
        own.push_back(given.families[k * n / n_sample]);
        other.push_back(families.family(k * n / n_sample));
      }
      const double factor = common_factor(own, other);
      if (factor == 0)
        return false;
      const GivenBonds<dim> sample{own,           given.kernel,    given.cells,
                                   given.volumes, given.precision, given.origin};
      const Agreement found = agreement(sample, other, factor);
      return static_cast<double>(found.n_weights) > half * static_cast<double>(found.n_bonds);
    }
  } // namespace

  template <int dim>
  bool is_at_horizon(const GivenBonds<dim> &given, const Point<dim> &xi)
  {
    const double horizon = given.kernel.horizon();
    return std::abs(xi.norm() - horizon) <=
           std::max(tie_tolerance * horizon, 4 * given.precision.length);
  }

  template <int dim>
  std::vector<Family<dim>> rule_families(const std::string &name, const GivenBonds<dim> &given)
  {
    return families_of(find_rule(name, "rule"), given);
  }

  template <int dim>
  bool Recognised<dim>::is_full_area() const
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

  template <int dim>
  std::optional<Recognised<dim>> recognise(const GivenBonds<dim> &given)
  {
    constexpr double enough = .9;
    if (dim == 3 && given.lattice == 0 && given.cells.pieces.empty())
      return {}; // there are no cells
    std::vector<Rule> candidates = rules();
    candidates.insert(candidates.end(), rules_on_request().begin(), rules_on_request().end());
    std::optional<Recognised<dim>> best;
    std::size_t best_score = 0;
    const bool is_tensor = given.kernel.n_components() > 1;
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&](const Rule &rule) {
                                      return (is_tensor && rule.is_scalar) ||
                                             (dim == 3 && !rule.in_space);
                                    }),
                     candidates.end());
    for (const Rule &rule : candidates)
      try
      {
        if (!is_likely(rule, given))
          continue;
        std::vector<Family<dim>> families = families_of(rule, given);
        const double factor = common_factor(given.families, families);
        if (factor == 0)
          continue;
        const Agreement found = agreement(given, families, factor);
        const double wanted = enough * static_cast<double>(found.n_bonds);
        const std::size_t score = found.n_weights + found.n_points;
        if (static_cast<double>(found.n_weights) < wanted || score <= best_score)
          continue;
        best_score = score;
        for (Family<dim> &family : families)
          for (Bond<dim> &bond : family.bonds)
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

  template struct Recognised<2>;
  template bool is_at_horizon(const GivenBonds<2> &, const Point<2> &);
  template std::vector<Family<2>> rule_families(const std::string &, const GivenBonds<2> &);
  template std::optional<Recognised<2>> recognise(const GivenBonds<2> &);
  template struct Recognised<3>;
  template bool is_at_horizon(const GivenBonds<3> &, const Point<3> &);
  template std::vector<Family<3>> rule_families(const std::string &, const GivenBonds<3> &);
  template std::optional<Recognised<3>> recognise(const GivenBonds<3> &);
} // namespace plumbline::meshfree
