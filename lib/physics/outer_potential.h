#pragma once

#include "physics/kernel.h"

#include <array>
#include <vector>

namespace plumbline::physics
{
  /// How the potentials of a kernel without a horizon go on beyond the circle if the kernel is zero
  /// there. With q = |ξ|²/δ², for scalar kernels (of bond tensors: half their trace) Ψ = δ⁴ f with
  /// Δ²Ψ = 0, which leaves
  ///   16 f = (m_0 q + m_1) ln q - (2 m_0 + l_0) q + 2 m_1 - l_1,
  ///   m_p = ∫_0^1 C(δ√s) s^p ds, l_p the same with ln s,
  /// from Green's function of D = d/dq (q d/dq); for the rest of bond tensors Ψ = δ² H f with
  ///   96 f = m_(-1) q - 3 m_0 + 3 m_1/q - m_2/q², m_(-1) its finite part.
  /// With the potential inside three times differentiable at q = 1. A value.
  class OuterPotential
  {
  public:
    /// Values for half the trace, or of scalar kernels, and for the rest.
    using Values = std::array<long double, 2>;

    /// @param powers  a kernel without breaks, its profile a sum of powers
    explicit OuterPotential(const Kernel<2> &powers);

    /// Of a scalar kernel that is a smooth function of |ξ|².
    static OuterPotential of_smooth(const Kernel<2> &kernel);

    /// f, q >= 1. [1 / length^4 times the unit of the operator]
    Values f(long double q) const;

    /// ∫_1^q of f ds for half the trace, of s f ds for the rest.
    Values integral(long double q) const;

  private:
    OuterPotential() = default;
    Values antiderivative(long double q) const;

    std::array<long double, 4> trace_{}; ///< of 1, q, ln q, q ln q
    std::array<long double, 4> rest_{};  ///< of 1, q, 1/q, 1/q²
  };
} // namespace plumbline::physics
