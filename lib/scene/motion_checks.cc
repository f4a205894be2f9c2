#include "base/control_points.h"
#include "base/error.h"
#include "physics/expression.h"
#include "scene/capabilities.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::scene
{
  namespace
  {
    void check_torus(const Scene &scene)
    {
      const DomainSection &domain = scene.domain;
      const auto needs = [](bool is_good, const std::string &what)
      { require(is_good, "Domain/boundary = periodic needs " + what); };
      needs(domain.boxes.include.size() == 1 && domain.boxes.exclude.empty(),
            "one box (Domain/boxes) without holes");
      needs(domain.mesh.is_lattice(), "Domain/mesh = lattice: other nodes have no neighbours "
                                      "across the sides of the box");
      needs(!domain.collar, "Domain/interaction domain = auto: there is none");
      needs(scene.material.boundary_function == BoundaryFunction::one,
            "Material/boundary function = one: there is no boundary");
      needs(!scene.problem.constraint,
            "Problem/constraint = solution: there is no interaction domain");
    }

    constexpr std::array<double, 3> parts_of_time = {.07, .3, .9}; ///< where fields are looked at

    /// Checks at some points that a solution on a torus is periodic.
    void check_periods(const Scene &scene)
    {
      constexpr double tolerance = 1e-9; // of the largest value: rounding of sin(2πx) and the like
      constexpr std::size_t n_samples = 199, stride = 80; // without a common factor
      const geometry::Box &box = scene.domain.boxes.include.front();
      const dealii::Tensor<1, 2> side = box.upper - box.lower;
      const std::vector<double> places = base::control_points(n_samples);
      for (const NamedExpression &one : scene.problem.solutions)
      {
        double size = 0, jump = 0;
        for (const double part : parts_of_time)
        {
          const physics::Expression u("Problem/solution", one.expression,
                                      scene.names(1, part * scene.time.final_time));
          for (std::size_t i = 0; i < n_samples; ++i)
            for (unsigned int axis = 0; axis < 2; ++axis)
              for (unsigned int c = 0; c < u.n_components(); ++c)
              {
                dealii::Point<2> x = box.lower, y;
                x[0] += side[0] * places[i];
                x[1] += side[1] * places[i * stride % n_samples];
                y = x;
                y[axis] += side[axis];
                size = std::max(size, std::abs(u(x, c)));
                jump = std::max(jump, std::abs(u(y, c) - u(x, c)));
              }
        }
        require(jump <= tolerance * size,
                "Problem/solution = '" + one.expression + "' jumps by " + short_number(jump) +
                    " where Domain/boundary = periodic joins the sides of the box; give a field "
                    "with the periods " +
                    short_number(side[0]) + " and " + short_number(side[1]));
      }
    }

    /// The local limit of a transient solution is given, or made of Fourier series.
    void check_local_limit(const Scene &scene, const std::string &decisive)
    {
      const ProblemSection &problem = scene.problem;
      require(scene.study.decisive_error.target != Target::local ||
                  problem.local_solution == LocalSolution::computed ||
                  problem.local_solution == LocalSolution::expression,
              decisive +
                  ": the local limit of a transient solution is not known; give Problem/local "
                  "solution as an expression in x, y and t, or computed for double wells on "
                  "a torus; or use exact or reference");
      if (problem.local_solution != LocalSolution::computed)
        return;
      const auto needs = [](bool is_good, const std::string &what)
      {
        require(is_good, "Problem/local solution = computed in transient analyses needs " + what +
                             "; write none, or an expression in x, y and t");
      };
      needs(scene.domain.is_periodic, "Domain/boundary = periodic");
      needs(!scene.material.model->is_linear(), "Material/model = double well");
      needs(problem.loads.empty() && problem.solutions.empty(),
            "initial data only, without Problem/solution and Problem/load");
      needs(scene.time.damping == 0, "Time/damping = 0");
    }

    /// Requires the assumptions under which the bounds are proven.
    void check_bounds(const Scene &scene)
    {
      if (!scene.time.has_bounds)
        return;
      const auto needs = [](bool is_good, const std::string &what)
      { require(is_good, "Time/a priori bounds = true needs " + what); };
      needs(!scene.material.model->is_linear(),
            "Material/model = double well: the bounds hold only for these bonds");
      needs(scene.time.density == 1 && scene.time.damping == 0,
            "Time/density = 1 and Time/damping = 0, as their proof does; scale c by 1/density");
      needs(scene.domain.mesh.is_lattice(), "Domain/mesh = lattice, whose cells they refer to");
    }

    void check_targets(const Scene &scene)
    {
      const StudySection &study = scene.study;
      const std::string decisive = "Study/decisive error = '" + study.decisive_error.text() + "'";
      for (const Norm norm : study.norms)
        require(quantity(norm) == Quantity::nodal,
                "Study/norms has '" + base::word(norm) +
                    "', but transient solutions (Time/final time > 0) are compared at nodes; write "
                    "nodal L2, "
                    "nodal Linf, or both");
      require(std::find(study.norms.begin(), study.norms.end(), study.decisive_error.norm) !=
                  study.norms.end(),
              decisive + " must be 'norm | target' with a norm of Study/norms; write 'nodal L2 | "
                         "exact', or add the norm");
      require(study.decisive_error.target != Target::finest,
              decisive + ": transient solutions are not compared with the method's own finest "
                         "level; use exact or reference");
      check_local_limit(scene, decisive);
      require(study.decisive_error.target != Target::reference || scene.reference.method,
              decisive + " needs Reference/method = torus");
      if (!scene.reference.method)
        return;
      const std::string given = "Reference/method = " + *scene.reference.method;
      require(scene.reference.is_torus(),
              given +
                  " is for statics; transient analyses use torus, or none and Problem/solution");
      require(scene.domain.is_periodic && !scene.material.model->is_linear(),
              given + " needs Domain/boundary = periodic and Material/model = double well");
      const geometry::Box &box = scene.domain.boxes.include.front();
      const dealii::Tensor<1, 2> side = box.upper - box.lower;
      require(scene.domain.dimension == 1 || std::abs(side[0] - side[1]) <= 1e-12 * side[0],
              given + " needs a square (Domain/boxes), and has sides of " + short_number(side[0]) +
                  " and " + short_number(side[1]));
    }
  } // namespace

  void check_motion(const Scene &scene)
  {
    if (scene.domain.dimension == 1)
    {
      require(scene.domain.is_periodic || is_on_intervals(scene),
              "Domain/dimension = 1 with Material/model = " + scene.material.model->name() +
                  " needs Domain/boundary = periodic: this model supports no other in 1D");
      check_without_y(scene);
    }
    if (scene.domain.is_periodic)
    {
      check_torus(scene);
      check_periods(scene);
    }
    scene.material.model->check_motion(scene);
    if (scene.crack.is_there())
      return check_crack(scene);
    if (scene.fracture.is_there())
      return; // see check_fracture
    const TimeSection &time = scene.time;
    const std::string torus = "Reference/method = torus";
    require(time.is_dynamic() || !scene.reference.is_torus(),
            torus + " is for transient analyses; give Time/final time, or a Galerkin method");
    if (!time.is_dynamic())
      return;
    check_analysis(scene, Analysis::transient);
    require(!scene.solver.is_mixed,
            "Time/final time = " + short_number(time.final_time) +
                " needs Solver/dilatation = condensed: a dilatation unknown has no mass");
    require(!scene.problem.solutions.empty() || !scene.problem.loads.empty() ||
                !time.initial_displacement.empty() || !time.initial_velocity.empty(),
            "Time/final time = " + short_number(time.final_time) +
                " needs initial data or a load; give Problem/solution, Problem/load, Time/initial "
                "displacement or Time/initial velocity");
    check_targets(scene);
    check_bounds(scene);
  }
} // namespace plumbline::scene
