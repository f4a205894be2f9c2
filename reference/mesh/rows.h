#pragma once

#include "algebra/csr_matrix.h"
#include "reference/mesh/space.h"

#include <deal.II/base/parallel.h>

namespace plumbline::reference
{
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
    std::vector<unsigned int> same;     ///< of each, which RepeatedPairs::first stands for it
  };

  /// What the pairs of one outer cell add: its rows, and diagonal blocks of its partners.
  struct CellRows
  {
    std::size_t cell = 0;
    std::vector<double> values;   ///< shape (n_shapes, n_columns, n_entries)
    std::vector<double> diagonal; ///< of each partner, shape (n_shapes, n_shapes, n_entries)
    bool is_exact = false;
  };

  /// Sums of all cells: rows by scalar dofs with n_entries values a column, and diagonal blocks.
  class MeshRows
  {
  public:
    MeshRows(const MeshSpace &space, unsigned int n_entries, const std::vector<CellPairs> &pairs);

    void add(const CellRows &part);

    /// U + Uᵀ + diagonal blocks on the free rows, components interleaved.
    algebra::CsrMatrix combine(unsigned int n_components);

    bool is_exact = true;

  private:
    void make_pattern();
    void scatter_diagonal();
    algebra::CsrMatrix combine_rows(std::size_t first, std::size_t last,
                                    unsigned int n_components) const;

    const MeshSpace &space_;
    unsigned int n_entries_;
    const std::vector<CellPairs> &pairs_; ///< not needed after the last add
    std::vector<std::size_t> start_;      ///< of each dof's row
    std::vector<unsigned int> column_;
    std::vector<double> value_;    ///< shape (column_.size(), n_entries)
    std::vector<double> diagonal_; ///< of each cell
  };
} // namespace plumbline::reference
