#include "scene/problem.h"

#include "base/error.h"
#include "physics/load.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::scene
{
  namespace
  {
    using physics::ChebyshevField;
    using physics::Expression;

    /// Add the series to a field, if it is smooth on the bounding box of Ω.
    Field with_series(ChebyshevField::Function value, unsigned int n_components,
                      const geometry::Lattice &lattice, double noise)
    {
      Field field{std::move(value), std::nullopt};
      const auto &n = lattice.n_cells();
      try
      {
        field.series = ChebyshevField::resolve(field.value, n_components, lattice.origin(),
                                               lattice.point(n[0], n[1]), noise);
      }
      catch (const std::runtime_error &)
      {
        // the bounding box of Ω may hold points, in a hole, where the field has no value
        if (lattice.is_rectangle())
          throw;
      }
      return field;
    }

    Field expression_field(const std::string &key, const std::string &text,
                           unsigned int n_components, const geometry::Lattice &lattice,
                           double horizon)
    {
      const Expression expression(key, text, {{"delta", horizon}});
      return with_series(expression, n_components, lattice, 0);
    }

    /// The largest value of a field over the cells of Ω, roughly: for noise levels.
    double magnitude(const Field &field, unsigned int n_components,
                     const geometry::Lattice &lattice)
    {
      const auto &n = lattice.n_cells();
      constexpr int samples = 8;
      double largest = 0;
      for (int j = 0; j <= samples; ++j)
        for (int i = 0; i <= samples; ++i)
          if (lattice.is_inside(i * (n[0] - 1) / samples, j * (n[1] - 1) / samples))
            for (unsigned int c = 0; c < n_components; ++c)
              largest = std::max(largest,
                                 std::abs(field.value(lattice.point(i * (n[0] - 1) / samples + .5,
                                                                    j * (n[1] - 1) / samples + .5),
                                                      c)));
      return largest;
    }
  } // namespace

  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level)
  {
    const geometry::Lattice lattice(scene.domain, level.h);
    const physics::Kernel<2> kernel = scene.kernel(level.horizon);
    const unsigned int n_components = kernel.n_components();
    Problem problem{lattice, kernel, n_components, {}, {}, {}, {}};
    const auto field = [&](const std::string &key, const std::string &text)
    { return expression_field(key, text, n_components, lattice, level.horizon); };

    if (!scene.solutions.empty())
      problem.solution = field("Problem/solution", scene.solutions[case_index].expression);
    problem.constraint = scene.constraint == "solution"
                             ? *problem.solution
                             : field("Problem/constraint", scene.constraint);
    if (scene.local_solution == "solution")
      problem.local_solution = problem.solution;
    else if (scene.local_solution != "none")
      problem.local_solution = field("Problem/local solution", scene.local_solution);

    if (!scene.loads.empty())
      problem.load = field("Problem/load", scene.loads[case_index].expression);
    else
    {
      const physics::ManufacturedLoad load(
          kernel, Expression("Problem/solution", scene.solutions[case_index].expression,
                             {{"delta", level.horizon}}));
      const double noise = 2 * std::numeric_limits<double>::epsilon() *
                           physics::operator_scale(kernel) *
                           magnitude(*problem.solution, n_components, lattice);
      problem.load = with_series(load, n_components, lattice, noise);
    }
    return problem;
  }
} // namespace plumbline::scene
