#pragma once

#include "uq/covariance.h"
#include "uq/expansion.h"

namespace plumbline::uq
{
  /// Eigenvalues and modes of a covariance on a line, alike Expansion's.
  struct LineModes
  {
    std::vector<double> eigenvalue;        ///< descending, >= 0 [u² length]
    std::vector<std::vector<double>> mode; ///< at the centres of cells, orthonormal [length^-1/2]
  };

  /// λ φ(x) = ∫ C(x - y) φ(y) dy on an interval, by Galerkin's method with functions that are
  /// constant in n equal cells; C is taken at distances of their centres. Accuracy: second order in
  /// h = length / n, also for covariances with a kink at 0; the sum of all eigenvalues is exact.
  /// Closed forms: exp(-|d|/ℓ) on length L has λ = 2ℓ / (1 + ω²ℓ²), ω the roots > 0 of 1 = ℓω
  /// tan(ωL/2) and tan(ωL/2) = -ℓω. Source: Ghanem & Spanos 1991, "Stochastic Finite Elements",
  /// sec. 2.3.3, doi:10.1007/978-1-4612-3094-6.
  /// @throws InputError  length <= 0, n_modes not in [1, n]; NumericalError: C is not positive
  /// definite, or its modes do not settle
  LineModes karhunen_loeve(const std::function<double(double distance)> &covariance, double length,
                           unsigned int n, unsigned int n_modes);

  /// The Karhunen-Loève expansion of a field with a stationary covariance on a box, by Galerkin's
  /// method with functions that are constant in the cells of a grid; C is taken at distances of
  /// their centres: a block Toeplitz matrix with Toeplitz blocks, multiplied by fast Fourier
  /// transforms (FFTW), its largest eigenvalues by largest_modes.
  /// Accuracy: eigenvalues and modes second order in h, where h is less than the correlation
  /// length; of the matrix's own, 1e-10 of the largest.
  /// Cost: 20 modes at 400 × 200 nodes 1 s, 11 s where the correlation length is a hundredth of the
  /// box: eigenvalues lie close together then.
  /// @throws InputError  n_modes not in [1, nodes]; check(grid); not enough memory
  /// @throws NumericalError  C is not positive definite, or its modes do not settle
  Expansion karhunen_loeve(const CovarianceFunction &covariance, const Grid &grid,
                           unsigned int n_modes, double mean = 0);

  /// The same for a covariance by few numbers; a separable one by products of its modes along x and
  /// y, which are those of the same matrix.
  /// @throws InputError  check(covariance), too
  Expansion karhunen_loeve(const Covariance &covariance, const Grid &grid, unsigned int n_modes,
                           double mean = 0);
} // namespace plumbline::uq
