#pragma once

#include "algebra/stencil.h"

#include <cmath>

/// Σ_k A_st(k) k1^a k2^b of one family.
inline double stencil_moment(const plumbline::algebra::Stencil &stencil, unsigned int s,
                             unsigned int t, int a, int b)
{
  double sum = 0;
  for (int k2 = -stencil.reach(); k2 <= stencil.reach(); ++k2)
    for (int k1 = -stencil.reach(); k1 <= stencil.reach(); ++k1)
      sum += stencil(s, t, k1, k2) * std::pow(k1, a) * std::pow(k2, b);
  return sum;
}
