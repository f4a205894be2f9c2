#include "reference/mesh_assembly.h"

#include "reference/number_set.h"
#include "reference/pair_quadrature.h"
#include "reference/rectangle_pairs.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <mutex>

namespace plumbline::reference
{
  namespace
  {
    /// Whether pairs of these two cells take their outer points on the first: a cell of Ω before
    /// one of the collar, a smaller one before a larger, else the first in number.
    bool is_outer(const geometry::Mesh &mesh, const MeshCells &cells, std::size_t a, std::size_t b)
    {
      if (mesh.cells[a].is_inside != mesh.cells[b].is_inside)
        return mesh.cells[a].is_inside;
      const double ratio = cells.area(a) / cells.area(b);
      constexpr double clearly = 1e-6;
      return ratio < 1 - clearly || (ratio <= 1 + clearly && a <= b);
    }

    /// Blocks of pairs of cells by whichever way is exact.
    class PairIntegrator
    {
    public:
      PairIntegrator(const MeshSpace &space, const MeshCells &cells, const RadialProfile &profile,
                     double horizon, const std::optional<physics::Coefficient> &coefficient,
                     const AssemblyOptions &options)
          : cells_(cells), by_quadrature_(space, cells, profile, horizon, coefficient,
                                          options.refinement, options.backend)
      {
        if (options.exact_rectangles && !coefficient && space.shapes().n_vertices() == 4)
          by_correlation_.emplace(space.shapes(), profile, horizon, options.backend);
      }

      bool is_exact(std::size_t a, std::size_t b) const
      {
        return by_correlation_ && cells_.is_rectangle(a) && cells_.is_rectangle(b);
      }

      void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks)
      {
        if (is_exact(outer, inner))
          by_correlation_->integrate(cells_[outer].box(), cells_[inner].box(), blocks);
        else
          by_quadrature_.integrate(outer, inner, blocks);
      }

    private:
      const MeshCells &cells_;
      PairQuadrature by_quadrature_;
      std::optional<RectanglePairs> by_correlation_;
    };

    /// Visit 0 ... n - 1, threads sharing them in ranges. @param action  takes a range [first,
    /// last)
    template <class Action>
    void in_parallel(std::size_t n, const Action &action, unsigned int grain = 256)
    {
      dealii::parallel::apply_to_subranges(static_cast<std::size_t>(0), n, action, grain);
    }

    /// The pairs of an outer cell.
    struct CellPairs
    {
      std::vector<unsigned int> partners; ///< ascending, the cell itself is one
      std::vector<unsigned int> columns;  ///< dofs of all of them, ascending
    };

    /// Of each cell the pairs that have their outer points on it, for a share of the cells. A
    /// partner of another share is paired with itself: it still takes a diagonal block.
    std::vector<CellPairs> find_pairs(const MeshSpace &space, const MeshCells &cells,
                                      double horizon, const std::vector<std::size_t> &outer_cells)
    {
      const geometry::Mesh &mesh = space.mesh();
      std::vector<CellPairs> pairs(cells.size());
      in_parallel(outer_cells.size(),
                  [&](std::size_t first, std::size_t last)
                  {
                    std::vector<unsigned int> near;
                    NumberSet columns(space.n_dofs());
                    for (std::size_t i = first; i < last; ++i)
                    {
                      const std::size_t cell = outer_cells[i];
                      CellPairs &own = pairs[cell];
                      cells.find_near(cell, horizon, near);
                      std::copy_if(near.begin(), near.end(), std::back_inserter(own.partners),
                                   [&](unsigned int other)
                                   { return is_outer(mesh, cells, cell, other); });
                      for (const unsigned int partner : own.partners)
                        for (unsigned int b = 0; b < space.shapes().size(); ++b)
                          columns.insert(space.dofs(partner)[b]);
                      columns.take(own.columns);
                    }
                  });
      for (const std::size_t cell : outer_cells)
        for (const unsigned int partner : pairs[cell].partners)
          if (CellPairs &other = pairs[partner];
              other.partners.empty() && mesh.cells[partner].is_inside)
          {
            other.partners = {partner};
            other.columns.assign(space.dofs(partner), space.dofs(partner) + space.shapes().size());
            std::sort(other.columns.begin(), other.columns.end());
          }
      return pairs;
    }

    /// What the pairs of one outer cell add: its rows, and diagonal blocks of its partners.
    struct CellRows
    {
      std::size_t cell;
      std::vector<double> values;   ///< shape (n_shapes, n_columns, n_entries)
      std::vector<double> diagonal; ///< of each partner, shape (n_shapes, n_shapes, n_entries)
      bool is_exact;
    };

    /// A worker's own memory.
    struct Scratch
    {
      PairIntegrator integrator;
      PairBlocks blocks;
      std::vector<unsigned int> slot; ///< of each dof among the columns
    };

    /// Sums of all cells: rows by scalar dofs with n_entries values a column, and diagonal blocks.
    class Accumulator
    {
    public:
      Accumulator(const MeshSpace &space, unsigned int n_entries,
                  const std::vector<CellPairs> &pairs);

      void add(const CellRows &part);

      /// U + Uᵀ + diagonal blocks on the free rows, components interleaved.
      algebra::Rows combine(unsigned int n_components);

      bool is_exact = true;

    private:
      void make_pattern();
      void scatter_diagonal();
      algebra::Rows combine_rows(std::size_t first, std::size_t last,
                                 unsigned int n_components) const;

      const MeshSpace &space_;
      unsigned int n_entries_;
      const std::vector<CellPairs> &pairs_; ///< not needed after the last add
      std::vector<std::size_t> start_;      ///< of each dof's row
      std::vector<unsigned int> column_;
      std::vector<double> value_;    ///< shape (column_.size(), n_entries)
      std::vector<double> diagonal_; ///< of each cell
    };

    Accumulator::Accumulator(const MeshSpace &space, unsigned int n_entries,
                             const std::vector<CellPairs> &pairs)
        : space_(space), n_entries_(n_entries), pairs_(pairs)
    {
      make_pattern();
      const unsigned int n = space.shapes().size();
      value_.assign(column_.size() * n_entries, 0.);
      diagonal_.assign(pairs.size() * n * n * n_entries, 0.);
    }

    /// A row's columns: those of all cells that the dof belongs to.
    void Accumulator::make_pattern()
    {
      const unsigned int n = space_.shapes().size();
      const std::size_t n_dofs = space_.n_dofs();
      std::vector<std::vector<unsigned int>> around(n_dofs), columns(n_dofs);
      for (std::size_t cell = 0; cell < pairs_.size(); ++cell)
        for (unsigned int a = 0; a < n && !pairs_[cell].partners.empty(); ++a)
          around[space_.dofs(cell)[a]].push_back(static_cast<unsigned int>(cell));
      in_parallel(n_dofs,
                  [&](std::size_t first, std::size_t last)
                  {
                    NumberSet set(n_dofs);
                    for (std::size_t row = first; row < last; ++row)
                    {
                      for (const unsigned int cell : around[row])
                        for (const unsigned int column : pairs_[cell].columns)
                          set.insert(column);
                      set.take(columns[row]);
                    }
                  });
      start_.assign(1, 0);
      for (const auto &row : columns)
        start_.push_back(start_.back() + row.size());
      column_.resize(start_.back());
      in_parallel(n_dofs,
                  [&](std::size_t first, std::size_t last)
                  {
                    for (std::size_t row = first; row < last; ++row)
                      std::copy(columns[row].begin(), columns[row].end(),
                                column_.data() + start_[row]);
                  });
    }

    void Accumulator::add(const CellRows &part)
    {
      const CellPairs &pairs = pairs_[part.cell];
      const unsigned int n = space_.shapes().size();
      const double *from = part.values.data();
      for (unsigned int a = 0; a < n; ++a)
      {
        std::size_t k = start_[space_.dofs(part.cell)[a]];
        for (const unsigned int column : pairs.columns)
        {
          while (column_[k] != column)
            ++k;
          for (unsigned int e = 0; e < n_entries_; ++e)
            value_[k * n_entries_ + e] += *from++;
        }
      }
      const std::size_t block = static_cast<std::size_t>(n) * n * n_entries_;
      from = part.diagonal.data();
      for (const unsigned int partner : pairs.partners)
        for (std::size_t k = 0; k < block; ++k)
          diagonal_[partner * block + k] += *from++;
      is_exact = is_exact && part.is_exact;
    }

    /// Diagonal blocks are symmetric, so half of them into U gives all of them in U + Uᵀ.
    void Accumulator::scatter_diagonal()
    {
      const unsigned int n = space_.shapes().size();
      const double *from = diagonal_.data();
      for (std::size_t cell = 0; cell < space_.mesh().cells.size(); ++cell)
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b, from += n_entries_)
          {
            const unsigned int row = space_.dofs(cell)[a], column = space_.dofs(cell)[b];
            const auto end = column_.begin() + static_cast<std::ptrdiff_t>(start_[row + 1]);
            const auto at = std::lower_bound(
                column_.begin() + static_cast<std::ptrdiff_t>(start_[row]), end, column);
            if (at == end || *at != column)
              continue; // a row of the collar
            for (unsigned int e = 0; e < n_entries_; ++e)
              value_[(at - column_.begin()) * n_entries_ + e] += .5 * from[e];
          }
    }

    /// Free rows first ... last - 1 of U + Uᵀ.
    algebra::Rows Accumulator::combine_rows(std::size_t first, std::size_t last,
                                            unsigned int n_components) const
    {
      // of each row those whose columns hold it, and where
      struct Entry
      {
        unsigned int row;
        std::size_t at;
      };
      std::vector<std::vector<Entry>> transposed(last - first);
      for (std::size_t row = 0; row < space_.n_dofs(); ++row)
      {
        const unsigned int *const end = column_.data() + start_[row + 1];
        for (const unsigned int *column =
                 std::lower_bound(column_.data() + start_[row], end, first);
             column != end && *column < last; ++column)
          transposed[*column - first].push_back(
              {static_cast<unsigned int>(row), static_cast<std::size_t>(column - column_.data())});
      }

      algebra::Rows rows;
      rows.start.assign(1, 0);
      std::vector<unsigned int> columns;
      std::vector<double> values;
      for (std::size_t row = first; row < last; ++row)
      {
        columns.clear();
        values.clear();
        std::size_t k = start_[row];
        auto entry = transposed[row - first].cbegin();
        while (k < start_[row + 1] || entry != transposed[row - first].cend())
        {
          const unsigned int from_u = k < start_[row + 1] ? column_[k] : -1u;
          const unsigned int from_t = entry != transposed[row - first].cend() ? entry->row : -1u;
          columns.push_back(std::min(from_u, from_t));
          for (unsigned int e = 0; e < n_entries_; ++e)
            values.push_back((from_u <= from_t ? value_[k * n_entries_ + e] : 0) +
                             (from_t <= from_u ? value_[entry->at * n_entries_ + e] : 0));
          k += from_u <= from_t ? 1 : 0;
          entry += from_t <= from_u ? 1 : 0;
        }
        for (unsigned int c = 0; c < n_components; ++c)
        {
          for (std::size_t i = 0; i < columns.size(); ++i)
            for (unsigned int d = 0; d < n_components; ++d)
            {
              rows.column.push_back(columns[i] * n_components + d);
              rows.value.push_back(values[i * n_entries_ + (n_entries_ == 1 ? 0 : c + d)]);
            }
          rows.start.push_back(rows.column.size());
        }
      }
      return rows;
    }

    algebra::Rows Accumulator::combine(unsigned int n_components)
    {
      scatter_diagonal();
      // few parts, since each looks at all rows for what is transposed into it
      constexpr std::size_t n_parts = 16;
      const auto bound = [&](std::size_t part) { return space_.n_free() * part / n_parts; };
      std::vector<algebra::Rows> parts(n_parts);
      in_parallel(
          n_parts,
          [&](std::size_t first, std::size_t last)
          {
            for (std::size_t i = first; i < last; ++i)
              parts[i] = combine_rows(bound(i), bound(i + 1), n_components);
          },
          1);

      algebra::Rows rows;
      rows.start.assign(1, 0);
      for (const algebra::Rows &part : parts)
        for (std::size_t i = 0; i < part.n_rows(); ++i)
          rows.start.push_back(rows.start.back() + part.start[i + 1] - part.start[i]);
      rows.column.resize(rows.start.back());
      rows.value.resize(rows.start.back());
      in_parallel(
          n_parts,
          [&](std::size_t first, std::size_t last)
          {
            for (std::size_t i = first; i < last; ++i)
            {
              const std::size_t to = rows.start[bound(i) * n_components];
              std::copy(parts[i].column.begin(), parts[i].column.end(), rows.column.data() + to);
              std::copy(parts[i].value.begin(), parts[i].value.end(), rows.value.data() + to);
              parts[i] = {};
            }
          },
          1);
      return rows;
    }

    /// All pairs of a cell.
    void integrate_cell(const MeshSpace &space, const CellPairs &pairs, unsigned int n_entries,
                        std::size_t cell, Scratch &scratch, CellRows &part)
    {
      const unsigned int n = space.shapes().size();
      const std::size_t block = static_cast<std::size_t>(n) * n * n_entries;
      const std::size_t n_columns = pairs.columns.size();
      part.cell = cell;
      part.is_exact = true;
      for (unsigned int k = 0; k < n_columns; ++k)
        scratch.slot[pairs.columns[k]] = k;
      part.values.assign(n * n_columns * n_entries, 0.);
      part.diagonal.assign(pairs.partners.size() * block, 0.);

      const std::size_t own = static_cast<std::size_t>(
          std::lower_bound(pairs.partners.begin(), pairs.partners.end(), cell) -
          pairs.partners.begin());
      PairBlocks &blocks = scratch.blocks;
      for (std::size_t i = 0; i < pairs.partners.size(); ++i)
      {
        const unsigned int partner = pairs.partners[i];
        scratch.integrator.integrate(cell, partner, blocks);
        part.is_exact = part.is_exact && scratch.integrator.is_exact(cell, partner);
        // the cell with itself: both orders are the same pair, each counts half
        const double factor = i == own ? .5 : 1;
        for (std::size_t k = 0; k < block; ++k)
        {
          part.diagonal[own * block + k] += factor * blocks.outer[k];
          part.diagonal[i * block + k] += factor * blocks.inner[k];
        }
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            const std::size_t slot = scratch.slot[space.dofs(partner)[b]];
            for (unsigned int e = 0; e < n_entries; ++e)
              part.values[(a * n_columns + slot) * n_entries + e] -=
                  factor * blocks.cross[(a * n + b) * n_entries + e];
          }
      }
    }
  } // namespace

  MeshMatrix assemble(const MeshSpace &space, const MeshCells &cells,
                      const physics::Kernel<2> &kernel,
                      const std::optional<physics::Coefficient> &coefficient,
                      const AssemblyOptions &options, const base::Team &team)
  {
    const RadialProfile profile(kernel);
    std::vector<std::size_t> outer_cells;
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      if (space.mesh().cells[cell].is_inside)
        outer_cells.push_back(cell);
    const auto [first, last] = team.share(outer_cells.size());
    outer_cells = {outer_cells.begin() + static_cast<std::ptrdiff_t>(first),
                   outer_cells.begin() + static_cast<std::ptrdiff_t>(last)};

    std::vector<CellPairs> pairs = find_pairs(space, cells, kernel.horizon(), outer_cells);
    Accumulator sum(space, profile.n_entries(), pairs);
    const Scratch scratch{
        PairIntegrator(space, cells, profile, kernel.horizon(), coefficient, options),
        {},
        std::vector<unsigned int>(space.n_dofs())};
    // an exception must not leave a thread: the first one is kept and thrown at the end
    std::exception_ptr failure;
    std::mutex mutex;
    dealii::WorkStream::run(
        outer_cells.begin(), outer_cells.end(),
        [&](const std::vector<std::size_t>::iterator &cell, Scratch &own, CellRows &part)
        {
          try
          {
            integrate_cell(space, pairs[*cell], profile.n_entries(), *cell, own, part);
          }
          catch (...)
          {
            const std::lock_guard<std::mutex> lock(mutex);
            if (!failure)
              failure = std::current_exception();
          }
        },
        [&](const CellRows &part)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          if (!failure)
            sum.add(part);
        },
        scratch, CellRows());
    if (failure)
      std::rethrow_exception(failure);
    pairs = {};
    return {sum.combine(kernel.n_components()), sum.is_exact};
  }
} // namespace plumbline::reference
