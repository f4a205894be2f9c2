#include "scene/checks.h"

#include "base/error.h"
#include "base/text_file.h"
#include "physics/expression.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    /// Beyond this ratio a stencil alone takes gigabytes.
    constexpr double most_ratio = 2000;

    /// Requirements of Study/variable.
    void check_variable(const Scene &scene)
    {
      const StudySection &study = scene.study;
      const std::string regime = "Study/regime = variable", key = "Study/variable";
      if (study.regime != Regime::variable)
      {
        require(study.variable.empty() && study.values.empty(),
                key + " and Study/values are for " + regime + "; write that, or clear both");
        return;
      }
      std::string names;
      for (const uq::Variable &one : scene.random.variables)
        names += (names.empty() ? "" : ", ") + one.name;
      require(std::any_of(scene.random.variables.begin(), scene.random.variables.end(),
                          [&](const uq::Variable &one) { return one.name == study.variable; }),
              key + " = '" + study.variable + "' is not one of Random/variables" +
                  (names.empty() ? ", which is empty" : " (" + names + ")") +
                  "; name it there, e.g. 'nu: uniform 0.25 0.49', and in an expression or in "
                  "Random/keys");
      require(!study.values.empty(), regime + " needs Study/values, which is empty");
      for (std::size_t i = 0; i < study.values.size(); ++i)
        require(std::isfinite(study.values[i]) && (i == 0 || study.values[i - 1] < study.values[i]),
                "Study/values must be finite and strictly increasing; " +
                    short_number(study.values[i]) + " does not");
      require(!scene.sampling.is_there(),
              regime + " with Sampling/rule = " + scene.sampling.rule_words() +
                  ": both vary variables; write Sampling/rule = none, or another regime");
      require(!scene.crack.is_there() && !scene.fracture.is_there() && !scene.strip.is_there(),
              regime +
                  " is for statics, transient analysis, stability and dispersion; for fracture use "
                  "samples (Sampling/rule = equidistant), or write another regime");
    }

    /// Hint for two increasing whole numbers, e.g. h = 1,5, which may be one decimal number.
    std::string hint_of_order(const Series &series, std::size_t i, bool is_h)
    {
      const auto text = [&](const Level &level)
      { return short_number(is_h ? level.h : level.horizon); };
      return comma_hint(text(series.levels[i - 1]) + "," + text(series.levels[i]));
    }

    /// Levels run from coarse to fine without repetition, which observed orders and names rely on.
    void check_order(const Scene &scene)
    {
      const bool is_h = scene.study.regime != Regime::horizon;
      std::set<std::string> names;
      for (const Series &series : scene.study.series)
      {
        if (!names.insert(series.name).second)
          throw InputError("Study: the series '" + series.name +
                           "' occurs twice; give each ratio, horizon or mesh size once");
        for (std::size_t i = 1; scene.study.regime != Regime::variable && i < series.levels.size();
             ++i)
          if (!(is_h ? series.levels[i].h < series.levels[i - 1].h
                     : series.levels[i].horizon < series.levels[i - 1].horizon))
            throw InputError(std::string(is_h ? "Study/h" : "Study/horizon") +
                             " must be strictly decreasing (series '" + series.name +
                             "'); write the coarsest level first, such as 0.1, 0.05, 0.025" +
                             hint_of_order(series, i, is_h));
      }
      std::set<std::string> cases;
      for (const std::string &name : scene.problem.case_names())
        if (!cases.insert(name).second)
          throw InputError("Problem: two cases are called '" + name +
                           "'; write 'name: expression; name: expression' with different names");
    }
  } // namespace

  void check_levels(const Scene &scene)
  {
    check_variable(scene);
    check_order(scene);
    for (const Series &series : scene.study.series)
      for (const Level &level : series.levels)
      {
        std::ostringstream message;
        if (!(level.h > 0))
          message << "Study/h = " << level.h << " must be a positive length";
        else if (level.horizon > most_ratio * level.h)
          message << "the horizon " << level.horizon << " is " << level.horizon / level.h
                  << " mesh sizes, more than " << most_ratio
                  << "; choose a larger h or a smaller horizon (Study)";
        else if (level.horizon < level.h * (1 - 1e-12))
          message << "the horizon " << level.horizon << " is smaller than the mesh size " << level.h
                  << " (m = " << level.horizon / level.h
                  << "), so a node has no neighbours; use m = horizon / h >= 1 "
                     "(Study/m, Study/horizon, Study/h)";
        else if (scene.domain.collar &&
                 *scene.domain.collar < scene.reach(level.horizon) * (1 - 1e-12))
          message << "Domain/interaction domain = " << *scene.domain.collar << " is thinner than "
                  << (scene.has_dilatation() ? "twice the horizon, which the dilatation needs, "
                                             : "the horizon ")
                  << scene.reach(level.horizon)
                  << ", so that balls would contain points without data; increase it or write auto";
        else
        {
          if (scene.domain.is_in_space() && scene.domain.mesh.is_lattice())
            (void)scene.domain.cubes(level.h);
          else if (!scene.domain.is_in_space() && scene.domain.mesh.is_of_boxes() &&
                   !scene.strip.is_there())
            (void)scene.domain.lattice(level.h);
          continue;
        }
        throw InputError(message.str());
      }
  }

  namespace
  {
    /// Of models that have their constants in Material: names only the keys that are wrong.
    void check_influence(const Scene &scene)
    {
      const KernelSection &kernel = scene.kernel;
      std::vector<std::string> remedies;
      if (kernel.structure != physics::Structure::scalar)
        remedies.push_back("write a scalar Kernel/type (1/r, constant, ...), not '" + kernel.type +
                           "'");
      if (kernel.limit != Limit::navier)
        remedies.push_back("write Kernel/limit = Navier, not " + base::word(kernel.limit));
      if (!kernel.coefficient.empty() || !kernel.materials.empty())
        remedies.emplace_back("clear Kernel/coefficient and Kernel/materials");
      require(remedies.empty(), "Material/model = " + scene.material.model->name() +
                                    " uses Kernel/type as its influence function and takes its "
                                    "constants from Material; " +
                                    join(remedies, ", and "));
    }

    void check_kernel(const Scene &scene)
    {
      scene.material.model->check_constants(scene);
      const KernelSection &kernel = scene.kernel;
      const bool is_navier = kernel.limit == Limit::navier;
      if (scene.material.model->takes_influence())
        check_influence(scene);
      require(!is_navier || scene.is_vector(),
              "Kernel/limit = Navier does not fit the scalar kernel '" + kernel.type +
                  "'; choose a bond tensor (Kernel/type), a model with an influence function "
                  "(Material/model = LPS, variational or double well) or a Laplace limit");
      require(!scene.is_vector() || is_navier || kernel.limit == Limit::none,
              "Kernel/limit = '" + base::word(kernel.limit) + "' does not fit the bond tensor '" +
                  kernel.type + "'; write Kernel/limit = Navier, or none");
    }

    void check_components(const std::string &key, const std::string &text, unsigned int n,
                          const std::string &needed_by,
                          const physics::Names &names = {{"delta", 1}})
    {
      const physics::Expression parsed(key, text, names);
      const std::string given = key + " = '" + text + "' has " +
                                std::to_string(parsed.n_components()) + " component(s), ";
      require(parsed.n_components() == n,
              given +
                  (needed_by.empty() ? "not " + std::to_string(n)
                                     : "but the " + needed_by + " needs " + std::to_string(n) +
                                           "; give one expression a component, separated by "
                                           "','") +
                  comma_hint(text));
    }

    void check_problem(const Scene &scene)
    {
      const unsigned int n = scene.n_components();
      const ProblemSection &problem = scene.problem;
      const std::string needed_by = scene.domain.dimension == 1               ? "line"
                                    : scene.material.model->takes_influence() ? "solid"
                                    : scene.is_vector()                       ? "bond tensor"
                                                                              : "scalar kernel";
      const auto check = [&](const std::string &key, const std::string &text)
      { check_components(key, text, n, needed_by, scene.names(1)); };
      for (const NamedExpression &solution : problem.solutions)
        check("Problem/solution", solution.expression);
      for (const NamedExpression &load : problem.loads)
        check("Problem/load", load.expression);
      if (problem.constraint)
        check("Problem/constraint", *problem.constraint);
      if (problem.local_solution == LocalSolution::expression)
        check("Problem/local solution", problem.local_expression);
      const auto check_start = [&](const std::string &key, const std::string &text)
      {
        auto names = scene.names(1);
        names.constants["h"] = 1; // of the level
        if (!text.empty())
          check_components(key, text, n, needed_by, names);
      };
      check_start("Time/initial displacement", scene.time.initial_displacement);
      check_start("Time/initial velocity", scene.time.initial_velocity);

      const std::size_t n_solutions = problem.solutions.size(), n_loads = problem.loads.size();
      if (scene.is_no_problem() && n_solutions == 0)
        return; // see check_motion, check_fracture and check_strip
      require(n_solutions + n_loads > 0,
              "Problem/load = manufactured needs Problem/solution; give the solution, or the load "
              "itself");
      require(
          n_solutions > 0 || problem.constraint,
          "Problem/constraint = solution, but Problem/solution is empty; give the constraint as "
          "an expression");
      require(n_loads == 0 || n_solutions == 0 || n_loads == n_solutions,
              "Problem/load has " + std::to_string(n_loads) + " cases and Problem/solution has " +
                  std::to_string(n_solutions) + "; give one load for each solution");
    }

    void check_coefficient(const Scene &scene)
    {
      const KernelSection &kernel = scene.kernel;
      require(kernel.materials.empty() || scene.domain.mesh.is_file(),
              "Kernel/materials is given with Domain/mesh = " + scene.domain.mesh.name +
                  ": materials are the physical surfaces of a .msh or .geo file; write "
                  "Kernel/coefficient");
      require(kernel.materials.empty() || kernel.coefficient.empty(),
              "Kernel/materials and Kernel/coefficient are both given; clear one of them");
      const auto check = [](const std::string &key, const std::string &text, unsigned int n,
                            const physics::Names &names = {{"delta", 1}})
      {
        if (!text.empty())
          check_components(key, text, n, "", names);
      };
      check("Kernel/coefficient", kernel.coefficient, 1, scene.names(1));
      check("Domain/inside", scene.domain.mesh.inside, 1);
      check("Domain/outside", scene.domain.outside, 1);
      check("Domain/map", scene.domain.mesh.map, 2);
    }
  } // namespace

  bool is_inverse_distance(const KernelSection &kernel)
  {
    return kernel.type == "1/r";
  }

  void check_kernel_and_problem(const Scene &scene)
  {
    check_kernel(scene);
    check_problem(scene);
    check_coefficient(scene);
  }

  /// What to write where no solution is known.
  std::string without_solution(const ReferenceSection &reference)
  {
    const auto compared_with = [](const std::string &target) {
      return "write Study/norms = averages L2 and Study/decisive error = averages L2 | " + target;
    };
    if (reference.method)
      return "to compare with the reference, " + compared_with("reference");
    return "give the solution; or, to compare each method with its own finest level, " +
           compared_with("own finest level") +
           "; or give a Galerkin method as Reference/method, and the target reference";
  }

  void check_norms(const Scene &scene)
  {
    if (scene.is_no_problem())
      return; // see check_motion, check_fracture and check_strip
    const StudySection &study = scene.study;
    const ReferenceSection &reference = scene.reference;
    const auto [norm, target] = study.decisive_error;
    const bool is_of_averages = quantity(norm) == Quantity::averages;
    const LocalSolution local = scene.problem.local_solution;
    const std::string decisive = "Study/decisive error = '" + study.decisive_error.text() + "'";
    require(std::find(study.norms.begin(), study.norms.end(), norm) != study.norms.end(),
            decisive + " must be 'norm | target' with a norm of Study/norms (add it there) and a "
                       "target of exact, local, reference, own finest level");
    const bool is_of_equations = quantity(norm) == Quantity::truncation ||
                                 quantity(norm) == Quantity::bound ||
                                 quantity(norm) == Quantity::energy;
    require(
        !is_of_equations || target == Target::exact || target == Target::local,
        decisive +
            ": truncation errors, the bounds that follow from them, and energies of errors need a "
            "known solution; use the target exact or local");
    require(target != Target::exact || !scene.problem.solutions.empty(),
            decisive + " needs Problem/solution, which is empty; " + without_solution(reference));
    require(target != Target::local || local != LocalSolution::computed || is_of_averages,
            decisive + ": a computed local solution is compared by cell averages; use averages L2 "
                       "or averages Linf");
    require(target != Target::local ||
                (local != LocalSolution::solution && local != LocalSolution::none),
            decisive + " needs Problem/local solution as an expression; if it equals the solution, "
                       "use the target exact");
    require(target != Target::reference || reference.method,
            decisive + " needs Reference/method, which is none");
    require(target != Target::finest || is_of_averages,
            decisive + ": solutions of two levels are compared by cell averages; use "
                       "averages L2 or averages Linf");
    require(target != Target::finest || !is_without_limit(study.regime),
            decisive + " with Study/regime = " + base::word(study.regime) +
                ": nothing is refined there; use the target exact or reference, or another regime");
    require(target != Target::reference || is_of_averages,
            decisive + ": solutions are compared with a reference by cell averages; use averages "
                       "L2 or averages Linf");
    require(reference.h == 0 || reference.method,
            "Reference/mesh size = " + short_number(reference.h) +
                " needs Reference/method, which is none; name a Galerkin method or clear "
                "Reference/mesh size");
    require(
        reference.h == 0 || (scene.domain.mesh.is_of_boxes() && scene.domain.dimension == 2),
        "Reference/mesh size = " + short_number(reference.h) +
            " needs a mesh of Domain/boxes in two dimensions (Domain/mesh = lattice, squares or "
            "triangles); clear Reference/mesh size, so that each level has its own reference");
    require(reference.tolerance == 0 || (reference.method && reference.estimate != Estimate::none),
            "Reference/tolerance = " + short_number(reference.tolerance) +
                " needs a reference and the estimate of its error; give Reference/method and write "
                "Reference/estimate = automatic, or set the tolerance to 0");
  }

  void check_solver(const Scene &scene)
  {
    using base::Iteration;
    using base::SparseSolver;
    const SolverSection &solver = scene.solver;
    const bool is_free = scene.domain.is_free_body;
    const bool is_chosen = solver.iteration != Iteration::automatic;
    const bool is_scattered =
        (!scene.domain.mesh.is_lattice() && !is_free) ||
        (scene.domain.is_in_space() && !scene.methods.nodes.are_lattice_centres());
    const std::string iteration = "Solver/iteration = " + base::word(solver.iteration),
                      kept = "Solver/dilatation = mixed";
    require(!is_chosen || solver.linear_solver != SparseSolver::direct,
            iteration + ", but Solver/linear solver = direct does not iterate; write "
                        "Solver/iteration = automatic, or another linear solver");
    require(!is_chosen || solver.iteration == Iteration::cg || is_scattered,
            iteration + " on a " + (is_free ? "free body" : "lattice") +
                ": its operator is symmetric positive definite; write automatic or cg");
    if (!solver.is_mixed)
      return;
    require(scene.has_dilatation(),
            kept + ", but the model has none, being that of state-based solids with lambda != mu; "
                   "write condensed, or Material/model = LPS");
    require(is_scattered, kept + " is for scattered nodes, not for lattices and free bodies; write "
                                 "condensed, or Domain/mesh = squares with an interaction domain");
    require(solver.linear_solver != SparseSolver::jacobi,
            kept + " makes a system that jacobi does not precondition; write Solver/linear solver "
                   "= automatic, direct or amg");
    require(solver.iteration != Iteration::cg,
            kept + " makes a system that is not symmetric, as cg needs it; write Solver/iteration "
                   "= automatic, gmres or bicgstab");
  }
} // namespace plumbline::scene
