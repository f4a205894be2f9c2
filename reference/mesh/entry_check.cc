#include "reference/mesh/entry_check.h"

#include "reference/mesh/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace plumbline::reference
{
  namespace
  {
    /// A cell and which of its shape functions is meant.
    struct Place
    {
      std::size_t cell;
      unsigned int shape;
    };

    std::vector<Place> places(const MeshSpace &space, std::size_t dof)
    {
      std::vector<Place> result;
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
        for (unsigned int a = 0; a < space.shapes().size(); ++a)
          if (space.dofs(cell)[a] == dof)
            result.push_back({cell, a});
      return result;
    }

    bool share_cell(const std::vector<Place> &a, const std::vector<Place> &b)
    {
      return std::any_of(a.begin(), a.end(),
                         [&](const Place &of_a)
                         {
                           return std::any_of(b.begin(), b.end(),
                                              [&](const Place &of_b)
                                              { return of_a.cell == of_b.cell; });
                         });
    }

    bool is_served(const MeshSpace &space)
    {
      constexpr unsigned int highest_degree = 2;
      if (space.shapes().degree() > highest_degree)
        return false;
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
        if (space.shapes().degree() > 0 && !space.map(cell).is_affine())
          return false;
      return true;
    }

    double mean(const MeshCells &cells, const std::optional<physics::Coefficient> &coefficient,
                std::size_t a, std::size_t b)
    {
      if (!coefficient)
        return 1;
      const auto at = [&](std::size_t cell)
      { return coefficient->at(cells.part(cells.first_part(cell)).moments().centroid); };
      return coefficient->mean(at(a), at(b));
    }
  } // namespace

  EntryCheck check_entries(const MeshSpace &space, const MeshCells &cells,
                           const physics::Kernel<2> &kernel,
                           const std::optional<physics::Coefficient> &coefficient,
                           const algebra::CsrMatrix &rows, unsigned int n_pairs, unsigned int seed)
  {
    EntryCheck check;
    if (!is_served(space))
      return check;
    const unsigned int nc = kernel.n_components(), n = space.shapes().size(),
                       n_entries = nc == 1 ? 1 : 3;
    double largest = 0;
    for (const double value : rows.value)
      largest = std::max(largest, std::abs(value)); // of positive definite rows: on the diagonal
    std::mt19937 random(seed);
    PairBlocks blocks;
    const auto parts = kernel.parts();             // without breaks
    const unsigned int most_trials = 20 * n_pairs; // most rows have entries apart
    for (unsigned int trial = 0; trial < most_trials && check.n_pairs < n_pairs; ++trial)
    {
      const std::size_t row = random() % rows.n_rows();
      const std::size_t k = rows.start[row] + random() % (rows.start[row + 1] - rows.start[row]);
      const std::size_t column = rows.column[k];
      const auto from = places(space, row / nc), to = places(space, column / nc);
      if (share_cell(from, to))
        continue;
      double value = 0;
      for (const auto &[outer, a] : from)
        for (const auto &[inner, b] : to)
        {
          const double factor = mean(cells, coefficient, outer, inner);
          for (const physics::Kernel<2> &smooth : parts)
            for (std::size_t i = cells.first_part(outer); i < cells.end_of_parts(outer); ++i)
              for (std::size_t j = cells.first_part(inner); j < cells.end_of_parts(inner); ++j)
              {
                integrate_correlation({space, outer, cells.locator().polygon(i)},
                                      {space, inner, cells.locator().polygon(j)}, smooth, blocks);
                value -= factor * blocks.cross[(a * n + b) * n_entries + row % nc + column % nc];
              }
          ++check.n_pairs;
        }
      ++check.n_entries;
      check.worst_difference =
          std::max(check.worst_difference, std::abs(value - rows.value[k]) / largest);
    }
    return check;
  }

  EntryCheck check_entries(const MeshSpace &space, const physics::Kernel<2> &kernel,
                           const std::optional<physics::Coefficient> &coefficient,
                           const algebra::CsrMatrix &rows, unsigned int n_pairs, unsigned int seed)
  {
    return check_entries(space, MeshCells(space.mesh()), kernel, coefficient, rows, n_pairs, seed);
  }
} // namespace plumbline::reference
