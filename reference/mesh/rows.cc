#include "reference/mesh/rows.h"

#include "reference/mesh/number_set.h"

#include <algorithm>

namespace plumbline::reference
{
  MeshRows::MeshRows(const MeshSpace &space, unsigned int n_entries,
                     const std::vector<CellPairs> &pairs)
      : space_(space), n_entries_(n_entries), pairs_(pairs)
  {
    make_pattern();
    const unsigned int n = space.shapes().size();
    value_.assign(column_.size() * n_entries, 0.);
    diagonal_.assign(pairs.size() * n * n * n_entries, 0.);
  }

  /// A row's columns: those of all cells that the dof belongs to.
  void MeshRows::make_pattern()
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

  void MeshRows::add(const CellRows &part)
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
  void MeshRows::scatter_diagonal()
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
  algebra::CsrMatrix MeshRows::combine_rows(std::size_t first, std::size_t last,
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
      for (const unsigned int *column = std::lower_bound(column_.data() + start_[row], end, first);
           column != end && *column < last; ++column)
        transposed[*column - first].push_back(
            {static_cast<unsigned int>(row), static_cast<std::size_t>(column - column_.data())});
    }

    algebra::CsrMatrix rows;
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

  algebra::CsrMatrix MeshRows::combine(unsigned int n_components)
  {
    scatter_diagonal();
    // few parts, since each looks at all rows for what is transposed into it
    constexpr std::size_t n_parts = 16;
    const auto bound = [&](std::size_t part) { return space_.n_free() * part / n_parts; };
    std::vector<algebra::CsrMatrix> parts(n_parts);
    in_parallel(
        n_parts,
        [&](std::size_t first, std::size_t last)
        {
          for (std::size_t i = first; i < last; ++i)
            parts[i] = combine_rows(bound(i), bound(i + 1), n_components);
        },
        1);

    algebra::CsrMatrix rows;
    rows.start.assign(1, 0);
    for (const algebra::CsrMatrix &part : parts)
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
} // namespace plumbline::reference
