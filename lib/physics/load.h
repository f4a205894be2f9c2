#pragma once

#include "physics/coefficient.h"
#include "physics/kernel.h"

#include <optional>

namespace plumbline::physics
{
  /// The load b = L_δ u of a given field u: -∫_{|ξ|<δ} a C(ξ) (u(x+ξ) - u(x)) dξ, a the mean of the
  /// coefficients at x and x+ξ (1 if there is none), by Gauss points in the radius and equidistant
  /// angles, both doubled until the value stops moving. Exact for polynomials. Accuracy: 1e-13 of
  /// |b| for smooth u, down to the round-off 1e-16 ∫C max|u|. Not for: u or a that is not smooth in
  /// the ball; give the load itself then.
  class ManufacturedLoad
  {
  public:
    /// @throws InputError  u has too few components for the kernel
    ManufacturedLoad(Kernel<2> kernel, Expression u, std::optional<Coefficient> a = {});

    /// @throws NumericalError  the quadrature does not settle to 1e-12
    double operator()(const Point<2> &x, unsigned int component) const;

  private:
    Kernel<2> kernel_;
    Expression u_;
    std::optional<Coefficient> a_;
  };

  /// ∫_{|ξ|<δ} |C_aa|, the size of the operator's two terms, which cancel [unit of C length^2].
  double operator_scale(const Kernel<2> &kernel);
} // namespace plumbline::physics
