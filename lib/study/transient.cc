#include "study/transient.h"

#include "algebra/symbol.h"
#include "base/error.h"
#include "method/box_discretisation.h"
#include "method/discretisation.h"
#include "method/distributed_motion.h"
#include "study/bound_log.h"
#include "study/local_waves.h"
#include "study/motion_data.h"
#include "study/motion_estimate.h"
#include "study/motion_norms.h"
#include "study/motion_steps.h"
#include "study/preflight.h"
#include "study/solution_record.h"
#include "study/torus_reference.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace plumbline::study
{
  using analysis::Scheme;
  using analysis::State;
  using analysis::Transient;
  using analysis::Vector;

  namespace
  {
    /// What is made of the scene at one value of its variable, whatever the method and level.
    template <int dim>
    struct Shared
    {
      double value = 0, horizon = 0;
      typename ProblemsInTime<dim>::Loads loads;
      std::map<unsigned int, TorusSolution> tori; ///< by case, of this horizon
      const TorusSolution *last = nullptr;        ///< that was asked for values at `nodes`
      std::vector<dealii::Point<2>> nodes;
      Vector u, v;

      void go_to(const problem::Level &level)
      {
        if (value != level.value)
          loads.clear();
        if (value != level.value || horizon != level.horizon)
        {
          tori.clear();
          last = nullptr;
        }
        value = level.value;
        horizon = level.horizon;
      }

      /// Methods often have the same nodes.
      void evaluate(const TorusSolution &torus, const std::vector<dealii::Point<2>> &at)
      {
        if (last == &torus && nodes == at)
          return;
        last = &torus;
        nodes = at;
        u = torus.torus.at(nodes, torus.torus.state.u);
        v = torus.torus.at(nodes, torus.torus.state.v);
      }
    };

    /// Names of scheme and step where there are several.
    std::string variant_of(const scene::TimeSection &time, const std::string &scheme,
                           const StepRule &rule)
    {
      constexpr int all_digits = 15; // steps that differ are told apart
      std::string variant;
      if (time.schemes.size() > 1)
        variant = scheme;
      if (step_rules(time).size() > 1)
        variant += (variant.empty() ? "" : ", ") + rule.text(all_digits);
      return variant;
    }

    /// The same equation with forces by finer quadrature; null: exact ones.
    std::unique_ptr<method::EquationOfMotion>
    finer_motion(const method::Discretisation &discretisation, bool is_lumped)
    {
      return discretisation.finer_motion(is_lumped);
    }

    std::unique_ptr<method::MotionOf<3>> finer_motion(const method::DiscretisationInSpace &, bool)
    {
      return nullptr;
    }

    template <int dim>
    std::vector<dealii::Point<3>> in_space(const std::vector<dealii::Point<dim>> &nodes)
    {
      std::vector<dealii::Point<3>> result;
      for (const auto &node : nodes)
        result.emplace_back(node[0], node[1], dim == 3 ? node[dim - 1] : 0);
      return result;
    }

    std::vector<dealii::Point<3>> gather(const method::DistributedMotion &shared,
                                         const std::vector<dealii::Point<3>> &nodes)
    {
      Vector coordinates;
      for (const auto &node : nodes)
        for (unsigned int d = 0; d < 3; ++d)
          coordinates.push_back(node[d]);
      coordinates = shared.gather(coordinates, 3);
      std::vector<dealii::Point<3>> result;
      for (std::size_t i = 0; i < coordinates.size(); i += 3)
        result.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
      return result;
    }

    /// A method on one case at one level, by all schemes and steps.
    template <int dim>
    class CaseOfMethod
    {
    public:
      CaseOfMethod(const Place &place, const Method &method, unsigned int case_index,
                   const TransientOptions &options, const Methods &available)
          : place_(place), scene_(place.scene()), method_(method), case_index_(case_index),
            options_(options), available_(available), shared_(place.kept<Shared<dim>>("in time")),
            problems_(*place.shared<std::unique_ptr<ProblemsInTime<dim>>>(
                "in time, case " + std::to_string(case_index),
                [&]
                {
                  return std::make_unique<ProblemsInTime<dim>>(scene_, case_index, place.level(),
                                                               shared_.loads);
                })),
            begun_(place.record("dynamics", method))
      {
        shared_.go_to(place.level());
        begun_.key.problem = scene_.problem.case_names()[case_index];
      }

      void run()
      {
        const scene::TimeSection &time = scene_.time;
        const auto rules = step_rules(time);
        for (const std::string &name : time.schemes)
          for (const StepRule &rule : rules)
          {
            Record record = begun_;
            record.key.variant = variant_of(time, name, rule);
            record.texts["scheme"] = name;
            record.texts["step"] = rule.text();
            const bool is_shown =
                place_.is_finest() && name == time.schemes.front() && &rule == &rules.back();
            place_.part(record,
                        [&](Record &part)
                        {
                          set_up();
                          part.scalars = of_method_.scalars;
                          part.texts.insert(of_method_.texts.begin(), of_method_.texts.end());
                          part.cost = of_method_.cost;
                          integrate(part, analysis::scheme(name), rule, is_shown);
                        });
          }
      }

    private:
      /// Once for all schemes and steps.
      void set_up()
      {
        if (is_set_up_)
          return;
        if (!failure_.empty())
          throw NumericalError(failure_);
        try
        {
          make_equation();
        }
        catch (const NumericalError &error)
        {
          failure_ = error.what();
          throw;
        }
      }

      void make_equation()
      {
        const base::CpuTimer timer;
        const double shared = problems_.seconds();
        const problem::Problem<dim> &first = problems_.at(0);
        area_ = area_of(first);
        discretisation_ = discretise(method_, first);
        share_motion(scene_, method_, *discretisation_, options_.ranks);
        settle_quadrature(*discretisation_, first);
        equation_ = discretisation_->motion(scene_.time.is_lumped);
        if (!equation_)
          throw NumericalError("the method has no equation of motion here");
        ranks_ = method::ranks_of(*equation_);
        data_.emplace(motion_data(scene_, *equation_, problems_));
        transient_.emplace(*equation_, data_->drive, scene_.time.density, scene_.time.damping);
        describe();
        of_method_.cost.setup_seconds =
            ranks_.sum(timer.seconds() - (problems_.seconds() - shared));
        solve_reference();
        const bool is_estimated = wants_estimate(scene_, method_);
        if (is_estimated || has_orders())
          in_time_ = move_exactly(scene_, *transient_, data_->start);
        if (is_estimated)
          estimate_ = estimate_in_space(scene_, method_, *equation_,
                                        finer_motion(*discretisation_, scene_.time.is_lumped).get(),
                                        *in_time_, area_, problems_);
        is_set_up_ = true;
      }

      /// What the method says of itself. Diagnostics of Galerkin methods, which sample geometry
      /// and entries, are not asked for.
      void describe()
      {
        for (const auto &[name, value] : equation_->facts())
          of_method_.set(name, value);
        of_method_.set("symmetric", equation_->is_symmetric() ? 1 : 0);
        of_method_.set("area of the domain", area_);
        if (method_.family() != MethodFamily::meshfree)
          return;
        const auto diagnostics = discretisation_->diagnostics();
        set_limit(of_method_, diagnostics.limit);
        if (diagnostics.n_negative_weights > 0 && equation_->is_symmetric())
          set_growth();
      }

      /// Where some wave grows, which weights >= 0 do not allow: how fast.
      void set_growth()
      {
        constexpr double rounding = 1e-12; // of sums that are 0 for waves of infinite length
        const auto waves = discretisation_->waves();
        if (!waves)
          return;
        const algebra::SymbolRange range = algebra::Symbol(*waves).range();
        if (range.least < -rounding * range.largest)
          of_method_.set(growing_waves, range.least / scene_.time.density, "1/time^2");
      }

      void solve_reference()
      {
        if constexpr (dim == 2)
          if (scene_.reference.method && !available_.empty())
            find_torus();
      }

      void find_torus()
      {
        const auto known = shared_.tori.find(case_index_);
        torus_ = known != shared_.tori.end()
                     ? &known->second
                     : &shared_.tori
                            .emplace(case_index_, solve_torus(scene_, available_,
                                                              place_.level().horizon, problems_))
                            .first->second;
        of_method_.set("reference points", torus_->n_points);
        of_method_.set("reference change", torus_->change);
        of_method_.set("reference seconds", torus_->seconds, "s");
      }

      bool has_orders() const { return place_.is_finest() && step_rules(scene_.time).size() > 1; }

      void integrate(Record &record, const Scheme &scheme, const StepRule &rule, bool is_shown)
      {
        const scene::TimeSection &time = scene_.time;
        const double critical = transient_->critical_step(scheme),
                     wanted = step_of(rule, *transient_, scheme);
        const std::uint64_t n_steps = analysis::n_equal_steps(time.final_time, wanted);
        const double step = scheme.is_runge_kutta
                                ? wanted // between samples; its own steps are adaptive
                                : time.final_time / static_cast<double>(n_steps);
        record.set("time step", step, "time");
        record.set("critical step", critical, "time");
        const std::uint64_t n_samples = time.shows_blow_up ? 2000 : 100; // it grows fast
        State state = data_->start;
        analysis::EnergyLog log(*transient_, state, n_steps, n_samples);
        double watching = 0; // CPU seconds of what the scheme itself does not do
        unsigned int n_frames = 0;
        const base::CpuTimer timer;
        const auto show_due = [&](const State &now)
        {
          const double due = time.final_time * n_frames / std::max(1u, time.n_frames - 1);
          if (!is_shown || !options_.on_frame || n_frames >= time.n_frames ||
              now.t < due - .5 * step)
            return;
          show(record, now);
          ++n_frames;
        };
        analysis::Curve errors{{"time", "time", {}}, {"error", "", {}}};
        const auto add_error = [&](const State &now)
        {
          errors[0].values.push_back(now.t);
          errors[1].values.push_back(error_of(now.u, equation_->nodal(data_->exact->at(now.t)),
                                              scene_.study.decisive_error.norm));
        };
        if (data_->exact)
          add_error(state);
        show_due(state);
        auto bounds = bound_log();
        if (bounds)
          observe_bound(*bounds, state);
        watching = timer.seconds();
        try
        {
          const analysis::Counts counts =
              analysis::integrate(transient_->motion(), scheme,
                                  {step, critical, time.shows_blow_up}, time.final_time, state,
                                  [&](const State &now)
                                  {
                                    const double before = timer.seconds();
                                    const bool is_kept = log.observe(now);
                                    if (is_kept && data_->exact)
                                      add_error(now);
                                    if (is_kept && bounds)
                                      observe_bound(*bounds, now);
                                    show_due(now);
                                    watching += timer.seconds() - before;
                                  });
          record.set("time steps", static_cast<double>(counts.n_steps));
          record.set("force evaluations", static_cast<double>(counts.n_accelerations));
          record.set("tangents", static_cast<double>(counts.n_tangents));
          record.set("Newton iterations", static_cast<double>(counts.n_newton));
        }
        catch (const NumericalError &error)
        {
          record.failure = error.what();
        }
        record.cost.solve_seconds = ranks_.sum(timer.seconds() - watching);
        add_energies(record, log);
        if (data_->exact)
          record.curves["error"] = std::move(errors);
        if (bounds && record.failure.empty())
          bounds->enter(record, scheme, step, n_steps);
        if (record.failure.empty())
          compare(record, state);
      }

      /// Where it is asked for.
      std::optional<BoundLog> bound_log() const
      {
        if constexpr (dim == 2)
          if (scene_.time.has_bounds)
            return BoundLog(scene_, place_.level().horizon, *transient_, *equation_,
                            equation_->nodes(), place_.level().h, area_);
        return {};
      }

      /// Errors against the solution, or the torus at the same time.
      void observe_bound(BoundLog &bounds, const State &now) const
      {
        bounds.observe(now);
        const auto error = [&](const Vector &u, const Vector &v)
        {
          bounds.add_error(error_of(now.u, u, scene::Norm::nodal_l2) +
                           error_of(now.v, v, scene::Norm::nodal_l2));
        };
        if (data_->exact)
          error(equation_->nodal(data_->exact->at(now.t)),
                equation_->nodal(data_->exact->derivative().at(now.t)));
        else if constexpr (dim == 2)
          if (torus_ != nullptr && bounds.is_tenth(now))
          {
            const State exact = torus_->at(now.t);
            error(torus_->torus.at(equation_->nodes(), exact.u),
                  torus_->torus.at(equation_->nodes(), exact.v));
          }
      }

      /// The waves of the local limit, from the initial data.
      void compare_with_waves(const std::function<void(const Vector &, const Vector &)> &against,
                              double t) const
      {
        if constexpr (dim == 2)
        {
          const auto field = [](const std::optional<problem::Field<2>> &given)
          { return given ? given->value : LocalWaves::Field{}; };
          const auto local = LocalWaves(scene_, field(data_->displacement), field(data_->velocity))
                                 .at(t, equation_->nodes());
          against(local.u, local.v);
        }
      }

      /// On the first rank, of all nodes.
      void show(const Record &record, const State &now) const
      {
        const unsigned int n = equation_->n_components();
        std::vector<dealii::Point<3>> nodes = in_space(equation_->nodes());
        Vector u = equation_->nodal(now.u), v = equation_->nodal(now.v);
        if (const auto *const shared = method::distributed(*equation_))
        {
          u = shared->gather(u, n);
          v = shared->gather(v, n);
          nodes = gather(*shared, nodes);
        }
        options_.ranks.together(
            [&]
            {
              if (options_.ranks.rank() == 0)
                options_.on_frame(record, {now.t, std::move(nodes), n, std::move(u), std::move(v)});
            });
      }

      static void add_energies(Record &record, const analysis::EnergyLog &log)
      {
        const std::string unit = "force length";
        analysis::Curve curve{{"time", "time", {}},
                              {"kinetic", unit, {}},
                              {"bonds", unit, {}},
                              {"work", unit, {}},
                              {"dissipated", unit, {}}};
        for (const analysis::Energies &now : log.samples())
        {
          const double values[] = {now.t, now.kinetic, now.bond, now.work, now.dissipated};
          for (std::size_t i = 0; i < curve.size(); ++i)
            curve[i].values.push_back(values[i]);
        }
        record.set("kinetic energy", log.samples().back().kinetic, unit);
        record.set("bond energy", log.samples().back().bond, unit);
        record.set("energy imbalance", log.imbalance());
        record.curves["energy"] = std::move(curve);
      }

      /// @param exact  nodal values
      double error_of(const Vector &state, const Vector &exact, scene::Norm norm) const
      {
        return norm_of(difference(equation_->nodal(state), exact), equation_->n_components(), area_,
                       is_largest(norm), ranks_);
      }

      void compare(Record &record, const State &end) const
      {
        const Vector u = equation_->nodal(end.u);
        record.set("extent of u", extent_of(u, equation_->n_components(), ranks_));
        const auto against = [&](scene::Target target, const Vector &exact_u, const Vector &exact_v)
        {
          for (const scene::Norm norm : scene_.study.norms)
          {
            const std::string name = base::word(norm) + " | " + base::word(target);
            record.set(name, error_of(end.u, exact_u, norm));
            record.set("velocity " + name, error_of(end.v, exact_v, norm));
          }
        };
        if (data_->exact)
          against(scene::Target::exact, equation_->nodal(data_->exact->at(end.t)),
                  equation_->nodal(data_->exact->derivative().at(end.t)));
        if (data_->local)
          against(scene::Target::local, equation_->nodal(data_->local->at(end.t)),
                  equation_->nodal(data_->local->derivative().at(end.t)));
        if (scene_.problem.local_solution == scene::LocalSolution::computed)
          compare_with_waves([&](const Vector &u, const Vector &v)
                             { against(scene::Target::local, u, v); },
                             end.t);
        if constexpr (dim == 2)
          if (torus_ != nullptr)
          {
            shared_.evaluate(*torus_, equation_->nodes());
            against(scene::Target::reference, shared_.u, shared_.v);
          }
        if (in_time_)
        {
          const double of_time =
              error_of(end.u, equation_->nodal(in_time_->u), scene::Norm::nodal_l2);
          if (has_orders())
            record.set(time_error, of_time);
          if (estimate_)
            set_estimate(record, *estimate_, of_time);
        }
        if constexpr (dim == 2)
          if (options_.keeps_end)
          {
            const auto &nodes = equation_->nodes();
            record.fields["displacement"] = {
                equation_->n_components(), nodes, u,
                Vector(nodes.size(), area_ / static_cast<double>(nodes.size()))};
          }
      }

      static void set_estimate(Record &record, MotionEstimate estimate, double of_time)
      {
        estimate.time = of_time;
        record.set("estimated error in space", estimate.space);
        record.set("estimated error by quadrature", estimate.quadrature);
        record.set("estimated error in time", estimate.time);
        record.set("estimated error", estimate.sum());
      }

      const Place &place_;
      const scene::Scene &scene_; ///< at the level
      const Method &method_;
      unsigned int case_index_;
      const TransientOptions &options_;
      const Methods &available_;
      Shared<dim> &shared_;
      ProblemsInTime<dim> &problems_;
      Record begun_, of_method_;
      bool is_set_up_ = false;
      std::string failure_; ///< of what is set up
      double area_ = 1;
      decltype(discretise(std::declval<const Method &>(),
                          std::declval<const problem::Problem<dim> &>())) discretisation_;
      std::unique_ptr<const method::MotionOf<dim>> equation_;
      base::Communicator ranks_ = base::Communicator::alone(); ///< that have a part of it each
      std::optional<MotionData<dim>> data_;
      std::optional<Transient> transient_;
      const TorusSolution *torus_ = nullptr;
      /// The state at the final time of the same equation, exact in time, where orders or the own
      /// estimate want it; the latter's part of space.
      std::optional<State> in_time_;
      std::optional<MotionEstimate> estimate_;
    };
  } // namespace

  std::vector<analysis::Energies> energies_of(const Record &record)
  {
    std::vector<analysis::Energies> energies;
    const auto found = record.curves.find("energy");
    if (found == record.curves.end())
      return energies;
    const analysis::Curve &curve = found->second;
    for (std::size_t i = 0; i < curve.front().values.size(); ++i)
      energies.push_back({curve[0].values[i], curve[1].values[i], curve[2].values[i],
                          curve[3].values[i], curve[4].values[i]});
    return energies;
  }

  Analysis transient_analysis(const Methods &available, const TransientOptions &options)
  {
    Analysis analysis{"dynamics", "Transient analysis"};
    analysis.choose_methods = [ranks = options.ranks](const scene::Scene &scene, const Methods &all,
                                                      unsigned int n_levels, unsigned int n_jobs)
    {
      Methods methods = study::choose_methods(scene, all);
      if (scene.domain.is_in_space())
        check_memory_of_motion(scene, methods, n_levels, n_jobs, ranks.n_ranks());
      return methods;
    };
    analysis.check = [ranks = options.ranks](const scene::Scene &scene, const Methods &methods,
                                             unsigned int n_levels)
    { check_transient(scene, methods, n_levels, ranks); };
    analysis.analyse = [available, options](const Place &place, const Method &method)
    {
      for (unsigned int c = 0; c < place.scene().problem.case_names().size(); ++c)
        place.scene().domain.is_in_space()
            ? CaseOfMethod<3>(place, method, c, options, available).run()
            : CaseOfMethod<2>(place, method, c, options, available).run();
      return Records();
    };
    analysis.has_parts = true;
    analysis.conclude = conclude_transient;
    analysis.sampled = {" | exact",    " | reference",  " | time",     "kinetic energy",
                        "bond energy", "critical step", "displacement"};
    return analysis;
  }
} // namespace plumbline::study
