#pragma once

#include <deal.II/base/quadrature.h>

namespace plumbline::physics
{
  /// Gauss's rule of n points on (0, 1), made once for each n. Thread safe.
  const dealii::Quadrature<1> &gauss(unsigned int n);
} // namespace plumbline::physics
