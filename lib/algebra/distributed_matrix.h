#pragma once

#include "algebra/csr_matrix.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace plumbline::algebra
{
  /// The contiguous rows of every rank; those of one node stay together.
  struct OwnedRanges
  {
    base::Communicator communicator;
    std::vector<int> first, size; ///< shape (n_ranks)
    std::size_t own_first = 0, own_size = 0;

    /// @note Collective.
    OwnedRanges(std::size_t n, unsigned int n_components, const base::Communicator &communicator);

    /// The first n rows of others, each on the rank where it was; some ranks may have none.
    OwnedRanges(const OwnedRanges &others, std::size_t n);

    std::size_t size_of_all() const { return first.back() + size.back(); }
    dealii::IndexSet own() const;
  };

  /// View of rows of a `CsrMatrix` that is stored elsewhere.
  struct CsrView
  {
    dealii::ArrayView<const std::size_t> start; ///< shape (n_rows + 1), or empty; from 0
    dealii::ArrayView<const unsigned int> column;
    dealii::ArrayView<const double> value;

    CsrView() = default;
    CsrView(const CsrMatrix &rows);
    /// Rows first ... first + n - 1. @pre  those before are empty
    CsrView(const CsrMatrix &rows, std::size_t first, std::size_t n);

    std::size_t n_rows() const { return start.size() == 0 ? 0 : start.size() - 1; }
  };

  /// This rank's rows of the sum of the rows on all ranks: each rank sends its parts of the rows of
  /// other ranks to their owners. Rows of other ranks are empty in the result.
  /// @param rows  any rows, shape (n, any number of columns); < 2^31 entries on each rank
  /// @return      same shape; independent of the number of ranks up to the order of sums
  /// @note Collective.
  CsrMatrix sum_own_rows(const CsrMatrix &rows, const OwnedRanges &ranges);

  /// A square sparse matrix of which every rank has its share of the rows, and all their columns.
  class DistributedMatrix
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// The sum of the rows on all ranks. Keeps a reference if no rank has rows of another, as after
    /// `sum_own_rows`; else this rank's rows are summed here, a copy.
    /// @param rows  any rows, shape (n, n), < 2^31 entries
    /// @note Collective.
    DistributedMatrix(const CsrMatrix &rows, const OwnedRanges &ranges);
    DistributedMatrix(const DistributedMatrix &) = delete;
    DistributedMatrix &operator=(const DistributedMatrix &) = delete;

    const OwnedRanges &ranges() const { return ranges_; }
    const CsrView &own() const { return own_; }

    /// y = A x, threads sharing the rows; the same on any number of them. Values of y before
    /// first_row stay as they are. Ranks exchange the values of x that others have columns for.
    /// @note Collective; one product at a time.
    void vmult(Vector &y, const Vector &x, std::size_t first_row = 0) const;

    /// max |A_ij - A_ji| / max |A_ij|; takes a copy of the rows. @note Collective.
    double asymmetry() const;

    double largest_row_sum() const; ///< ‖A‖_∞. @note Collective.

  private:
    void import_columns();
    const double *values_at_columns(const Vector &x) const;
    void multiply_blocks(std::size_t first, std::size_t last, const double *x, double *y) const;

    const OwnedRanges &ranges_;
    CsrMatrix sum_; ///< empty where each rank gives its own rows
    CsrView own_;
    /// Half the even columns of every second row, if all is blocks of 2 x 2: a quarter of the
    /// indices are read, and memory is what a product waits for. Else empty.
    std::vector<unsigned int> block_column_;
    /// Of several ranks: own rows, and columns of own rows that are rows of others.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> columns_;
    /// x at own rows and these columns, shape (n); elsewhere without values, and no memory is used.
    std::unique_ptr<double[]> values_;
  };

  /// A copy of a square matrix.
  /// @param own  this rank's share of the rows
  /// @note Collective.
  dealii::TrilinosWrappers::SparseMatrix to_trilinos(const CsrView &own, const OwnedRanges &ranges);
} // namespace plumbline::algebra
