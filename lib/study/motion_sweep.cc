#include "base/error.h"
#include "base/number_text.h"
#include "method/discretisation.h"
#include "study/dynamics.h"
#include "study/motion_data.h"
#include "study/motion_estimate.h"
#include "study/motion_norms.h"
#include "study/motion_steps.h"
#include "study/torus_reference.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plumbline::study
{
  using analysis::Scheme;
  using analysis::State;
  using analysis::Transient;
  using analysis::Vector;

  namespace
  {
    /// Somebody asked to end, in the middle of a motion.
    struct Interrupted
    {
    };

    class MotionSweep
    {
    public:
      MotionSweep(const scene::Scene &scene, const Methods &methods, const MotionControl &control,
                  const DynamicResults &earlier)
          : study_(scene), methods_(methods), control_(control), earlier_(earlier), scene_(scene),
            results_(begin_results(scene, control.n_levels))
      {
      }

      DynamicResults run()
      {
        const auto names = scene_.problem.case_names();
        n_all_ = static_cast<double>(names.size() * methods_.size() * scene_.time.schemes.size() *
                                     step_rules(scene_.time).size());
        double n_levels = 0;
        for (const problem::Series &series : study_.study.series)
          n_levels += static_cast<double>(series.levels.size());
        n_all_ *= n_levels;
        results_.is_complete = true;
        for (unsigned int c = 0; c < names.size(); ++c)
          for (const problem::Series &series : study_.study.series)
          {
            const std::size_t n_all = series.levels.size(),
                              n = control_.n_levels == 0
                                      ? n_all
                                      : std::min<std::size_t>(control_.n_levels, n_all);
            for (unsigned int level = 0; level < n; ++level)
            {
              is_finest_ = level + 1 == n;
              take_scene_at(series.levels[level]);
              ProblemsInTime problems(scene_, c, series.levels[level], loads_);
              for (const auto &method : methods_)
              {
                MotionRun run;
                run.method = method->name();
                run.family = method->family();
                run.problem = names[c];
                run.series = series.name;
                run.level = level;
                run.h = series.levels[level].h;
                run.horizon = series.levels[level].horizon;
                run.value = series.levels[level].value;
                if (!run_method(*method, problems, run))
                {
                  results_.is_complete = false;
                  return results_;
                }
              }
            }
          }
        return results_;
      }

    private:
      /// What was made of the scene at another value of its variable says nothing here.
      void take_scene_at(const problem::Level &level)
      {
        if (study_.study.regime != scene::Regime::variable)
          return;
        scene_ = at_level(study_, level);
        loads_.clear();
        torus_.reset();
      }

      void finish(const MotionRun &run)
      {
        results_.runs.push_back(run);
        if (control_.on_result)
          control_.on_result(results_);
      }

      /// The same of an earlier run; null: there is none.
      /// @param n_before  that are called the same, steps being shown rounded
      const MotionRun *known(const MotionRun &run, std::ptrdiff_t n_before) const
      {
        for (const MotionRun &one : earlier_.runs)
          if (one.method == run.method && one.problem == run.problem && one.series == run.series &&
              one.level == run.level && one.scheme == run.scheme && one.steps == run.steps &&
              n_before-- == 0)
            return &one;
        return nullptr;
      }

      /// All motions of a method at one level as an earlier run has them, null where it has none.
      std::vector<const MotionRun *> known_motions(MotionRun run) const
      {
        if (const MotionRun *failed = known(run, 0)) // before any scheme
          return {failed};
        std::vector<const MotionRun *> all;
        for (const std::string &name : scene_.time.schemes)
        {
          std::map<std::string, std::ptrdiff_t> n_before;
          for (const StepRule &rule : step_rules(scene_.time))
          {
            run.scheme = name;
            run.steps = rule.text();
            all.push_back(known(run, n_before[run.steps]++));
          }
        }
        return all;
      }

      /// @return whether to go on
      bool run_method(const Method &method, ProblemsInTime &problems, MotionRun run)
      {
        const std::vector<const MotionRun *> motions = known_motions(run);
        if (std::find(motions.begin(), motions.end(), nullptr) == motions.end())
        {
          take_torus(run);
          for (const MotionRun *one : motions)
            finish(*one);
          return true;
        }
        const base::CpuTimer timer;
        try
        {
          const double shared = problems.seconds();
          const problem::Problem<2> &first = problems.at(0);
          area_ = area_of(first);
          const auto discretisation = method.discretise(first, base::Communicator::alone());
          settle_quadrature(*discretisation, first);
          const auto equation = discretisation->motion(scene_.time.is_lumped);
          if (!equation)
            throw NumericalError("its motion is not there");
          const MotionData data = motion_data(scene_, *equation, problems);
          const Transient transient(*equation, data.drive, scene_.time.density,
                                    scene_.time.damping);
          describe_method(run, *discretisation, *equation);
          run.cost.setup_seconds = timer.seconds() - (problems.seconds() - shared);
          const auto torus = torus_of(run, problems);
          const auto in_time =
              estimate(method, *discretisation, *equation, transient, data, problems, run);
          return run_schemes(*equation, transient, data, torus, in_time, motions, run);
        }
        catch (const Interrupted &)
        {
          return false;
        }
        catch (const NumericalError &error)
        {
          run.failure = error.what();
          finish(run);
        }
        return true;
      }

      /// The state at the final time of the same equation, exact in time, where orders or the own
      /// estimate want it; the latter's part of space.
      std::optional<State> estimate(const Method &method,
                                    const method::Discretisation &discretisation,
                                    const method::EquationOfMotion &equation,
                                    const Transient &transient, const MotionData &data,
                                    ProblemsInTime &problems, MotionRun &run) const
      {
        const bool is_estimated = wants_estimate(scene_, method);
        if (!is_estimated && !has_orders())
          return {};
        const State end = move_exactly(scene_, transient, data.start);
        if (is_estimated)
          run.estimate =
              estimate_in_space(scene_, method, discretisation, equation, end, area_, problems);
        return end;
      }

      bool has_orders() const { return is_finest_ && step_rules(scene_.time).size() > 1; }

      /// @return whether to go on
      bool run_schemes(const method::EquationOfMotion &equation, const Transient &transient,
                       const MotionData &data, const Torus *torus,
                       const std::optional<State> &in_time,
                       const std::vector<const MotionRun *> &known, MotionRun run)
      {
        const auto rules = step_rules(scene_.time);
        std::size_t n_done = 0;
        for (const std::string &name : scene_.time.schemes)
          for (const StepRule &rule : rules)
          {
            if (control_.should_stop && control_.should_stop())
              return false;
            const Scheme &scheme = analysis::scheme(name);
            run.scheme = name;
            run.steps = rule.text();
            if (const MotionRun *one = known[n_done++])
            {
              finish(*one);
              continue;
            }
            run.critical_step = transient.critical_step(scheme);
            run.step = step_of(rule, transient, scheme);
            progress(run);
            const bool is_shown =
                is_finest_ && name == scene_.time.schemes.front() && &rule == &rules.back();
            finish(move(run, scheme, equation, transient, data, torus, in_time, is_shown));
          }
        return true;
      }

      void progress(const MotionRun &run) const
      {
        if (control_.on_progress)
          control_.on_progress(run.method + ", " + run.series + ", h = " + base::to_text(run.h, 4) +
                                   ", " + run.scheme + ", " + run.steps,
                               static_cast<double>(results_.runs.size()) / n_all_);
      }

      MotionRun move(MotionRun run, const Scheme &scheme, const method::EquationOfMotion &equation,
                     const Transient &transient, const MotionData &data, const Torus *torus,
                     const std::optional<State> &in_time, bool is_shown)
      {
        const std::uint64_t n_samples = scene_.time.shows_blow_up ? 2000 : 100; // it grows fast
        const double end = scene_.time.final_time;
        const auto n_steps = static_cast<std::uint64_t>(std::ceil(end / run.step));
        State state = data.start;
        analysis::EnergyLog log(transient, state, n_steps, n_samples);
        double watching = 0; // CPU seconds of what the scheme itself does not do
        unsigned int n_frames = 0;
        const base::CpuTimer timer;
        const auto show = [&](const State &now)
        {
          const double due = end * n_frames / std::max(1u, scene_.time.n_frames - 1);
          if (!is_shown || !control_.on_frame || n_frames >= scene_.time.n_frames ||
              now.t < due - .5 * run.step)
            return;
          control_.on_frame(run, {now.t, equation, now});
          ++n_frames;
        };
        const auto error_now = [&](const State &now)
        {
          run.history.push_back(error_of(
              equation, difference(equation.nodal(now.u), equation.nodal(data.exact->at(now.t))),
              scene_.study.decisive_error.norm));
        };
        if (data.exact)
          error_now(state);
        show(state);
        watching = timer.seconds();
        try
        {
          run.counts = analysis::integrate(transient.motion(), scheme,
                                           {run.step, run.critical_step, scene_.time.shows_blow_up},
                                           end, state,
                                           [&](const State &now)
                                           {
                                             const double before = timer.seconds();
                                             if (log.observe(now) && data.exact)
                                               error_now(now);
                                             show(now);
                                             watching += timer.seconds() - before;
                                           });
        }
        catch (const NumericalError &error)
        {
          run.failure = error.what();
        }
        run.cost.solve_seconds = timer.seconds() - watching;
        run.energies = log.samples();
        run.imbalance = log.imbalance();
        if (run.failure.empty())
        {
          compare(run, equation, state, data, torus, in_time);
          if (control_.on_end)
            control_.on_end(run, {state.t, equation, state}, area_);
        }
        return run;
      }

      double error_of(const method::EquationOfMotion &equation, const Vector &nodal,
                      scene::Norm norm) const
      {
        return norm_of(nodal, equation.n_components(), area_, is_largest(norm));
      }

      void compare(MotionRun &run, const method::EquationOfMotion &equation, const State &state,
                   const MotionData &data, const Torus *torus, const std::optional<State> &in_time)
      {
        const Vector u = equation.nodal(state.u), v = equation.nodal(state.v);
        run.size = extent_of(u, equation.n_components());
        run.area = area_;
        const auto against = [&](scene::Target target, const Vector &exact_u, const Vector &exact_v)
        {
          for (const scene::Norm norm : scene_.study.norms)
          {
            const std::string name = base::word(norm) + " | " + base::word(target);
            run.errors[name] = error_of(equation, difference(u, exact_u), norm);
            run.errors["velocity " + name] = error_of(equation, difference(v, exact_v), norm);
          }
        };
        if (data.exact)
          against(scene::Target::exact, equation.nodal(data.exact->at(state.t)),
                  equation.nodal(data.exact->derivative().at(state.t)));
        if (torus != nullptr)
        {
          if (torus_nodes_ != equation.nodes())
          {
            torus_nodes_ = equation.nodes();
            torus_u_ = torus->at(torus_nodes_, torus->state.u);
            torus_v_ = torus->at(torus_nodes_, torus->state.v);
          }
          against(scene::Target::reference, torus_u_, torus_v_);
        }
        if (!in_time)
          return;
        const double of_time =
            error_of(equation, difference(u, equation.nodal(in_time->u)), scene::Norm::nodal_l2);
        if (run.estimate)
          run.estimate->time = of_time;
        if (has_orders())
          run.errors["nodal L2 | time"] = of_time;
      }

      static bool is_of(const TorusEstimate &torus, const MotionRun &run)
      {
        return torus.problem == run.problem && torus.horizon == run.horizon &&
               torus.value == run.value;
      }

      /// What an earlier run says of its torus.
      void take_torus(const MotionRun &run)
      {
        const auto is_same = [&](const TorusEstimate &one) { return is_of(one, run); };
        const auto found =
            std::find_if(earlier_.references.begin(), earlier_.references.end(), is_same);
        if (found != earlier_.references.end() &&
            std::none_of(results_.references.begin(), results_.references.end(), is_same))
          results_.references.push_back(*found);
      }

      /// Of the run's case and horizon; the last one is kept.
      const Torus *torus_of(const MotionRun &run, ProblemsInTime &problems)
      {
        if (!scene_.reference.method || control_.available.empty())
          return nullptr;
        if (!torus_ || torus_key_ != std::pair(run.problem, run.horizon))
        {
          auto solution = solve_torus(scene_, control_, run.problem, run.horizon, problems);
          solution.estimate.value = run.value;
          torus_ = std::move(solution.torus);
          torus_nodes_.clear();
          take_torus(run);
          if (std::none_of(results_.references.begin(), results_.references.end(),
                           [&](const TorusEstimate &one) { return is_of(one, run); }))
            results_.references.push_back(solution.estimate);
        }
        torus_key_ = {run.problem, run.horizon};
        return &*torus_;
      }

      const scene::Scene &study_; ///< its walk
      const Methods &methods_;
      const MotionControl &control_;
      const DynamicResults &earlier_;
      scene::Scene scene_; ///< at the level
      DynamicResults results_;
      ProblemsInTime::Loads loads_;
      bool is_finest_ = false;
      double area_ = 1, n_all_ = 1; ///< motions
      std::optional<Torus> torus_;
      std::pair<std::string, double> torus_key_;
      std::vector<dealii::Point<2>> torus_nodes_; ///< that it was asked for last
      Vector torus_u_, torus_v_;
    };
  } // namespace

  DynamicResults run_motions(const scene::Scene &scene, const Methods &methods,
                             const MotionControl &control, const DynamicResults &earlier)
  {
    return MotionSweep(scene, methods, control, earlier).run();
  }
} // namespace plumbline::study
