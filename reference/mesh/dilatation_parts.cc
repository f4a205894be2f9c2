#include "reference/mesh/dilatation_parts.h"

#include "reference/mesh/rows.h"

#include <algorithm>

namespace plumbline::reference
{
  DilatationParts::DilatationParts(const MeshSpace &space, const std::vector<OuterCell> &outer,
                                   const Translations &translations,
                                   const std::vector<Point<2>> &units, const DilatationRow &row)
      : translations_(translations), n_values_(2 * space.shapes().size()), n_points_(units.size())
  {
    if (!translations.has_few_shapes() || !row.is_geometry_alone())
      return;
    std::vector<std::pair<std::size_t, std::size_t>> first;
    std::size_t n_pairs = 0;
    for (const OuterCell &cell : outer)
      for (const unsigned int near : cell.near)
      {
        ++n_pairs;
        if (place_.try_emplace(translations.pair(cell.cell, near), first.size()).second)
          first.emplace_back(cell.cell, near);
      }
    const std::size_t of_pair = n_points_ * n_values_;
    constexpr std::size_t often = 4, most = 1 << 25; // repetitions that pay, numbers in all
    if (first.size() * often > n_pairs || first.size() * of_pair > most)
      return;
    values_.resize(first.size() * of_pair);
    constexpr unsigned int grain = 8;
    in_parallel(
        first.size(),
        [&](std::size_t from, std::size_t to)
        {
          DilatationRow own = row;
          for (std::size_t k = from; k < to; ++k)
            for (std::size_t q = 0; q < n_points_; ++q)
            {
              const Point<2> x = space.map(first[k].first).point(units[q]);
              const std::vector<double> &part = own.integrate(x, first[k].second);
              std::copy(part.begin(), part.end(), &values_[k * of_pair + q * n_values_]);
            }
        },
        grain);
  }

  void DilatationParts::find(const OuterCell &outer, std::vector<const double *> &known) const
  {
    known.clear();
    for (const unsigned int near : outer.near)
      known.push_back(
          &values_[place_.at(translations_.pair(outer.cell, near)) * n_points_ * n_values_]);
  }
} // namespace plumbline::reference
