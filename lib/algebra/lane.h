#pragma once

#include <cstring>

// One build serves machines with and without wide vectors; the loader picks the clone. Sanitizers
// do not work with that choice.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define PLUMBLINE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PLUMBLINE_VECTOR_CLONES
#endif

namespace plumbline::algebra
{
  /// As many values as a vector register holds, for sources that are one hot loop.
  constexpr int lanes = 4;
  using Lane = double __attribute__((vector_size(lanes * sizeof(double))));

  [[gnu::always_inline]] inline Lane load(const double *from)
  {
    Lane lane;
    std::memcpy(&lane, from, sizeof(Lane));
    return lane;
  }
} // namespace plumbline::algebra
