#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumbline::benchmarks
{
  /// Work whose instructions are counted.
  struct GuardKernel
  {
    std::string name;
    std::string unit;      ///< what counts are given by, e.g. "bond"
    double units_per_pass; ///< of these
    unsigned int n_passes; ///< as many as make a count of 1e5 instructions or more; a multiple of 4
    std::function<void()> pass; ///< the same work each time
  };

  /// Single calls and inner loops that nearly all time goes into. Not among them: transforms, whose
  /// plans FFTW chooses, and sparse matrices, whose loops are those of Trilinos.
  std::vector<GuardKernel> guard_kernels();
} // namespace plumbline::benchmarks
