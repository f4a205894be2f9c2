#include "physics/crack_field.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline::physics;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /// du_a/dx_b by differences.
  Tensor<2, 2> gradient(const Point<2> &x, const Lame &lame)
  {
    constexpr double step = 1e-4;
    Tensor<2, 2> result;
    for (unsigned int b = 0; b < 2; ++b)
    {
      Point<2> up = x, down = x;
      up[b] += step;
      down[b] -= step;
      const Tensor<1, 2> change = crack_field(up, lame) - crack_field(down, lame);
      for (unsigned int a = 0; a < 2; ++a)
        result[a][b] = change[a] / (2 * step);
    }
    return result;
  }

  Tensor<2, 2> stress(const Point<2> &x, const Lame &lame)
  {
    const Tensor<2, 2> g = gradient(x, lame);
    Tensor<2, 2> sigma = lame.mu * (g + transpose(g));
    for (unsigned int d = 0; d < 2; ++d)
      sigma[d][d] += lame.lambda * trace(g);
    return sigma;
  }
} // namespace

TEST(CrackField, is_in_equilibrium_and_free_of_traction_on_the_crack)
{
  const Lame lame{1.7, .6};
  for (const Point<2> &x : {Point<2>(.3, .2), Point<2>(-.4, .1), Point<2>(-.2, -.5)})
  {
    constexpr double step = 1e-3;
    Tensor<1, 2> force;
    for (unsigned int b = 0; b < 2; ++b)
    {
      Point<2> up = x, down = x;
      up[b] += step;
      down[b] -= step;
      const Tensor<2, 2> change = stress(up, lame) - stress(down, lame);
      for (unsigned int a = 0; a < 2; ++a)
        force[a] += change[a][b] / (2 * step);
    }
    EXPECT_LT(force.norm(), 1e-4 * stress(x, lame).norm() / x.norm());
  }
  const Tensor<2, 2> face = stress(Point<2>(-.5, 2e-4), lame);
  EXPECT_LT(std::abs(face[1][1]) + std::abs(face[0][1]), 2e-3);
}

TEST(CrackField, pulls_and_opens_by_its_K)
{
  for (const Lame &lame : {Lame{1, 1}, {1.7, .6}})
  {
    constexpr double r = .3;
    EXPECT_NEAR(stress(Point<2>(r, 0), lame)[1][1], 1 / std::sqrt(2 * M_PI * r), 1e-6);
    const Tensor<1, 2> opening =
        crack_field(Point<2>(-r, 0.), lame) - crack_field(Point<2>(-r, -0.), lame);
    EXPECT_NEAR(opening[0], 0, 1e-15);
    EXPECT_NEAR(opening[1], 8 * crack_release(lame) * std::sqrt(r / (2 * M_PI)), 1e-14);
  }
  EXPECT_NEAR(crack_release({1, 1}), (1 - .25 * .25) / 2.5, 1e-15); // (1 - ν²)/E
}
