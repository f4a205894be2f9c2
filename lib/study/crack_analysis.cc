#include "study/crack_analysis.h"

#include "analysis/critical_step.h"
#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "study/growth_analysis.h"

#include <cmath>
#include <memory>

namespace plumbline::study
{
  using method::NotchedStrip;

  namespace
  {
    dealii::Tensor<1, 2> sides(const scene::Scene &scene)
    {
      const geometry::Box &strip = scene.domain.boxes.include.front();
      return strip.upper - strip.lower;
    }

    method::StripThreshold find_threshold(const scene::Scene &scene, const Method &method,
                                          const problem::Level &level)
    {
      return method.dynamic_fracture_solver()->strip_threshold(
          scene::make_double_well(scene, level.horizon), level.h,
          static_cast<int>(std::lround(sides(scene)[1] / level.h)), scene.geometry.backend);
    }

    /// All but what needs the strip.
    CrackPlan make_plan(const scene::Scene &scene, const Checkpoints &checkpoints, bool has_frames)
    {
      CrackPlan plan;
      plan.final_time = scene.time.final_time;
      plan.density = scene.time.density;
      plan.scheme = scene.time.schemes.front();
      plan.shows_blow_up = scene.time.shows_blow_up;
      plan.n_samples = scene.crack.n_samples;
      plan.interval = scene.crack.interval;
      plan.subject = "plumbline crack\n" + scene.text;
      plan.checkpoints = checkpoints;
      if (has_frames)
        plan.n_frames = scene.time.n_frames;
      if (scene.time.n_frames > plan.n_samples)
        throw InputError("Time/frames = " + std::to_string(scene.time.n_frames) +
                         " is more than Crack/samples = " + std::to_string(plan.n_samples) +
                         ", of which frames are some; raise that, or write fewer frames");
      return plan;
    }

    /// Its memory and disk are there; nothing is made before that.
    void check_size(const scene::Scene &scene, const problem::Level &level, const CrackPlan &plan,
                    unsigned int n_jobs)
    {
      // in vectors of a number a node: u, v, a and fields to which margins are added (11), a view
      // (4), the moments and their copy in a checkpoint; then the record's field, its copy and both
      // as JSON, with some 20 bytes a number as text
      constexpr double bytes = 8 * (15 + 2 * n_crack_moments + 4) + 60 * (2 + n_crack_moments);
      const double n_nodes =
          sides(scene)[0] / level.h * (sides(scene)[1] + 2 * level.horizon) / level.h;
      base::require_memory(bytes * n_nodes, "a strip of " + base::to_text(n_nodes, 3) + " nodes",
                           "choose a larger h (Study/h)", n_jobs);
      check_room(plan, n_nodes);
    }

    /// Where what the scene calls (0, 0) lies for the strip, whose origin is its middle.
    dealii::Point<2> middle(const scene::Scene &scene)
    {
      return scene.domain.boxes.include.front().lower + .5 * sides(scene);
    }

    std::unique_ptr<NotchedStrip> make_strip(const scene::Scene &scene, const Method &method,
                                             const problem::Level &level)
    {
      const auto cells = [&](double length)
      { return static_cast<int>(std::lround(length / level.h)); };
      return method.dynamic_fracture_solver()->notched_strip(
          scene::make_double_well(scene, level.horizon),
          {{cells(sides(scene)[0]), cells(sides(scene)[1])}, cells(scene.crack.notch), level.h},
          scene.geometry.backend);
    }

    /// @param strip  outlives it
    analysis::Motion make_motion(const scene::Scene &scene, const NotchedStrip &strip)
    {
      const auto divide = [density = scene.time.density](Vector &a)
      {
        if (density != 1)
          for (double &value : a)
            value /= density;
      };
      return {strip.size(),
              [&strip, divide](const Vector &u, double, Vector &a)
              {
                strip.force(u, a);
                divide(a);
              },
              [&strip, divide](const Vector &u, const Vector &v, Vector &a)
              {
                strip.tangent(u, v, a);
                divide(a);
              },
              scene.time.damping};
    }

    CrackModel make_model(const scene::Scene &scene, const NotchedStrip &strip, double strain)
    {
      CrackModel model;
      model.motion = make_motion(scene, strip);
      model.start = strip.at_rest(strain, scene.crack.start == scene::CrackStart::opened);
      model.mass = scene.time.density * strip.h() * strip.h();
      model.energy = [&strip](const Vector &u) { return strip.energy(u); };
      model.view = [&strip, x = middle(scene)[0]](const Vector &u)
      {
        CrackView view = strip.view(u);
        view.tip += x;
        return view;
      };
      return model;
    }

    /// Steps of the plan, from the scene's or from the critical one.
    void plan_steps(const scene::Scene &scene, const analysis::Motion &motion, CrackPlan &plan)
    {
      const auto critical = [&](const std::string &name)
      { return analysis::critical_step(motion, analysis::scheme(name), Vector(motion.n)); };
      const double longest = critical(plan.scheme);
      if (std::isfinite(longest))
        plan.critical_step = longest;
      if (!scene.time.steps.empty())
        plan.step = scene.time.steps.back();
      else
        plan.step = scene.time.fractions.back() *
                    (longest > 0 && std::isfinite(longest) ? longest : critical("velocity Verlet"));
      if (plan.step > longest && !plan.shows_blow_up)
        throw InputError("Time/steps or critical fractions: a step of " +
                         base::to_text(plan.step, 4) + " is longer than the critical step " +
                         base::to_text(longest, 4) + " of " + plan.scheme +
                         ", so that errors grow without bound; shorten it, or set Time/show "
                         "blow-up = true");
    }

    std::vector<dealii::Point<2>> nodes_of(const NotchedStrip &strip, const dealii::Point<2> &lower)
    {
      std::vector<dealii::Point<2>> nodes;
      for (int j = 0; j < strip.n()[1]; ++j)
        for (int i = 0; i < strip.n()[0]; ++i)
          nodes.push_back(lower + strip.h() * dealii::Point<2>(i, j));
      return nodes;
    }

    WriteFrame frame_writer(const CrackPlan &plan, const NotchedStrip &strip,
                            const dealii::Point<2> &lower, const WriteStrip &write)
    {
      if (plan.n_frames == 0 || !write)
        return {};
      return [=, &strip](unsigned int index, const State &state, const CrackView &view)
      {
        std::vector<double> times;
        for (unsigned int k = 0; k <= plan.n_samples && times.size() <= index; ++k)
          if (plan.frame(k))
            times.push_back(plan.time(k));
        write(times, nodes_of(strip, lower), state.u, view.damage);
      };
    }

    void add_samples(const std::vector<CrackSample> &samples, double origin, Record &record)
    {
      analysis::Curve curve =
          curve_of({"t", "tip", "kinetic", "bonds", "soft bonds", "dissipated", "branches"});
      curve[0].unit = "time";
      curve[1].unit = "length";
      for (const CrackSample &s : samples)
        add_row(curve,
                {s.t, origin + s.tip, s.kinetic, s.bonds, s.soft, s.dissipated, s.n_branches});
      record.curves["samples"] = std::move(curve);
    }

    void add_moments(const std::vector<CrackMoment> &moments, std::vector<dealii::Point<2>> nodes,
                     Record &record)
    {
      analysis::PointField field{static_cast<unsigned int>(moments.size()), std::move(nodes), {}};
      for (std::size_t i = 0; i < field.points.size(); ++i)
        for (const CrackMoment &moment : moments)
          field.values.push_back(moment.damage[i]);
      record.fields["damage"] = std::move(field);
      analysis::Curve curve = {{"t", "time", {}}};
      for (const CrackMoment &moment : moments)
        curve[0].values.push_back(moment.t);
      record.curves["moments"] = std::move(curve);
    }

    void add_motion(const CrackMotion &motion, double lattice_toughness, double rayleigh_speed,
                    Record &record)
    {
      record.texts["outcome"] = base::word(motion.outcome);
      record.texts["reason"] = motion.reason;
      record.set("advance", motion.advance, "length");
      record.set("speed", motion.speed, "length/time");
      record.set("speed / c_R", motion.speed / rayleigh_speed);
      record.set("fastest / c_R", motion.fastest / rayleigh_speed);
      record.set("speed window", motion.window, "time");
      analysis::Curve speeds = curve_of({"t", "tip speed / c_R"});
      speeds[0].unit = "time";
      for (const auto &[t, speed] : motion.speeds)
        add_row(speeds, {t, speed / rayleigh_speed});
      record.curves["tip speed"] = std::move(speeds);
      record.set("c_R", rayleigh_speed, "length/time");
      record.set("soft energy / G_c,h", motion.soft_per_length / lattice_toughness);
      record.set("energy drift", motion.energy_drift);
      record.set("runs", motion.outcome == scene::CrackOutcome::runs ? 1 : 0);
    }

    /// The motion of the strip.
    void move(const scene::Scene &scene, const Method &method, const method::StripThreshold &own,
              CrackPlan plan, const WriteStrip &write, Record &record)
    {
      const problem::Level level{record.key.h, record.key.horizon};
      const auto strip = make_strip(scene, method, level);
      const double strain = strip->strain(scene.crack.load * own.energy);
      plan_steps(scene, make_motion(scene, *strip), plan);
      const dealii::Point<2> lower = middle(scene) + dealii::Point<2>(strip->x(0), strip->y(0));
      const CrackModel model = make_model(scene, *strip, strain);
      const base::CpuTimer timer;
      const CrackHistory history = run_crack(model, plan, frame_writer(plan, *strip, lower, write));
      record.cost.solve_seconds = timer.seconds();
      record.cost.n_unknowns = strip->size();
      record.cost.n_bonds = strip->n_bonds();

      const auto speeds =
          scene::make_double_well(scene, level.horizon).wave_speeds(scene.time.density);
      const double notch_tip = middle(scene)[0] + strip->notch_tip();
      const dealii::Point<2> &origin = scene.domain.origin;
      add_motion(describe_crack(history.samples,
                                {notch_tip, scene.domain.boxes.include.front().upper[0], strip->h(),
                                 level.horizon, sides(scene)[1], speeds.transverse}),
                 own.toughness, rayleigh_ratio() * speeds.transverse, record);
      add_samples(history.samples, origin[0], record);
      add_moments(history.moments, nodes_of(*strip, origin + lower), record);
      record.texts["scheme"] = plan.scheme;
      record.set("notch tip", origin[0] + notch_tip, "length");
      record.set("c_T", speeds.transverse, "length/time");
      record.set("load", scene.crack.load);
      record.set("threshold", own.energy / own.toughness);
      record.set("strained W H / G_c,h", scene.crack.load * own.energy / own.toughness);
      record.set("strain", strain);
      record.set("asymmetry", strip->asymmetry(history.last.u));
      // it divides the time between samples
      record.set("time step", plan.final_time / static_cast<double>(history.n_steps), "time");
      if (plan.critical_step)
        record.set("critical step", *plan.critical_step, "time");
      record.set("steps", static_cast<double>(history.n_steps));
      record.set("nodes", static_cast<double>(strip->n()[0]) * strip->n()[1]);
      record.set("resumed at", history.resumed_at, "time");
      record.notes = warnings_of_strain(strain);
    }

    Methods choose_method(const scene::Scene &scene, const Methods &available,
                          unsigned int n_levels, unsigned int n_jobs, const CrackPlan &plan)
    {
      for (const problem::Series &series : scene.study.series)
        for (std::size_t i = 0; i < series.levels.size() && (n_levels == 0 || i < n_levels); ++i)
          check_size(scene, series.levels[i], plan, n_jobs);
      return {fracture_method(scene.methods.names.front(), available)};
    }

    Record analyse(const Place &place, const Method &method, const CrackPlan &plan,
                   const WriteStrip &write)
    {
      const scene::Scene &scene = place.scene();
      Record record = place.record("crack", method);
      const method::StripThreshold threshold = find_threshold(scene, method, place.level());
      const physics::DoubleWell law = scene::make_double_well(scene, record.key.horizon);
      record.set("G_c", law.toughness(), "force/length");
      record.set("c", law.c(), "force/length");
      record.set("beta", law.beta(), "1/length");
      record.set("softening strain", law.softening_strain(law.horizon()));
      record.set("G_c,h / G_c", threshold.toughness / law.toughness());
      if (threshold.failure.empty())
        record.set("W H / G_c,h", threshold.energy / threshold.toughness);
      else
        record.texts["no threshold"] = threshold.failure;
      if (!place.is_finest() || place.series().name != scene.study.series.front().name)
        return record;
      if (threshold.failure.empty())
        move(scene, method, threshold, plan, write, record);
      else
        record.failure = threshold.failure;
      return record;
    }

    void conclude(const scene::Scene &scene, StudyResults &results)
    {
      std::string found = "no motion";
      for (const Record &record : results.records)
      {
        results.warnings.insert(results.warnings.end(), record.notes.begin(), record.notes.end());
        if (!record.text("outcome").empty())
          found = record.text("outcome");
      }
      const scene::CrackOutcome expected = scene.expected.crack;
      if (results.is_complete && expected != scene::CrackOutcome::unknown)
        results.expectations.push_back(
            {"Expected/crack", base::word(expected), found, found == base::word(expected)});
    }
  } // namespace

  Analysis crack_analysis(const Checkpoints &checkpoints, const WriteStrip &write)
  {
    const auto plan_of = [=](const scene::Scene &scene)
    { return make_plan(scene, checkpoints, static_cast<bool>(write)); };
    Analysis analysis{"crack", "Dynamic fracture"};
    analysis.choose_methods = [=](const scene::Scene &scene, const Methods &available,
                                  unsigned int n_levels, unsigned int n_jobs)
    {
      if (!scene.crack.is_there())
        throw InputError("scene '" + scene.name +
                         "': Crack/notch = 0, so there is no crack to follow; give its length, or "
                         "use 'plumbline run'");
      return choose_method(scene, available, n_levels, n_jobs, plan_of(scene));
    };
    analysis.analyse = [=](const Place &place, const Method &method) -> Records
    { return {study::analyse(place, method, plan_of(place.scene()), write)}; };
    analysis.conclude = conclude;
    analysis.sampled = {"advance", "speed", "threshold", "energy drift", "runs"};
    analysis.sampled_field = "damage";
    analysis.are_failures_findings = false;
    return analysis;
  }
} // namespace plumbline::study
