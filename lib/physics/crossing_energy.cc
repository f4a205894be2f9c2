#include "physics/crossing_energy.h"

#include <cmath>

namespace plumbline::physics
{
  template <int dim>
  double crossing_energy(const Kernel<dim> &influence, const Lame &lame)
  {
    const double beta = influence.constant() * std::pow(influence.horizon(), dim + 3) *
                        influence.profile().moment(dim + 2);
    return (dim == 2 ? 2 : M_PI) * beta * (dim * lame.lambda + 2 * lame.mu);
  }

  template double crossing_energy(const Kernel<2> &, const Lame &);
  template double crossing_energy(const Kernel<3> &, const Lame &);
} // namespace plumbline::physics
