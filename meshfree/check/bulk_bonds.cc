#include "meshfree/check/bulk_bonds.h"

#include "meshfree/check/bond_profile.h"
#include "meshfree/rules/families.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  bool BulkBonds::Kind::is_always_there() const
  {
    constexpr double nearly_always = .9;
    return static_cast<double>(n_bonds) >= nearly_always * static_cast<double>(n_pairs);
  }

  BulkBonds::BulkBonds(const GivenWeights<2> &given, const std::vector<char> &is_bulk,
                       double spacing)
      : spacing_(spacing)
  {
    constexpr std::size_t repeats = 2; // bonds of one vector on a lattice, at least
    std::size_t n_bonds = 0;
    std::map<Key, std::size_t> n_of;
    for (std::size_t i = 0; i < is_bulk.size(); ++i)
      if (is_bulk[i] != 0)
        for (const Bond<2> &bond : given.given.families[i].bonds)
        {
          reach_ = std::max(reach_, bond.xi.norm());
          ++n_of[key(bond.xi)];
          ++n_bonds;
        }
    is_lattice_ = n_bonds >= repeats * n_of.size();
    add_pairs(given, is_bulk);
    add_bonds(given, is_bulk, [](std::size_t, std::size_t) { return 1.; });
  }

  BulkBonds BulkBonds::without(const Factor &factor, const GivenWeights<2> &given,
                               const std::vector<char> &is_bulk) const
  {
    BulkBonds result = *this;
    result.add_bonds(given, is_bulk, factor);
    return result;
  }

  BulkBonds::Key BulkBonds::key(const Point<2> &xi) const
  {
    constexpr double same_vector = 1e-3, same_length = .125; // of the spacing
    if (!is_lattice_)
      return {std::llround(xi.norm() / (same_length * spacing_)), 0};
    return {std::llround(xi[0] / (same_vector * spacing_)),
            std::llround(xi[1] / (same_vector * spacing_))};
  }

  void BulkBonds::add_pairs(const GivenWeights<2> &given, const std::vector<char> &is_bulk)
  {
    const std::vector<Point<2>> &nodes = given.cells->nodes;
    std::vector<geometry::Box> boxes;
    for (const Point<2> &x : nodes)
      boxes.push_back({x, x});
    const geometry::BoxSearch<2> search(boxes);
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < is_bulk.size(); ++i)
    {
      if (is_bulk[i] == 0)
        continue;
      search.find(box_around(nodes[i], reach_), near);
      for (const unsigned int j : near)
        if (j != i)
          ++kinds_[key(Point<2>(nodes[j] - nodes[i]))].n_pairs;
    }
  }

  void BulkBonds::add_bonds(const GivenWeights<2> &given, const std::vector<char> &is_bulk,
                            const Factor &factor)
  {
    std::map<Key, std::vector<double>> ratios;
    for (std::size_t i = 0; i < is_bulk.size(); ++i)
      if (is_bulk[i] != 0)
      {
        const Family<2> &family = given.given.families[i];
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          const std::size_t j = family.neighbours[k];
          ratios[key(family.bonds[k].xi)].push_back(family.bonds[k].weight /
                                                    (given.volumes[j] * factor(i, j)));
        }
      }
    for (const auto &[of, values] : ratios)
    {
      const Spread spread = spread_of(values);
      Kind &kind = kinds_[of];
      kind.n_bonds = values.size();
      kind.ratio = spread.median;
      kind.deviation = spread.median == 0
                           ? 0
                           : std::max(spread.deviation, spread.tail) / std::abs(spread.median);
    }
  }

  const BulkBonds::Kind *BulkBonds::find(const Point<2> &xi) const
  {
    const auto found = kinds_.find(key(xi));
    return found == kinds_.end() ? nullptr : &found->second;
  }
} // namespace plumbline::meshfree
