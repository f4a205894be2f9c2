#pragma once

#include "algebra/simd.h"

namespace plumbline::algebra
{
  template <class Vector>
  constexpr int width_of = sizeof(Vector) / sizeof(double);

  /// 2^y = scale (1 + tail) for y <= 0; scale = 2^n is exact, |tail| < .42.
  /// @tparam Vector  no wider than the machine's registers: compilers take comparisons of longer
  /// ones apart, value by value
  template <class Vector>
  struct PowerOfTwo
  {
    Vector scale, tail;
  };

  /// Accuracy: 1e-15 relative; 0 at y < -1022 means 2^-1022, below any sum's rounding. The scale is
  /// found by adding a number so large that only integers are left: -ffast-math would drop that.
  /// Coefficients: interpolation of 2^f at the 12 Chebyshev points of [-1/2, 1/2], 2e-17.
  template <class Vector>
  [[gnu::always_inline]] inline PowerOfTwo<Vector> power_of_two(Vector y)
  {
    using Bits = decltype(y < y);                      // integers of the same length
    constexpr double magic = 6755399441055744. + 1023; // 1.5 2^52, and the exponent's bias
    const Vector lowest = Vector{} - 1022;
    constexpr int mantissa_bits = 52;
    constexpr double coefficients[] = {
        4.4558179083360645e-10, 7.074194297288521e-09,  1.0178057087733941e-07,
        1.3215432535912375e-06, 1.5252733841556773e-05, 1.5403530463724353e-04,
        1.333355814640647e-03,  9.618129107587256e-03,  5.5504108664821625e-02,
        2.4022650695910158e-01, 6.931471805599453e-01};
    y = y < lowest ? lowest : y;
    const Vector shifted = y + magic, f = y - (shifted - magic);
    Vector sum = Vector{} + coefficients[0];
    for (unsigned int i = 1; i < sizeof(coefficients) / sizeof(double); ++i)
      sum = sum * f + coefficients[i];
    return {(Vector)((Bits)shifted << mantissa_bits), sum * f};
  }
} // namespace plumbline::algebra
