#include "meshfree/fracture/strip.h"

#include <cmath>

namespace plumbline::meshfree
{
  BreakingSolid<2> make_strip(const method::RiceStrip &strip, const physics::Lame &lame,
                              double horizon)
  {
    const double h = strip.h, half = .5 * h * strip.n_height, length = h * strip.n_length,
                 grip = 2 * h * std::ceil(horizon / h - 1e-9);
    BreakingSolid<2> solid;
    solid.domain.include = {{{0, -half - grip}, {length, half + grip}}};
    solid.grips = {{{0, half}, {length, half + grip}}, {{0, -half - grip}, {length, -half}}};
    if (strip.n_crack > 0)
      solid.notch = {{{-h, 0}, {h * strip.n_crack, 0}}};
    solid.constrained = [](const Point<2> &x)
    {
      Tensor<1, 2> u;
      u[1] = x[1] > 0 ? 1 : -1;
      return u;
    };
    solid.material = [lame](const Point<2> &) { return lame; };
    solid.toughness = [](const Point<2> &) { return 1.; };
    return solid;
  }
} // namespace plumbline::meshfree
