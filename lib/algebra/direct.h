#pragma once

#include "algebra/stencil.h"

#include <array>
#include <vector>

namespace plumbline::algebra
{
  /// Applies an even stencil of one to three components by summing over opposite pairs of bonds,
  /// w (u(i+k) + u(i-k)), each pair loaded once for a register's worth of nodes. Wins over
  /// transforms when the reach is small.
  class DirectStencil
  {
  public:
    /// @pre stencil.is_even(), and 1 to 3 blocks
    /// @param has_halo  the input has the planes within reach along the third axis, too
    DirectStencil(const Stencil &stencil, std::array<int, 3> n, bool has_halo = false);
    DirectStencil(const Stencil &stencil, std::array<int, 2> n)
        : DirectStencil(stencil, std::array<int, 3>{n[0], n[1], 1})
    {
    }

    static bool fits(const Stencil &stencil);

    /// @param input, output  shape (n_blocks, n[2], n[1], n[0]), the input with a halo of n[2] + 2
    ///                       reaches[2] planes; it counts as 0 outside
    void apply(const double *input, double *output) const;

    /// The two parts of apply(), for input whose planes arrive one after the other: take planes
    /// [from, to) of the input, which begin at -reaches[2] with a halo, then compute planes [from,
    /// to) of the output. Bits do not depend on how planes are divided.
    void take(const double *input, int from, int to) const;
    void compute(int from, int to, double *output) const;

    /// Estimated seconds an apply takes on one core, to choose a backend (measured on one machine).
    static double estimated_seconds(const Stencil &stencil, const std::array<int, 3> &n);

  private:
    struct Pair
    {
      std::ptrdiff_t shift;         ///< from a node to its neighbour in the padded field
      std::array<double, 3> weight; ///< A_00, A_01, A_11
    };

    struct Triple
    {
      std::ptrdiff_t shift;
      std::array<double, 6> weight; ///< A_00, A_01, A_11, A_02, A_12, A_22
    };

    double *padded_row(int j, int k, unsigned int block) const;

    template <unsigned int n_blocks>
    void apply_rows(int from, int to, double *output) const;

    unsigned int n_blocks_;
    std::array<int, 3> n_, reach_;
    int halo_;                                ///< planes of the input below and above
    std::size_t width_, height_, block_size_; ///< of the padded field
    std::array<double, 6> diagonal_;
    std::vector<Pair> pairs_;     ///< of one or two blocks
    std::vector<Triple> triples_; ///< of three
    /// shape (n_blocks, n[2] + 2 reach[2], height, width)
    mutable std::vector<double> padded_;
  };
} // namespace plumbline::algebra
