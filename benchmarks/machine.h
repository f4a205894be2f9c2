#pragma once

#include <string>
#include <vector>

namespace plumbline::benchmarks
{
  /// What one core of this machine can do at most, measured with the vector registers that the
  /// library's own loops use.
  struct Machine
  {
    /// One level of memory.
    struct Level
    {
      std::string name;
      double capacity; ///< [bytes]
      double triad;    ///< a = b + s c, 24 bytes a number as STREAM counts them [bytes/s]
      double sum;      ///< of an array, 8 bytes a number [bytes/s]

      double bandwidth() const { return triad > sum ? triad : sum; }
    };

    std::vector<Level> levels; ///< from the second-level cache outwards; the last one is memory
    double loads = 0;          ///< from the first-level cache, at any alignment [bytes/s]
    double flop = 0;           ///< additions and multiplications of fused pairs in registers [1/s]

    /// The level that serves this many bytes again and again: the first that holds them all.
    const Level &serving(double working_set) const;
  };

  /// The best of several tries of each, about 1 CPU second. Memory: 12 times the last-level cache,
  /// at most 1.5 GB.
  /// Source: McCalpin 1995, Memory bandwidth and machine balance in current high performance
  /// computers, IEEE TCCA newsletter.
  Machine measure_machine();

  /// The larger figure of each: a machine that others use as well shows its limits now and then.
  Machine best_of(const Machine &a, const Machine &b);
} // namespace plumbline::benchmarks
