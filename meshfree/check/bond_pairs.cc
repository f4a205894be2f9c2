#include "meshfree/check/bond_pairs.h"

#include "meshfree/check/sizes.h"
#include "meshfree/rules/families.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// The length that all bonds but one in a hundred have at most, with half a node's size.
    template <int dim>
    double reach_of(const GivenBonds<dim> &given)
    {
      std::vector<double> lengths;
      for (const Family<dim> &family : given.families)
        for (const Bond<dim> &bond : family.bonds)
          lengths.push_back(bond.xi.norm());
      if (lengths.empty())
        return given.kernel.horizon();
      const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(.99 * (lengths.size() - 1.));
      std::nth_element(lengths.begin(), at, lengths.end());
      return *at + .5 * node_size(given);
    }
  } // namespace

  template <int dim>
  double node_size(const GivenBonds<dim> &given)
  {
    double area = 0;
    for (std::size_t i = 0; i < given.families.size(); ++i)
      area += given.cells.area[i];
    return cell_size<dim>(area / static_cast<double>(given.families.size()));
  }

  template <int dim>
  std::vector<Pair<dim>> all_pairs(const GivenBonds<dim> &given)
  {
    std::vector<typename geometry::BoxSearch<dim>::Box> places;
    for (const Point<dim> &x : given.cells.nodes)
      places.push_back({x, x});
    const geometry::BoxSearch<dim> search(places);
    const double reach = reach_of(given);
    std::vector<Pair<dim>> pairs;
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < given.families.size(); ++i)
    {
      const Family<dim> &family = given.families[i];
      const Point<dim> &x = given.cells.nodes[i];
      search.find(box_around(x, reach), near);
      std::size_t k = 0;
      const auto add_bonds_before = [&](std::size_t j)
      {
        for (; k < family.bonds.size() && family.neighbours[k] < j; ++k)
          pairs.push_back({i, family.neighbours[k], k, family.bonds[k].xi});
      };
      for (const unsigned int j : near)
      {
        add_bonds_before(j);
        const Point<dim> xi(given.cells.nodes[j] - x);
        const bool has_bond = k < family.bonds.size() && family.neighbours[k] == j;
        if (has_bond)
          pairs.push_back({i, j, k++, xi});
        else if (j != i && xi.norm() <= reach)
          pairs.push_back({i, j, Outlier<dim>::none, xi});
      }
      add_bonds_before(given.cells.size());
    }
    return pairs;
  }

  template <int dim>
  std::vector<double> weights_over_volumes(const GivenBonds<dim> &given,
                                           const std::vector<Pair<dim>> &pairs)
  {
    std::vector<double> values;
    for (const Pair<dim> &pair : pairs)
      values.push_back(pair.bond == Outlier<dim>::none
                           ? 0
                           : bond_of(given, pair).weight / given.volumes[pair.neighbour]);
    return values;
  }

  template double node_size(const GivenBonds<2> &);
  template std::vector<Pair<2>> all_pairs(const GivenBonds<2> &);
  template std::vector<double> weights_over_volumes(const GivenBonds<2> &,
                                                    const std::vector<Pair<2>> &);
  template double node_size(const GivenBonds<3> &);
  template std::vector<Pair<3>> all_pairs(const GivenBonds<3> &);
  template std::vector<double> weights_over_volumes(const GivenBonds<3> &,
                                                    const std::vector<Pair<3>> &);
} // namespace plumbline::meshfree
