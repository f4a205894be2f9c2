#include "scene/problem.h"

#include "base/cost.h"
#include "base/error.h"
#include "scene/manufactured_load.h"
#include "scene/mesh.h"
#include "scene/models/model.h"

#include <stdexcept>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;
    using physics::ChebyshevField;
    using physics::Expression;

    /// A field of an expression, with its series on the bounding box of Ω where it is smooth.
    /// What is made of pieces is taken as it is: no number of points shows where they end.
    Field with_series(const Expression &expression, unsigned int n_components, const Extent &extent)
    {
      Field field{expression, std::nullopt};
      if (expression.is_piecewise())
        return field;
      try
      {
        field.series = series_of(field.value, n_components, extent.box, extent, 0);
      }
      catch (const std::runtime_error &) // in a hole of the domain the field may have no value
      {
        if (extent.is_rectangle)
          throw;
      }
      return field;
    }

    Field zero(unsigned int n_components, const geometry::Box &box)
    {
      const auto value = [](const Point<2> &, unsigned int) { return 0.; };
      return {value, ChebyshevField::resolve(value, n_components, box.lower, box.upper)};
    }

    problem::MethodSettings method_settings(const Scene &scene)
    {
      // the local limit has the second moments alone; the nonlocal operator has all
      constexpr unsigned int of_local_limit = 2, of_nonlocal = 6;
      const Regime regime = scene.study.regime;
      const unsigned int ball_order = regime == Regime::m         ? of_nonlocal
                                      : regime == Regime::delta_m ? of_local_limit
                                                                  : 0;
      return {scene.methods.nodes.are_vertices(),
              scene.methods.loads_are_averages,
              regime == Regime::delta,
              ball_order,
              scene.quadrature,
              scene.geometry,
              scene.solver};
    }

    /// What does not follow from cells or fields.
    Problem without_data(const Scene &scene, const Level &level, const physics::Kernel<2> &kernel)
    {
      const std::string &mesh = scene.domain.mesh.name;
      Problem problem{{}, {}, {}, {}, mesh, level.h, kernel, {}, {}, kernel.n_components(),
                      {}, {}, {}, {}};
      problem.dimension = scene.domain.dimension;
      problem.is_load_given = !scene.problem.loads.empty();
      problem.is_homogeneous = scene.is_homogeneous();
      problem.is_periodic = scene.domain.is_periodic;
      problem.is_floating = scene.domain.is_floating;
      problem.has_collar_dilatation = scene.material.has_collar_dilatation;
      problem.damage = {scene.domain.cracks, scene.domain.outside,
                        scene.material.surface_terms == SurfaceTerms::automatic
                            ? SurfaceTerms::published
                            : scene.material.surface_terms,
                        scene.domain.origin};
      scene.material.model->complete(scene, level, problem);
      problem.settings = method_settings(scene);
      problem.origin = scene.domain.origin;
      return problem;
    }

    /// On its lattice, or on a mesh with the cells of its nodes.
    void put_in_place(const Scene &scene, const Level &level, Problem &problem)
    {
      base::CpuTimer timer;
      if (scene.domain.is_free_body)
      {
        const geometry::VertexCells body = make_body(scene, level);
        problem.body = body.lattice;
        problem.cells = body.cells;
        problem.mesh = body.mesh;
        problem.mesh_seconds = timer.seconds();
      }
      else if (scene.domain.mesh.is_lattice())
        problem.lattice = scene.domain.lattice(level.h);
      else
      {
        problem.mesh = std::make_shared<const geometry::Mesh>(make_mesh(scene, level));
        problem.mesh_seconds = timer.seconds();
        timer.restart();
        problem.cells = std::make_shared<const geometry::NodeCells>(
            make_node_cells(scene, level, *problem.mesh));
        problem.cells_seconds = timer.seconds();
      }
    }
  } // namespace

  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level, double t,
                       const Field *known_load, const Problem *same_place)
  {
    const physics::Kernel<2> kernel = make_kernel(scene, level.horizon);
    const unsigned int n_components = kernel.n_components();
    Problem problem = without_data(scene, level, kernel);
    if (same_place != nullptr)
    {
      problem.lattice = same_place->lattice;
      problem.mesh = same_place->mesh;
      problem.cells = same_place->cells;
      problem.body = same_place->body;
      problem.mesh_seconds = same_place->mesh_seconds;
      problem.cells_seconds = same_place->cells_seconds;
    }
    else
      put_in_place(scene, level, problem);
    if (problem.mesh)
      problem.coefficient = make_coefficient(scene, *problem.mesh);
    const Extent omega = extent(problem);
    const auto expression = [&](const std::string &key, const std::string &text)
    { return Expression(key, text, scene.names(level.horizon, t)); };
    const auto field = [&](const std::string &key, const std::string &text)
    { return with_series(expression(key, text), n_components, omega); };

    if (!scene.problem.solutions.empty())
      problem.solution = field("Problem/solution", scene.problem.solutions[case_index].expression);
    if (scene.problem.constraint)
      problem.constraint.value = expression("Problem/constraint", *scene.problem.constraint);
    else
      problem.constraint = problem.solution ? *problem.solution : zero(n_components, omega.box);
    if (scene.problem.local_solution == LocalSolution::expression)
      problem.local_solution = field("Problem/local solution", scene.problem.local_expression);

    if (known_load != nullptr)
      problem.load = *known_load;
    else if (problem.is_load_given)
      problem.load = field("Problem/load", scene.problem.loads[case_index].expression);
    else if (!problem.solution)
      problem.load = zero(n_components, omega.box);
    else
      problem.load = manufactured_load(
          problem, expression("Problem/solution", scene.problem.solutions[case_index].expression),
          omega);
    return problem;
  }

  Case make_case(const Scene &scene, unsigned int case_index, const Level &level)
  {
    return {scene, case_index, make_problem(scene, case_index, level)};
  }

  std::function<double(const Point<2> &, unsigned int)> operator_on_solution(const Case &one)
  {
    const Problem &problem = one.problem;
    const Expression u("Problem/solution", one.scene.problem.solutions[one.index].expression,
                       one.scene.names(problem.horizon(), 0));
    return plain_load(problem, u);
  }
} // namespace plumbline::scene
