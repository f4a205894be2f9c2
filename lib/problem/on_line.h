#pragma once

#include "geometry/interval_lattice.h"
#include "physics/kernel.h"
#include "problem/problem.h"

#include <functional>
#include <optional>

namespace plumbline::problem
{
  /// A field on a line, given pointwise.
  template <>
  struct Field<1>
  {
    std::function<double(const dealii::Point<1> &, unsigned int component)> value;
  };

  /// A boundary-value problem on a union of intervals at one level: a scalar kernel of a
  /// homogeneous material, with u given all around. Set the known members; call complete().
  template <>
  struct Problem<1>
  {
    geometry::IntervalLattice lattice; ///< whose cells solutions are averaged over: they fill Ω
    physics::Kernel<1> kernel;         ///< scalar
    static constexpr unsigned int n_components = 1;
    Field<1> load = {};                          ///< empty: manufactured from the solution
    Field<1> constraint = {};                    ///< around Ω; empty: the solution
    std::optional<Field<1>> solution = {};       ///< the exact nonlocal solution, if known
    std::optional<Field<1>> local_solution = {}; ///< of the local limit, if known and another
    bool is_load_given = true;                   ///< else it is manufactured from the solution
    MethodSettings settings = {};

    double h() const { return lattice.h(); }
    double horizon() const { return kernel.horizon(); }
    Level level() const { return {h(), horizon()}; }
  };

  /// The problem with its fields, checked on samples.
  /// @throws InputError  neither a load nor a solution, neither a constraint nor a solution; a
  /// bond tensor; values that are not finite in Ω or within a horizon around it
  Problem<1> complete(Problem<1> problem);

  /// The problem on cells of another length, with the same fields.
  /// @throws InputError  ends that are not multiples of h apart
  Problem<1> at_spacing(Problem<1> problem, double h);
} // namespace plumbline::problem
