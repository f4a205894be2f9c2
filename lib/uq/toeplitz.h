#pragma once

#include "uq/covariance.h"
#include "uq/grid_field.h"

#include <memory>

namespace plumbline::uq
{
  /// Products with the matrix cell_area · C(x_i - x_j) of a stationary covariance at the nodes of a
  /// grid, by fast Fourier transforms of twice its extents (FFTW): O(N log N). On one thread.
  class ToeplitzProduct
  {
  public:
    /// @pre check(grid)
    /// @throws NumericalError  a covariance that is not a finite number
    ToeplitzProduct(const CovarianceFunction &covariance, const Grid &grid);
    ToeplitzProduct(ToeplitzProduct &&) noexcept;
    ~ToeplitzProduct();

    /// @param x, y  shape (n_columns, n[1], n[0]). Accuracy: 1e-15 of the largest entry's size.
    void apply(const double *x, double *y, unsigned int n_columns) const;

  private:
    struct Transforms;
    std::unique_ptr<Transforms> transforms_;
  };
} // namespace plumbline::uq
