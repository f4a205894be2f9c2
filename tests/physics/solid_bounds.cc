#include "physics/solid_bounds.h"

#include <gtest/gtest.h>

using namespace plumbline::physics;

namespace
{
  /// Some A0 and A1 of a grid fulfil (2.7) and (2.8) of Fan et al. 2022.
  bool has_constants(const LameBounds &of)
  {
    const double jump = of.largest.lambda - of.least.lambda;
    for (double A1 = .005; A1 < 4; A1 += .005)
      for (double A0 = 1e-3; A0 < 1e3; A0 *= 1.01)
        if ((4 - A1) * of.least.mu - A0 * jump > 0 &&
            of.largest.lambda - jump / (2 * A0) - of.largest.mu / (2 * A1) >= 0)
          return true;
    return false;
  }
} // namespace

TEST(SolidBounds, AssumptionOneIsWhatABruteForceSearchFinds)
{
  for (const double lambda : {.1, .3, 1., 4.})
    for (const double jump : {0., .2, 1., 3.})
      for (const double mu : {.5, 1., 2.5})
        for (const double largest : {1., 1.7})
        {
          const LameBounds bounds{{lambda, mu}, {lambda + jump, largest * mu}};
          const Assumption1 found = assumption_1(bounds);
          if (std::abs(found.left / found.right - 1) < .03)
            continue; // too near for the grid
          EXPECT_EQ(found.holds(), has_constants(bounds))
              << lambda << ", " << jump << ", " << mu << ", " << largest;
        }
}

// Remark 1 of the paper: of constants 8 λ > μ; widened bounds hold all.
TEST(SolidBounds, OfConstantsAreThoseOfRemarkOne)
{
  const Lame lame{.5, 1};
  EXPECT_EQ(assumption_1({lame, lame}).left, 4);
  EXPECT_EQ(assumption_1({lame, lame}).right, 1);
  LameBounds bounds{lame, lame};
  bounds.add({2, .25});
  EXPECT_EQ(bounds.least, (Lame{.5, .25}));
  EXPECT_EQ(bounds.largest, (Lame{2, 1}));
  EXPECT_EQ(assumption_1(bounds).right, 16); // (1 + 1.5/.5)²
  EXPECT_FALSE(assumption_1(bounds).holds());
}
