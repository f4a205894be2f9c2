#pragma once

#include "algebra/stencil.h"

#include <array>
#include <vector>

namespace plumbline::algebra
{
  /// Applies an even stencil of one or two components by summing over opposite pairs of bonds,
  /// w (u(i+k) + u(i-k)), each pair loaded once for a register's worth of nodes. Wins over
  /// transforms when the reach is small.
  class DirectStencil
  {
  public:
    /// @pre stencil.is_even(), and 1 or 2 blocks
    DirectStencil(const Stencil &stencil, std::array<int, 2> n);

    static bool fits(const Stencil &stencil);

    /// @param input, output  shape (n_blocks, n[1], n[0]); input counts as 0 outside
    void apply(const double *input, double *output) const;

    /// Estimated seconds an apply takes on one core, to choose a backend (measured on one machine).
    static double estimated_seconds(const Stencil &stencil, std::array<int, 2> n);

  private:
    struct Pair
    {
      std::ptrdiff_t shift;         ///< from a node to its neighbour in the padded field
      std::array<double, 3> weight; ///< A_00, A_01, A_11
    };

    template <unsigned int n_blocks>
    void apply_rows(int from, int to, double *output) const;

    unsigned int n_blocks_;
    std::array<int, 2> n_;
    int reach_;
    std::size_t width_, block_size_; ///< of the padded field
    std::array<double, 3> diagonal_;
    std::vector<Pair> pairs_;
    mutable std::vector<double> padded_; ///< shape (n_blocks, n[1] + 2 reach, width)
  };
} // namespace plumbline::algebra
