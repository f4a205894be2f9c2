#pragma once

#include <cstring>

// One build serves machines with and without wide vectors; the loader picks the clone. Sanitizers
// do not work with that choice.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define PLUMBLINE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#define PLUMBLINE_WIDE_CLONES                                                                      \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define PLUMBLINE_WIDE_TARGET __attribute__((target("arch=x86-64-v4")))
#else
#define PLUMBLINE_VECTOR_CLONES
#define PLUMBLINE_WIDE_CLONES
#define PLUMBLINE_WIDE_TARGET
#endif

namespace plumbline::algebra
{
  /// As many values as a vector register holds, for sources that are one hot loop.
  constexpr int simd_width = 4;
  using Simd = double __attribute__((vector_size(simd_width * sizeof(double))));

  /// The same for the widest registers: functions of it are PLUMBLINE_WIDE_TARGET, and called where
  /// has_wide_registers().
  constexpr int wide = 8;
  using Wide = double __attribute__((vector_size(wide * sizeof(double))));

  inline bool has_wide_registers()
  {
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
    return __builtin_cpu_supports("x86-64-v4") != 0;
#else
    return false;
#endif
  }

  template <typename Values = Simd>
  [[gnu::always_inline]] inline Values load(const double *from)
  {
    Values values;
    std::memcpy(&values, from, sizeof(Values));
    return values;
  }
} // namespace plumbline::algebra
