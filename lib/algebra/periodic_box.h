#pragma once

#include "algebra/stencil.h"
#include "base/fftw.h"

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace plumbline::algebra
{
  /// A box of n nodes in the corner of a periodic box of N >= n + reach nodes along each axis of
  /// which the stencil has a reach. The other nodes are the layer. On the periodic box it is block
  /// circulant; restricted to the box it is the stencil there, as no node of the box reaches its
  /// own images. Fields have shape (n_blocks, N[2], N[1], N[0]); values on the layer are numbered
  /// component by component, x fastest.
  class PeriodicBox
  {
  public:
    /// @pre stencil.n_blocks() <= 3 and stencil.is_even()
    /// @throws NumericalError  a block of the symbol is not positive definite
    PeriodicBox(const Stencil &stencil, const std::array<int, 3> &n);

    /// N: lengths with fast transforms.
    static std::array<int, 3> periods(const std::array<int, 3> &reaches,
                                      const std::array<int, 3> &n);

    unsigned int n_blocks() const { return n_blocks_; }
    const std::array<int, 3> &n() const { return n_; }
    const std::array<int, 3> &period() const { return period_; }
    std::size_t n_layer() const { return n_layer_; } ///< nodes

    /// Of a node (i, j, k) of the layer.
    std::size_t number(int i, int j, int k) const
    {
      const std::size_t row = j + static_cast<std::size_t>(period_[1]) * k;
      return row_start_[row] + i - (crosses_box(j, k) ? n_[0] : 0);
    }

    /// The periodic operator's largest eigenvalue, and the least of its longest waves along the
    /// axes.
    double largest() const { return largest_; }
    double longest_wave() const { return longest_wave_; }

    /// The inverse of the symbol's block at wave numbers k, 0 <= k_d < N_d; of the constants, whose
    /// symbol is 0, zero. Lower triangle, row by row.
    const double *inverse(std::array<int, 3> k) const;

    /// Set the field to zero, then to the given values on the box.
    void set_box(const double *values);   ///< shape (n_blocks, n[2], n[1], n[0])
    void add_layer(const double *values); ///< to the field

    /// Apply the operator's inverse to the field without its mean; constants become zero.
    void invert();

    void get_box(double *values) const;
    void get_layer(double *values) const;

  private:
    bool crosses_box(int j, int k) const { return j < n_[1] && k < n_[2]; }
    void invert_symbol(const Stencil &stencil);
    template <class Visit>
    void for_each_row(const Visit &visit) const;

    unsigned int n_blocks_;
    std::array<int, 3> n_, period_;
    std::size_t n_points_, n_modes_, n_layer_ = 0;
    std::vector<std::size_t> row_start_; ///< of values on the layer, shape (N[2], N[1])
    std::vector<double> inverse_;        ///< shape (n_modes, n_blocks (n_blocks + 1) / 2)
    double largest_ = 0, longest_wave_ = 0;
    base::AlignedArray<double> field_;
    base::AlignedArray<std::complex<double>> modes_; ///< shape (n_blocks, N[2], N[1], N[0] / 2 + 1)
    base::Plan forward_, backward_;
  };
} // namespace plumbline::algebra
