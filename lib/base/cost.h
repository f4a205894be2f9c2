#pragma once

#include <cstddef>
#include <cstdint>

namespace plumbline::base
{
  /// What one solve cost. CPU seconds are summed over threads and ranks; they, not wall time, are
  /// compared. Not in it: comparing, and manufacturing the load from a solution that is smooth,
  /// which all methods share; a load that is not smooth is evaluated point by point, in the solve.
  struct Cost
  {
    double setup_seconds = 0;   ///< stencil or matrix entries, transforms planned [CPU s]
    double solve_seconds = 0;   ///< right-hand side and solver [CPU s]
    std::size_t peak_bytes = 0; ///< largest resident memory above what stood before, of any rank
    std::size_t n_unknowns = 0; ///< degrees of freedom solved for
    std::uint64_t n_bonds = 0;  ///< pairs that one operator application sums over
    unsigned int n_iterations = 0;

    double seconds() const { return setup_seconds + solve_seconds; }
  };

  /// CPU time of the whole process since construction (or the last restart) [s].
  class CpuTimer
  {
  public:
    CpuTimer() { restart(); }
    void restart();
    double seconds() const;

  private:
    double start_;
  };

  /// Peak resident memory above the level at construction [bytes]. Uses the kernel's high-water
  /// mark, which the constructor resets; where that is not allowed, growth of the process-wide
  /// peak.
  class MemoryGauge
  {
  public:
    MemoryGauge();
    std::size_t peak_bytes() const;

  private:
    std::size_t start_;
  };
} // namespace plumbline::base
