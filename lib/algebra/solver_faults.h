#pragma once

#include <string>

namespace plumbline::algebra
{
  // What goes wrong in solvers of others, in words for those who wrote the scene: what happened,
  // the remedy, and last, in brackets, what the solver says itself.

  /// Of MUMPS' INFOG(1) < 0 and INFOG(2) (MUMPS 5 Users' guide, ch. 8).
  std::string mumps_fault(int code, int detail);

  /// Of an iteration that has not come to its tolerance.
  /// @param residual, tolerance  relative
  std::string iteration_fault(unsigned int n_iterations, unsigned int most_iterations,
                              double residual, double tolerance);

  /// Of a library's exception: the first line of its text that says something.
  std::string library_fault(const std::string &text);
} // namespace plumbline::algebra
