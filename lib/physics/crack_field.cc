#include "physics/crack_field.h"

#include <cmath>

namespace plumbline::physics
{
  dealii::Tensor<1, 2> crack_field(const dealii::Point<2> &x, const Lame &lame)
  {
    const double kappa = (lame.lambda + 3 * lame.mu) / (lame.lambda + lame.mu), // Kolosov's
        half = .5 * std::atan2(x[1], x[0]), cosine = std::cos(half),
                 size = std::sqrt(x.norm() / (2 * M_PI)) / (2 * lame.mu);
    dealii::Tensor<1, 2> u;
    u[0] = size * cosine * (kappa + 1 - 2 * cosine * cosine);
    u[1] = size * std::sin(half) * (kappa + 1 - 2 * cosine * cosine);
    return u;
  }

  double crack_release(const Lame &lame)
  {
    return (lame.lambda + 2 * lame.mu) / (4 * lame.mu * (lame.lambda + lame.mu));
  }
} // namespace plumbline::physics
