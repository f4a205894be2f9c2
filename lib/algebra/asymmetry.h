#pragma once

#include "algebra/csr_matrix.h"

namespace plumbline::algebra
{
  /// max |A_ij - A_ji| / max |A| of a square matrix, without a copy of it.
  double asymmetry(const CsrMatrix &rows);
} // namespace plumbline::algebra
