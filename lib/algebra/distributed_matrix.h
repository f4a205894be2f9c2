#pragma once

#include "algebra/csr_matrix.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

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

  /// A square sparse matrix of which every rank has its share of the rows, and all their columns.
  class DistributedMatrix
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// The sum of what all ranks give: entries of other ranks' rows are sent to them.
    /// @param rows  any rows, shape (n, n), < 2^31 entries; on one rank a reference is kept
    /// @note Collective.
    DistributedMatrix(const CsrMatrix &rows, const OwnedRanges &ranges);

    const OwnedRanges &ranges() const { return ranges_; }
    const CsrMatrix &own() const { return sum_.start.empty() ? given_ : sum_; }

    /// y = A x, threads sharing the rows; the same on any number of them. Values of y before
    /// first_row stay as they are. @note Collective.
    void vmult(Vector &y, const Vector &x, std::size_t first_row = 0) const;

    /// max |A_ij - A_ji| / max |A_ij|; takes a copy of the rows. @note Collective.
    double asymmetry() const;

  private:
    void multiply_blocks(std::size_t first, std::size_t last, const double *x, double *y) const;

    const OwnedRanges &ranges_;
    const CsrMatrix &given_;
    CsrMatrix sum_; ///< empty on one rank
    /// Half the even columns of every second row, if all is blocks of 2 x 2: a quarter of the
    /// indices are read, and memory is what a product waits for. Else empty.
    std::vector<unsigned int> block_column_;
  };

  /// A copy of a square matrix.
  /// @param own  this rank's share of the rows
  /// @note Collective.
  dealii::TrilinosWrappers::SparseMatrix to_trilinos(const CsrMatrix &own,
                                                     const OwnedRanges &ranges);
} // namespace plumbline::algebra
