#include "physics/crossing_energy.h"

#include <cmath>

namespace plumbline::physics
{
  template <int dim>
  double crossing_energy(double horizon, const Lame &lame)
  {
    if (dim == 2)
      return 4 * (.75 / M_PI * horizon) * (lame.lambda + lame.mu);
    return .6 * horizon * (3 * lame.lambda + 2 * lame.mu);
  }

  template double crossing_energy<2>(double, const Lame &);
  template double crossing_energy<3>(double, const Lame &);
} // namespace plumbline::physics
