#pragma once

#include "physics/kernel.h"

#include <functional>

namespace plumbline::physics
{
  /// A scalar field on a line; the component is 0.
  using FieldOnLine = std::function<double(const Point<1> &, unsigned int component)>;

  /// b = L u at any point: ∫_0^δ C(r) (2 u(x) - u(x + r) - u(x - r)) dr, by Gauss's rule of 14
  /// points with interval bisection until both agree. The difference vanishes like r² at 0, so
  /// that kernels with a finite second moment are integrated, whether or not they are integrable.
  /// Accuracy: 1e-13 of ∫ C (2 |u(x)| + |u(x + r)| + |u(x - r)|) dr, whose terms cancel;
  /// polynomials and other smooth fields to rounding. Kinks and jumps of u are found by the
  /// halving.
  /// @throws NumericalError (of the field returned)  no convergence down to 2^-40 of the
  /// horizon, or within 4000 intervals
  FieldOnLine load_on_line(const Kernel<1> &kernel, FieldOnLine u);
} // namespace plumbline::physics
