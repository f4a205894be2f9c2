#pragma once

#include "problem/problem.h"

namespace plumbline::problem
{
  /// A problem that is being posed: set what it has, then build(). Empty load: manufactured from
  /// the solution, or 0 without one. Empty constraint: the solution, or 0 without one.
  ///
  ///     ProblemBuilder given({geometry::Lattice({{square}, {}}, h)}, kernel);
  ///     given.load.value = [](const Point<2> &x, unsigned int) { return x[0]; };
  ///     const Problem<2> problem = given.build();
  struct ProblemBuilder : Problem<2>
  {
    /// @param h  of cells; 0: that of the lattice, or of a mesh √ of the mean area of its cells
    ProblemBuilder(Domain domain, physics::Kernel<2> kernel, double h = 0);

    /// The problem with its fields as series where they are smooth (not those that are said to be
    /// piecewise), checked on samples.
    /// @throws InputError  naming what is wrong, its value, what is allowed and the remedy: h, an
    /// interaction domain that is narrower than bonds reach, a material that does not fit the
    /// kernel or the domain, values that are not finite in Ω or in the interaction domain
    Problem<2> build() const;
  };
} // namespace plumbline::problem
