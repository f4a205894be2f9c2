#include "study/motion_steps.h"

#include "base/error.h"
#include "base/number_text.h"
#include "method/box_discretisation.h"
#include "method/discretisation.h"
#include "study/motion_data.h"
#include "study/motion_estimate.h"
#include "study/transient.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  using analysis::Scheme;
  using analysis::Transient;

  std::string StepRule::text(int n_digits) const
  {
    const std::string number = base::to_text(value, n_digits);
    return is_fraction ? number + " of critical" : "dt = " + number;
  }

  std::vector<StepRule> step_rules(const scene::TimeSection &time)
  {
    std::vector<StepRule> rules;
    for (const double value : time.steps.empty() ? time.fractions : time.steps)
      rules.push_back({value, time.steps.empty()});
    return rules;
  }

  double step_of(const StepRule &rule, const Transient &transient, const Scheme &scheme)
  {
    if (!rule.is_fraction)
      return rule.value;
    const double own = transient.critical_step(scheme);
    return rule.value * (own > 0 && std::isfinite(own)
                             ? own
                             : transient.critical_step(analysis::scheme("velocity Verlet")));
  }

  namespace
  {
    template <int dim>
    void check_steps(const scene::Scene &scene, const Method &method,
                     const problem::Problem<dim> &problem, const base::Communicator &ranks)
    {
      decltype(discretise(method, problem)) discretisation;
      try
      {
        discretisation = discretise(method, problem);
      }
      catch (const NumericalError &)
      {
        return; // a finding of the run
      }
      share_motion(scene, method, *discretisation, ranks);
      const auto equation = discretisation->motion(scene.time.is_lumped);
      if (!equation)
        throw InputError("Time/final time = " + base::to_text(scene.time.final_time, 4) + ": " +
                         method.name() +
                         " has no transient analysis here; leave it out, or write 0");
      const Transient transient(*equation, analysis::TimeSeries(equation->drive(problem)),
                                scene.time.density, scene.time.damping);
      for (const std::string &name : scene.time.schemes)
      {
        const Scheme &scheme = analysis::scheme(name);
        if (scheme.is_implicit() && !(equation->has_tangent() && equation->is_symmetric()))
          throw InputError("Time/schemes: '" + name +
                           "' needs a symmetric tangent of forces, which " + method.name() +
                           " does not have here; take explicit ones, or leave the method out");
        const double critical = transient.critical_step(scheme);
        for (const StepRule &rule : step_rules(scene.time))
          if (const double step = step_of(rule, transient, scheme);
              !scene.time.shows_blow_up && std::isfinite(critical) && step > critical)
            throw InputError(
                std::string(rule.is_fraction ? "Time/critical fractions" : "Time/steps") + ": " +
                rule.text() + " with the scheme " + name + " is a step of " +
                base::to_text(step, 5) + " by " + method.name() +
                " at h = " + base::to_text(problem.level().h, 4) +
                ", longer than the critical one, " + base::to_text(critical, 5) +
                (critical > 0 ? ", so that errors grow without bound; shorten it"
                              : ": the scheme is unstable at any step; take another") +
                ", or write Time/show blow-up = true");
      }
    }

    /// That expressions are resolved in time.
    template <int dim>
    void check_times(const scene::Scene &scene)
    {
      for (unsigned int c = 0; c < scene.problem.case_names().size(); ++c)
      {
        const problem::Level &level = scene.study.series.front().levels.front();
        const scene::Scene here = at_level(scene, level);
        typename ProblemsInTime<dim>::Loads loads;
        (void)ProblemsInTime<dim>(here, c, level, loads).points_in_time();
      }
    }
  } // namespace

  void check_transient(const scene::Scene &scene, const Methods &methods, unsigned int n_levels,
                       const base::Communicator &ranks)
  {
    for (const std::string &name : scene.time.schemes)
      try
      {
        (void)analysis::scheme(name);
      }
      catch (const InputError &error)
      {
        throw InputError(std::string("Time/schemes: ") + error.what());
      }
    const auto check_level = [&](const problem::Level &level)
    {
      const scene::Scene here = at_level(scene, level);
      const auto check = [&](const auto &problem)
      {
        for (const auto &method : methods)
          check_steps(here, *method, problem, ranks);
      };
      here.domain.is_in_space() ? check(make_problem_in_space(here, 0, level))
                                : check(make_problem(here, 0, level));
    };
    if (!scene.is_steady()) // else it would be said when much is done
      scene.domain.is_in_space() ? check_times<3>(scene) : check_times<2>(scene);
    for (const problem::Series &series : scene.study.series)
    {
      const std::size_t n_all = series.levels.size(),
                        n = n_levels == 0 ? n_all : std::min<std::size_t>(n_levels, n_all);
      // critical steps are the shortest at the finest level; of a variable nothing is known
      const bool is_any = scene.study.regime == scene::Regime::variable;
      for (std::size_t level = is_any ? 0 : n - 1; level < n; ++level)
        check_level(series.levels[level]);
    }
  }
} // namespace plumbline::study
