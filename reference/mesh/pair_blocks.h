#pragma once

#include <vector>

namespace plumbline::reference
{
  /// What an ordered pair of cells (E, E') adds to the energy, C the kernel with its coefficient:
  ///   outer(a, a') = ∬_{E×E'} C φ_a(x) φ_a'(x),  cross(a, b) = ∬ C φ_a(x) ψ_b(y),
  ///   inner(b, b') = ∬ C ψ_b(y) ψ_b'(y),
  /// each shape (n, n, n_entries): one value for a scalar kernel, xx, xy, yy for a tensor.
  struct PairBlocks
  {
    std::vector<double> outer, cross, inner;

    void resize(unsigned int n, unsigned int n_entries)
    {
      for (auto *block : {&outer, &cross, &inner})
        block->resize(static_cast<std::size_t>(n) * n * n_entries);
    }

    /// All zero.
    void reset(unsigned int n, unsigned int n_entries)
    {
      for (auto *block : {&outer, &cross, &inner})
        block->assign(static_cast<std::size_t>(n) * n * n_entries, 0.);
    }

    /// @pre  the same shapes
    void add(const PairBlocks &other)
    {
      for (std::size_t k = 0; k < cross.size(); ++k)
      {
        outer[k] += other.outer[k];
        cross[k] += other.cross[k];
        inner[k] += other.inner[k];
      }
    }
  };

  /// L B Rᵀ of a block B, entry by entry of the kernel.
  /// @param left, right  shape (n, n); empty: the identity
  void transform(const std::vector<double> &left, const std::vector<double> &right, unsigned int n,
                 std::vector<double> &block);
} // namespace plumbline::reference
