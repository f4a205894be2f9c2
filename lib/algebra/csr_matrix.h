#pragma once

#include "base/communicator.h"

#include <cstdint>
#include <vector>

namespace plumbline::algebra
{
  /// A sparse matrix by rows: columns of row i are column[start[i]] ... column[start[i + 1] - 1],
  /// ascending, each once.
  struct CsrMatrix
  {
    std::vector<std::size_t> start; ///< shape (n_rows + 1)
    std::vector<unsigned int> column;
    std::vector<double> value;

    std::size_t n_rows() const { return start.empty() ? 0 : start.size() - 1; }
  };

  /// The sum of two matrices with the same number of rows.
  CsrMatrix add(const CsrMatrix &a, const CsrMatrix &b);

  CsrMatrix transpose(const CsrMatrix &rows); ///< of a square matrix
  CsrMatrix transpose(const CsrMatrix &rows, std::size_t n_columns);

  /// Cᵀ diag(s) C, n columns.
  CsrMatrix normal_matrix(const CsrMatrix &C, const std::vector<double> &s, std::size_t n);

  /// ‖A‖_∞.
  double largest_row_sum(const CsrMatrix &rows);
} // namespace plumbline::algebra
