#include "meshfree/check/bond_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plumbline::meshfree
{
  namespace
  {
    /// Smaller factors are how rules treat nodes that are larger than others or near the horizon of
    /// many: up to 1.1 for the rules of ours on nodes moved by .3 h.
    constexpr double least = .25;

    /// Of weights over volumes to what is usual of such bonds, where that is much the same for
    /// shorter and longer ones; one for each pair, not finite where there is none.
    template <int dim>
    std::vector<double> ratios(const GivenBonds<dim> &given, const std::vector<Pair<dim>> &pairs,
                               const BondProfile &profile)
    {
      constexpr double steep = .2; // usual weights change by more over half a node's size
      std::vector<double> values = weights_over_volumes(given, pairs);
      const auto usual = profile.usual(values, given.precision.weight);
      for (std::size_t k = 0; k < pairs.size(); ++k)
      {
        const double middle = .5 * (usual[k].low + usual[k].high);
        const bool is_flat = usual[k].high - usual[k].low < steep * std::abs(middle);
        values[k] = is_flat && pairs[k].bond != Outlier<dim>::none
                        ? values[k] / middle
                        : std::numeric_limits<double>::quiet_NaN();
      }
      return values;
    }

    /// The median of each node that has enough bonds.
    template <int dim>
    std::map<std::size_t, double> medians(const std::vector<Pair<dim>> &pairs,
                                          const std::vector<double> &ratios, bool is_to)
    {
      constexpr std::size_t few = 4;
      std::map<std::size_t, std::vector<double>> ratios_of;
      for (std::size_t k = 0; k < pairs.size(); ++k)
        if (std::isfinite(ratios[k]))
          ratios_of[is_to ? pairs[k].neighbour : pairs[k].node].push_back(ratios[k]);
      std::map<std::size_t, double> result;
      for (const auto &[node, own] : ratios_of)
        if (own.size() >= few)
          result[node] = spread_of(own).median;
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<Outlier<dim>> find_scaled_nodes(const GivenBonds<dim> &given,
                                              const std::vector<Pair<dim>> &pairs,
                                              const BondProfile &profile)
  {
    std::vector<Outlier<dim>> outliers;
    const std::vector<double> all = ratios(given, pairs, profile);
    for (const bool is_to : {true, false})
    {
      const auto median_of = medians(pairs, all, is_to);
      std::vector<double> values;
      for (const auto &[node, median] : median_of)
        values.push_back(median);
      const Spread spread = spread_of(values);
      for (const auto &[node, median] : median_of)
        if (const double away =
                std::abs(median - spread.median) / spread.allowed(least * std::abs(spread.median));
            away > 1 && median != 0)
        {
          Outlier<dim> one{is_to ? Defect::neighbour : Defect::family, node};
          one.found = median / spread.median;
          one.expected = 1;
          one.distance = away;
          outliers.push_back(one);
        }
    }
    return outliers;
  }

  template <int dim>
  std::vector<Family<dim>> without_factors(std::vector<Family<dim>> families,
                                           const std::vector<Outlier<dim>> &scaled)
  {
    for (const Outlier<dim> &one : scaled)
      for (std::size_t i = 0; i < families.size(); ++i)
        for (std::size_t k = 0; k < families[i].bonds.size(); ++k)
          if (one.node == (one.defect == Defect::family ? i : families[i].neighbours[k]))
            families[i].bonds[k].weight /= one.found;
    return families;
  }

  template std::vector<Outlier<2>>
  find_scaled_nodes(const GivenBonds<2> &, const std::vector<Pair<2>> &, const BondProfile &);
  template std::vector<Family<2>> without_factors(std::vector<Family<2>>,
                                                  const std::vector<Outlier<2>> &);
  template std::vector<Outlier<3>>
  find_scaled_nodes(const GivenBonds<3> &, const std::vector<Pair<3>> &, const BondProfile &);
  template std::vector<Family<3>> without_factors(std::vector<Family<3>>,
                                                  const std::vector<Outlier<3>> &);
} // namespace plumbline::meshfree
