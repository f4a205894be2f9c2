#pragma once

#include "geometry/for_each_index.h"
#include "geometry/lattice.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumbline::algebra
{
  /// A translation-invariant operator on a lattice: (A u)_s(i) = Σ_t Σ_k A_st(k) u_t(i + k), |k_d|
  /// <= reach of axis d. Blocks s, t run over components and families of a NodeSet. Symmetric:
  /// A_ts(-k) = A_st(k). In the plane the third axis has reach 0.
  class Stencil
  {
  public:
    /// In the plane.
    Stencil(unsigned int n_blocks, int reach);
    /// In space.
    Stencil(unsigned int n_blocks, const std::array<int, 3> &reaches);

    unsigned int n_blocks() const { return n_blocks_; }
    int reach() const { return reaches_[0]; } ///< along the first axis
    const std::array<int, 3> &reaches() const { return reaches_; }

    /// visit(k1, k2, k3) for all offsets within the reaches, the first index fastest.
    template <class Visit>
    void for_each_offset(const Visit &visit) const
    {
      geometry::for_each_index({-reaches_[0], -reaches_[1], -reaches_[2]},
                               {reaches_[0] + 1, reaches_[1] + 1, reaches_[2] + 1},
                               [&](const std::array<int, 3> &k) { visit(k[0], k[1], k[2]); });
    }

    double &operator()(unsigned int s, unsigned int t, int k1, int k2, int k3 = 0);
    double operator()(unsigned int s, unsigned int t, int k1, int k2, int k3 = 0) const;

    /// Non-zero entries of all blocks: pairs that one row of each block sums over.
    std::uint64_t n_entries() const;

    /// Every block is even in k and A_st = A_ts: true for one family of nodes.
    bool is_even() const;

    /// max |A_ts(-k) - A_st(k)| / max |A|: 0 to round-off, else conjugate gradients are not
    /// allowed.
    double symmetry_defect() const;

  private:
    unsigned int n_blocks_;
    std::array<int, 3> reaches_;
    /// shape (n_blocks, n_blocks, 2 reaches[2] + 1, 2 reaches[1] + 1, 2 reaches[0] + 1)
    std::vector<double> entries_;
  };

  /// The sum of two operators on the same blocks; its reaches are the larger ones.
  /// @pre a.n_blocks() == b.n_blocks()
  Stencil add(const Stencil &a, const Stencil &b);
} // namespace plumbline::algebra
