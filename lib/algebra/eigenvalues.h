#pragma once

#include "algebra/csr_matrix.h"

namespace plumbline::algebra
{
  /// Where the eigenvalues of a square matrix lie that need not be symmetric [unit of its entries].
  struct Eigenvalues
  {
    double smallest_real = 0; ///< the least real part
    double smallest_modulus = 0, largest_modulus = 0;
    double largest_imaginary = 0; ///< largest |imaginary part| of those computed
    std::size_t n_computed = 0;   ///< conjugates counted
  };

  /// Up to 100 unknowns all eigenvalues, dense; else the 8 nearest to 0, by sparse factors
  /// (UMFPACK), and the 4 outermost to the left and in modulus, by implicitly restarted Arnoldi
  /// (ARPACK). Accuracy: eigenvalues of a matrix within 1e-8 of this one, relative to its norm; the
  /// ones nearest to 0 are better, 1e-10 of themselves where they are well conditioned. Memory:
  /// factors, and 60 vectors. Not for: matrices whose factors do not fit into memory. Source:
  /// Lehoucq, Sorensen & Yang 1998, "ARPACK Users' Guide", doi:10.1137/1.9780898719628.
  /// @throws NumericalError  no factors, or no convergence
  Eigenvalues eigenvalues(const CsrMatrix &rows);
} // namespace plumbline::algebra
