#pragma once

#include "physics/kernel.h"
#include "reference/mesh/segment.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// The potential of a sum of powers c (|ξ|/δ)^k without a horizon: Δ²Ψ = C for all ξ ≠ 0. Scalar
  /// kernels:
  ///   Ψ = c r^(k+4) / ((k+2)² (k+4)²);
  /// bond tensors: half of that for half the trace, and with H = ξ⊗ξ - ½|ξ|² 1 for the rest
  ///   Ψ = c H r^(k+2) / (k (k+2) (k+4) (k+6)), and c H r² ln r / 48 of k = 0.
  /// Their integrals over lines are elementary.
  class PowerPotential
  {
  public:
    /// Half the trace, or the entry of a scalar kernel, then ½(Ψ_xx - Ψ_yy) and Ψ_xy.
    using Entries = std::array<double, 3>;

    /// @param kernel  its profile a sum of powers
    explicit PowerPotential(const physics::Kernel<2> &kernel);

    /// Take off δ⁴ (a_0 + a_1 q) and δ² H (b_0 + b_1 q), q = r²/δ², whose pair form is zero.
    void subtract(const std::array<double, 2> &a, const std::array<double, 2> &b);

    /// ∫ (a + b x) Ψ(z) dx over [from, from + length], z = x e + h e', e' being e turned by π/2;
    /// or, for the divergence, of what G has in place of Ψ in div (z G) = Ψ. The length is given
    /// with all its digits: a difference of ends would lose as many as it is far away.
    Entries integrate(const Vector2 &e, double from, double length, double h, double a, double b,
                      bool for_divergence) const;

  private:
    /// Coefficients of r^p, p = 1, 3, ... or 0, 2, ...
    struct Term
    {
      double trace = 0, rest = 0;
    };
    struct Line;
    Term &term(int p);
    void add_series(const std::vector<Term> &series, bool is_odd, const Line &line,
                    bool for_divergence, Entries &sum) const;
    void add_logarithm(const Line &line, bool for_divergence, Entries &sum) const;

    std::vector<Term> odd_, even_;
    double logarithm_ = 0; ///< of H r² ln (r/δ)
    double horizon_;
    bool is_tensor_;
  };
} // namespace plumbline::reference
