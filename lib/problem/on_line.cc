#include "problem/on_line.h"

#include "base/control_points.h"
#include "base/error.h"
#include "physics/load_on_line.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace plumbline::problem
{
  namespace
  {
    void check_finite(const std::string &name, const Field<1> &field, double x)
    {
      if (const double value = field.value(dealii::Point<1>(x), 0); !std::isfinite(value))
      {
        std::ostringstream message;
        message << "the " << name << " is " << value << " at x = " << x
                << "; give a field that is finite in the domain and within a horizon around it";
        throw InputError(message.str());
      }
    }

    void check_samples(const Problem<1> &problem)
    {
      constexpr unsigned int n_samples = 32;
      const double horizon = problem.horizon();
      for (const geometry::Interval &piece : problem.lattice.pieces())
        for (const double s : base::control_points(n_samples))
        {
          check_finite("load", problem.load, piece.lower + s * (piece.upper - piece.lower));
          for (const double from : {piece.lower - horizon, piece.upper})
            if (const double x = from + s * horizon; !problem.lattice.cell_at(x))
              check_finite("constraint", problem.constraint, x);
        }
    }
  } // namespace

  Problem<1> complete(Problem<1> problem)
  {
    if (problem.kernel.n_components() > 1 ||
        problem.kernel.structure() != physics::Structure::scalar)
      throw InputError(
          "problem on intervals: the kernel is a bond tensor, which in one dimension is the same "
          "operator as the scalar kernel; give a scalar kernel");
    if (!problem.load.value && !problem.solution)
      throw InputError("problem on intervals: no load, and no solution to compute it from; "
                       "give one of them");
    if (!problem.constraint.value && !problem.solution)
      throw InputError("problem on intervals: no constraint and no solution; give one "
                       "of them");
    problem.is_load_given = static_cast<bool>(problem.load.value);
    if (!problem.is_load_given)
      problem.load.value = physics::load_on_line(problem.kernel, problem.solution->value);
    if (!problem.constraint.value)
      problem.constraint = *problem.solution;
    check_samples(problem);
    return problem;
  }

  Problem<1> at_spacing(Problem<1> problem, double h)
  {
    problem.lattice = problem.lattice.at_spacing(h);
    return problem;
  }
} // namespace plumbline::problem
