#pragma once

#include "algebra/csr_matrix.h"
#include "algebra/operator.h"

#include <functional>
#include <memory>

namespace plumbline::algebra
{
  /// y = A x on vectors of A's size.
  using Action = std::function<void(const std::vector<double> &x, std::vector<double> &y)>;

  /// An operator on vectors of size n at some positions, everything else being 0. Not for several
  /// threads at once.
  Action restrict(std::shared_ptr<const Operator> matrix, std::size_t n,
                  std::vector<std::size_t> positions);

  /// Zero modes are counted up to here.
  constexpr std::size_t most_zero_modes = 12;

  /// Both ends of the spectrum of a symmetric operator.
  struct Spectrum
  {
    double smallest = 0, largest = 0;
    /// Of norm 1, of the eigenvalues below 1e-10 of the largest in absolute value: as many as there
    /// are, up to most_zero_modes; none if the smallest is negative.
    std::vector<std::vector<double>> zero_modes;
    double smallest_nonzero = 0;     ///< the smallest one besides those
    std::vector<double> lowest_mode; ///< eigenvector of norm 1 of the smallest
  };

  /// Matrix-free, by Lanczos' method with implicit restarts (ARPACK), up to 100 unknowns dense;
  /// zero modes are deflated one by one. Accuracy of the smallest: (1e-11 largest)² over the gap to
  /// the next eigenvalue. Memory: some 45 vectors.
  /// @param tolerance  of the largest eigenvalue's residual, relative to it; the upper end is often
  /// a dense band, where it is dear
  /// @throws NumericalError  no convergence, or an operator that is not symmetric
  /// Source: Lehoucq, Sorensen & Yang 1998, "ARPACK Users' Guide", doi:10.1137/1.9780898719628.
  Spectrum spectrum(const Action &symmetric, std::size_t n, double tolerance = 1e-3);

  /// What the entries of a square matrix tell of it. Comparisons are up to 1e-12 of a row's sum.
  struct SignCheck
  {
    std::size_t n_positive = 0; ///< rows with a positive off-diagonal entry
    std::size_t n_weak = 0;     ///< rows that are not diagonally dominant
    /// Rows from which no chain of entries leads to a strictly dominant row: nodes that
    /// nothing ties to the data in the collar.
    std::size_t n_loose = 0;
    std::size_t n_parts = 0; ///< connected parts of the graph of A + Aᵀ; 1: irreducible
    double asymmetry = 0;    ///< max |A_ij - A_ji| / max |A|

    /// Inverse-positive, so that there is a maximum principle: a weakly chained diagonally dominant
    /// matrix with no positive entry off the diagonal. Source: Azimzadeh & Forsyth 2016,
    /// doi:10.1137/15M1043431, theorem 2.2.
    bool is_m_matrix() const { return n_positive == 0 && n_weak == 0 && n_loose == 0; }
  };

  SignCheck check_signs(const CsrMatrix &rows);

  /// The same with eigenvalues of the symmetric part.
  struct MatrixCheck : SignCheck
  {
    std::size_t n_negative_eigenvalues = 0; ///< below 1e-14 of the largest row sum
    double smallest_eigenvalue = 0; ///< to 1e-6 if all are positive; else an upper bound near it

    bool is_positive_definite() const { return n_negative_eigenvalues == 0; }
  };

  /// Eigenvalues are counted by the inertia of sparse factors, and the smallest is found by inverse
  /// iteration, from below it.
  /// @throws NumericalError  the factorisation fails
  /// Cost: 1 factorisation, or up to 12 if the matrix is not positive definite.
  MatrixCheck check_matrix(const CsrMatrix &rows);
} // namespace plumbline::algebra
