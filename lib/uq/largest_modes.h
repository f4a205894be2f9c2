#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace plumbline::uq
{
  /// Y = A X for a symmetric matrix without negative eigenvalues.
  /// @param x, y  shape (n_columns, size): one column after the other
  using BlockProduct = std::function<void(const double *x, double *y, unsigned int n_columns)>;

  /// How many eigenvectors, and how well.
  struct ModeSearch
  {
    unsigned int n_modes = 1;
    unsigned int block = 4; ///< columns of a product
    double tolerance = 1e-12; ///< of a residual ‖A v - λ v‖, ‖v‖ = 1, relative to the largest λ
    unsigned int most_products = 1000;
  };

  /// The largest eigenvalues, descending, with orthonormal eigenvectors.
  struct LargestModes
  {
    std::vector<double> eigenvalue;
    std::vector<std::vector<double>> vector; ///< shape (n_modes, size)
    std::vector<double> residual; ///< ‖A v - λ v‖: an eigenvalue is no further from λ; of equal
                                  ///< ones a bound that all of them share
    std::vector<double> sum_so_far; ///< Σ λ after each product, from the n_modes-th column on
    unsigned int n_products = 0;
    bool is_settled = false; ///< all residuals are within the tolerance
  };

  /// By block Lanczos with full orthogonalisation, restarted with the best vectors; by a dense
  /// matrix where that has not many more rows. A block, not one vector, as eigenvalues come in
  /// pairs on squares, the second of which one vector sees by rounding alone. Of a pair that is
  /// whole among the modes the second vanishes at the first row where both together are at least
  /// .75 of their largest; of one that is not, what is returned depends on rounding. A vector's
  /// sign is such that its first entry of at least half the largest modulus is positive. The same
  /// bits on any number of threads. Accuracy: eigenvalues err by less than the square of their
  /// residual over the gap to the others, vectors by residual over gap, once settled; before, each
  /// λ is too small, by how much sum_so_far tells from how it still grows. Memory: 2 n_modes + 7
  /// block vectors. Source: Golub & Underwood 1977, doi:10.1016/B978-0-12-587260-7.50018-2;
  /// restarts: Wu & Simon 2000, doi:10.1137/S0895479898334605; blocks as wide as the modes are
  /// many: Halko, Martinsson & Tropp 2011, doi:10.1137/090771806, with all of their blocks kept:
  /// Musco & Musco 2015, arXiv:1504.05477.
  /// @pre 1 <= n_modes <= size
  /// @throws InputError  not enough memory; NumericalError: a product is not finite
  LargestModes largest_modes(std::size_t size, const BlockProduct &product,
                             const ModeSearch &search);
} // namespace plumbline::uq
