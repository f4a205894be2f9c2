#pragma once

#include "geometry/lattice.h"

#include <cstdint>
#include <vector>

namespace plumbline::algebra
{
  /// A translation-invariant operator on a lattice: (A u)_s(i) = Σ_t Σ_k A_st(k) u_t(i + k), |k1|,
  /// |k2| <= reach. Blocks s, t run over components and families of a NodeSet. Symmetric: A_ts(-k)
  /// = A_st(k).
  class Stencil
  {
  public:
    Stencil(unsigned int n_blocks, int reach);

    unsigned int n_blocks() const { return n_blocks_; }
    int reach() const { return reach_; }

    double &operator()(unsigned int s, unsigned int t, int k1, int k2);
    double operator()(unsigned int s, unsigned int t, int k1, int k2) const;

    /// Non-zero entries of all blocks: pairs that one row of each block sums over.
    std::uint64_t n_entries() const;

    /// Every block is even in k and A_st = A_ts: true for one family of nodes.
    bool is_even() const;

    /// max |A_ts(-k) - A_st(k)| / max |A|: 0 to round-off, else conjugate gradients are not
    /// allowed.
    double symmetry_defect() const;

  private:
    unsigned int n_blocks_;
    int reach_;
    std::vector<double> entries_; ///< shape (n_blocks, n_blocks, 2 reach + 1, 2 reach + 1)
  };

  /// The sum of two operators on the same blocks; its reach is the larger one.
  /// @pre a.n_blocks() == b.n_blocks()
  Stencil add(const Stencil &a, const Stencil &b);
} // namespace plumbline::algebra
