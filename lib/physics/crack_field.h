#pragma once

#include "physics/state_based.h"

namespace plumbline::physics
{
  /// Displacement about the tip, at 0, of a crack y = 0, x < 0 that opens at stress intensity K = 1
  /// in an isotropic plane [length]; on the crack the sign of y, that of zero too, says which side.
  /// Source: Irwin 1957, doi:10.1115/1.4011547.
  dealii::Tensor<1, 2> crack_field(const dealii::Point<2> &x, const Lame &lame);

  /// What such a crack gets for its advance: K²/E', E' = 4μ(λ + μ)/(λ + 2μ) [K²/(force/length²)].
  double crack_release(const Lame &lame);
} // namespace plumbline::physics
