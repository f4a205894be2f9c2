#pragma once

#include "algebra/stencil.h"

#include <array>
#include <memory>
#include <vector>

namespace plumbline::algebra
{
  /// Applies a stencil by fast Fourier transforms (FFTW): O(N log N) whatever the reach.
  class Convolution
  {
  public:
    /// @param n       extents of the output positions
    /// @param margin  the input reaches this many positions beyond the output on every side
    ///                along axes of which the stencil has a reach
    Convolution(const Stencil &stencil, std::array<int, 3> n, int margin)
        : Convolution(stencil, n, std::array<int, 3>{margin, margin, margin})
    {
    }
    /// @param margins  of each axis
    Convolution(const Stencil &stencil, std::array<int, 3> n, const std::array<int, 3> &margins);
    Convolution(const Stencil &stencil, std::array<int, 2> n, int margin)
        : Convolution(stencil, std::array<int, 3>{n[0], n[1], 1}, margin)
    {
    }
    Convolution(Convolution &&) noexcept;
    ~Convolution();

    /// @param input   shape (n_blocks, n[2] + 2 margin, n[1] + 2 margin, n[0] + 2 margin), with the
    ///                margin of each axis
    /// @param output  shape (n_blocks, n[2], n[1], n[0])
    void apply(const double *input, double *output) const;

    /// Estimated seconds an apply takes on one core, to choose a backend (measured on one machine).
    static double estimated_seconds(unsigned int n_blocks, const std::array<int, 3> &reaches,
                                    std::array<int, 3> n);
    static double estimated_seconds(unsigned int n_blocks, int reach, std::array<int, 2> n)
    {
      return estimated_seconds(n_blocks, {reach, reach, 0}, {n[0], n[1], 1});
    }

  private:
    struct Transforms;
    std::unique_ptr<Transforms> transforms_;
  };
} // namespace plumbline::algebra
