#pragma once

#include "physics/kernel.h"

#include <array>
#include <vector>

namespace plumbline::physics
{
  /// The kernel that couples displacements in space through the product of their dilatations
  /// θ_u(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ in an infinite homogeneous body,
  ///   ∫ θ_u θ_v dx = -∬ v(x)·C(w) u(x+w) dw dx,   C(w) = ∫ K(|ξ|) ξ ⊗ K(|w-ξ|) (w-ξ) dξ,
  /// zero for |w| > 2δ. As ∫C = 0, it acts like bonds of length up to 2δ. With p = |ξ| + |w-ξ| and
  /// |w| s = |ξ| - |w-ξ|, and f(r) = K(r) r, its entries along and across w are
  ///   along   π/4 ∫∫ f((p+|w|s)/2) f((p-|w|s)/2) (|w|² - p²s²) dp ds
  ///   across -π/8 ∫∫ f((p+|w|s)/2) f((p-|w|s)/2) (p² - |w|²) (1 - s²) dp ds
  /// over -1 < s < 1, |w| < p < 2δ - |w||s|: smooth except at |w| = δ, beyond which
  /// |s| < (2δ - |w|)/|w|.
  class DilatationInSpace
  {
  public:
    /// C = across I + excess n⊗n, n = w/|w| [1/length^5].
    struct Value
    {
      double across = 0, excess = 0;
    };

    /// Tabulates C, in a millisecond.
    /// @param influence  K, scalar, usually with ∫K|ξ|² = 3
    /// @throws InputError  an influence function with breaks, or one like 1/r² or worse at 0
    explicit DilatationInSpace(const Kernel<3> &influence);

    double horizon() const { return horizon_; }

    /// @param w  distance > 0 [length]; 0 beyond 2δ
    /// Accuracy: 1e-14 of the largest entry.
    Value operator()(double w) const;

  private:
    double horizon_;
    std::array<std::vector<Value>, 2> series_; ///< of Chebyshev, within δ and beyond
  };
} // namespace plumbline::physics
