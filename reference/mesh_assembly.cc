#include "reference/mesh_assembly.h"

#include "reference/pair_quadrature.h"
#include "reference/rectangle_pairs.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>

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
                                          options.refinement, options.backend),
            takes_rectangles_(options.exact_rectangles && !coefficient)
      {
        if (takes_rectangles_ && space.shapes().n_vertices() == 4)
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
      bool takes_rectangles_;
      std::optional<RectanglePairs> by_correlation_;
    };

    /// What the pairs of one outer cell add: its rows, and diagonal blocks of its partners.
    struct CellRows
    {
      std::size_t cell;
      std::vector<unsigned int> columns; ///< dofs of all its partners, ascending
      std::vector<double> values;        ///< shape (n_shapes, n_columns, n_entries)
      std::vector<unsigned int> partners;
      std::vector<double> diagonal;     ///< of each partner, shape (n_shapes, n_shapes, n_entries)
      std::vector<double> own_diagonal; ///< of the cell, the same shape
      bool is_exact;
    };

    /// A worker's own memory.
    struct Scratch
    {
      PairIntegrator integrator;
      PairBlocks blocks;
      std::vector<unsigned int> slot; ///< of each dof among the columns
    };

    using CellLists = std::vector<std::vector<unsigned int>>; ///< cells near each cell

    /// Visit 0 ... n - 1, threads sharing them in ranges. @param action  takes a range [first,
    /// last)
    template <class Action>
    void in_parallel(std::size_t n, const Action &action)
    {
      constexpr unsigned int grain = 256;
      dealii::parallel::apply_to_subranges(static_cast<std::size_t>(0), n, action, grain);
    }

    /// Of the outer cells all cells near them; of partners whose rows other ranks have, themselves,
    /// since they still take a diagonal block.
    CellLists find_near(const geometry::Mesh &mesh, const MeshCells &cells, double horizon,
                        const std::vector<std::size_t> &outer_cells)
    {
      CellLists near(cells.size());
      in_parallel(outer_cells.size(),
                  [&](std::size_t first, std::size_t last)
                  {
                    for (std::size_t i = first; i < last; ++i)
                      cells.find_near(outer_cells[i], horizon, near[outer_cells[i]]);
                  });
      for (const std::size_t cell : outer_cells)
        for (const unsigned int partner : near[cell])
          if (near[partner].empty() && mesh.cells[partner].is_inside)
            near[partner].push_back(partner);
      return near;
    }

    /// Sums of all cells: rows by scalar dofs with n_entries values a column, and diagonal blocks.
    class Accumulator
    {
    public:
      Accumulator(const MeshSpace &space, unsigned int n_entries, const CellLists &near);

      void add(const CellRows &part);

      /// U + Uᵀ + diagonal blocks on the free rows, components interleaved.
      algebra::Rows combine(unsigned int n_components);

      bool is_exact = true;
      std::uint64_t n_pairs = 0;

    private:
      void make_pattern(const CellLists &near);
      void scatter_diagonal();

      const MeshSpace &space_;
      unsigned int n_entries_;
      std::vector<std::size_t> start_; ///< of each dof's row
      std::vector<unsigned int> column_;
      std::vector<double> value_;    ///< shape (column_.size(), n_entries)
      std::vector<double> diagonal_; ///< of each cell
    };

    Accumulator::Accumulator(const MeshSpace &space, unsigned int n_entries, const CellLists &near)
        : space_(space), n_entries_(n_entries)
    {
      make_pattern(near);
      const unsigned int n = space.shapes().size();
      value_.assign(column_.size() * n_entries, 0.);
      diagonal_.assign(near.size() * n * n * n_entries, 0.);
    }

    /// A row's columns: the dofs of all cells near a cell that the dof belongs to.
    void Accumulator::make_pattern(const CellLists &near)
    {
      const unsigned int n = space_.shapes().size();
      const std::size_t n_dofs = space_.n_dofs();
      CellLists around(n_dofs), columns(n_dofs);
      for (std::size_t cell = 0; cell < near.size(); ++cell)
        for (unsigned int a = 0; a < n && !near[cell].empty(); ++a)
          around[space_.dofs(cell)[a]].push_back(static_cast<unsigned int>(cell));
      in_parallel(n_dofs,
                  [&](std::size_t first, std::size_t last)
                  {
                    std::vector<std::size_t> last_row(n_dofs, n_dofs);
                    for (std::size_t row = first; row < last; ++row)
                    {
                      for (const unsigned int cell : around[row])
                        for (const unsigned int partner : near[cell])
                          for (unsigned int b = 0; b < n; ++b)
                            if (const unsigned int dof = space_.dofs(partner)[b];
                                last_row[dof] != row)
                            {
                              last_row[dof] = row;
                              columns[row].push_back(dof);
                            }
                      std::sort(columns[row].begin(), columns[row].end());
                    }
                  });
      start_.assign(1, 0);
      for (const auto &row : columns)
        start_.push_back(start_.back() + row.size());
      column_.reserve(start_.back());
      for (const auto &row : columns)
        column_.insert(column_.end(), row.begin(), row.end());
    }

    void Accumulator::add(const CellRows &part)
    {
      const unsigned int n = space_.shapes().size();
      const std::size_t block = static_cast<std::size_t>(n) * n * n_entries_;
      for (unsigned int a = 0; a < n; ++a)
      {
        const unsigned int row = space_.dofs(part.cell)[a];
        const double *from = &part.values[a * part.columns.size() * n_entries_];
        std::size_t k = start_[row];
        for (const unsigned int column : part.columns)
        {
          while (column_[k] != column)
            ++k;
          for (unsigned int e = 0; e < n_entries_; ++e)
            value_[k * n_entries_ + e] += *from++;
        }
      }
      for (std::size_t i = 0; i < part.partners.size(); ++i)
        for (std::size_t k = 0; k < block; ++k)
          diagonal_[part.partners[i] * block + k] += part.diagonal[i * block + k];
      for (std::size_t k = 0; k < block; ++k)
        diagonal_[part.cell * block + k] += part.own_diagonal[k];
      is_exact = is_exact && part.is_exact;
      n_pairs += part.partners.size() + 1;
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

    algebra::Rows Accumulator::combine(unsigned int n_components)
    {
      scatter_diagonal();
      const std::size_t n_dofs = space_.n_dofs(), n_free = space_.n_free();

      // Uᵀ of the free rows: for each, who points to it
      std::vector<std::size_t> transposed_start(n_free + 1, 0);
      for (const unsigned int column : column_)
        if (column < n_free)
          ++transposed_start[column + 1];
      std::partial_sum(transposed_start.begin(), transposed_start.end(), transposed_start.begin());
      std::vector<unsigned int> transposed_row(transposed_start.back());
      std::vector<std::size_t> transposed_at(transposed_start.back());
      {
        std::vector<std::size_t> next(transposed_start.begin(), transposed_start.end() - 1);
        for (std::size_t row = 0; row < n_dofs; ++row)
          for (std::size_t k = start_[row]; k < start_[row + 1]; ++k)
            if (column_[k] < n_free)
            {
              transposed_row[next[column_[k]]] = static_cast<unsigned int>(row);
              transposed_at[next[column_[k]]++] = k;
            }
      }

      algebra::Rows rows;
      rows.start.assign(1, 0);
      std::vector<unsigned int> columns;
      std::vector<double> values;
      for (std::size_t row = 0; row < n_free; ++row)
      {
        columns.clear();
        values.clear();
        std::size_t k = start_[row], t = transposed_start[row];
        while (k < start_[row + 1] || t < transposed_start[row + 1])
        {
          const unsigned int from_u = k < start_[row + 1] ? column_[k] : -1u;
          const unsigned int from_t = t < transposed_start[row + 1] ? transposed_row[t] : -1u;
          columns.push_back(std::min(from_u, from_t));
          for (unsigned int e = 0; e < n_entries_; ++e)
            values.push_back((from_u <= from_t ? value_[k * n_entries_ + e] : 0) +
                             (from_t <= from_u ? value_[transposed_at[t] * n_entries_ + e] : 0));
          k += from_u <= from_t ? 1 : 0;
          t += from_t <= from_u ? 1 : 0;
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

    /// All pairs whose outer points are on one cell.
    void integrate_cell(const MeshSpace &space, const MeshCells &cells,
                        const std::vector<unsigned int> &near, unsigned int n_entries,
                        std::size_t cell, Scratch &scratch, CellRows &part)
    {
      const unsigned int n = space.shapes().size();
      const std::size_t block = static_cast<std::size_t>(n) * n * n_entries;
      part.cell = cell;
      part.is_exact = true;
      part.partners.clear();
      part.columns.assign(space.dofs(cell), space.dofs(cell) + n);
      for (const unsigned int partner : near)
        if (partner != cell && is_outer(space.mesh(), cells, cell, partner))
        {
          part.partners.push_back(partner);
          part.columns.insert(part.columns.end(), space.dofs(partner), space.dofs(partner) + n);
        }
      std::sort(part.columns.begin(), part.columns.end());
      part.columns.erase(std::unique(part.columns.begin(), part.columns.end()), part.columns.end());
      for (unsigned int k = 0; k < part.columns.size(); ++k)
        scratch.slot[part.columns[k]] = k;
      part.values.assign(n * part.columns.size() * n_entries, 0.);
      part.diagonal.resize(part.partners.size() * block);

      PairBlocks &blocks = scratch.blocks;
      const auto add_cross = [&](std::size_t partner, double factor)
      {
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            double *to =
                &part.values[(a * part.columns.size() + scratch.slot[space.dofs(partner)[b]]) *
                             n_entries];
            for (unsigned int e = 0; e < n_entries; ++e)
              to[e] += factor * blocks.cross[(a * n + b) * n_entries + e];
          }
      };
      // the cell with itself: both orders are the same pair, each counts half
      scratch.integrator.integrate(cell, cell, blocks);
      part.is_exact = scratch.integrator.is_exact(cell, cell);
      part.own_diagonal.resize(block);
      for (std::size_t k = 0; k < block; ++k)
        part.own_diagonal[k] = .5 * (blocks.outer[k] + blocks.inner[k]);
      add_cross(cell, -.5);
      for (std::size_t i = 0; i < part.partners.size(); ++i)
      {
        scratch.integrator.integrate(cell, part.partners[i], blocks);
        part.is_exact = part.is_exact && scratch.integrator.is_exact(cell, part.partners[i]);
        for (std::size_t k = 0; k < block; ++k)
          part.own_diagonal[k] += blocks.outer[k];
        std::copy(blocks.inner.begin(), blocks.inner.end(),
                  part.diagonal.begin() + static_cast<std::ptrdiff_t>(i * block));
        add_cross(part.partners[i], -1);
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

    CellLists near = find_near(space.mesh(), cells, kernel.horizon(), outer_cells);
    Accumulator sum(space, profile.n_entries(), near);
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
            integrate_cell(space, cells, near[*cell], profile.n_entries(), *cell, own, part);
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
    near.clear();
    near.shrink_to_fit();
    MeshMatrix matrix{sum.combine(kernel.n_components()), sum.is_exact, sum.n_pairs};
    return matrix;
  }
} // namespace plumbline::reference
