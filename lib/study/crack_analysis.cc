#include "study/crack_analysis.h"

#include "analysis/critical_step.h"
#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "study/growth_analysis.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace plumbline::study
{
  using method::NotchedStrip;

  namespace
  {
    /// The first n_levels of each series, coarse to fine; 0: all.
    void for_each_level(const scene::Scene &scene, unsigned int n_levels,
                        const std::function<void(const problem::Series &, const problem::Level &,
                                                 bool is_finest)> &visit)
    {
      for (const auto &series : scene.study.series)
      {
        const std::size_t n_all = series.levels.size(),
                          n = n_levels == 0 ? n_all : std::min<std::size_t>(n_levels, n_all);
        for (std::size_t level = 0; level < n; ++level)
          visit(series, series.levels[level], level + 1 == n);
      }
    }

    dealii::Tensor<1, 2> sides(const scene::Scene &scene)
    {
      const geometry::Box &strip = scene.domain.boxes.include.front();
      return strip.upper - strip.lower;
    }

    CrackThreshold find_threshold(const scene::Scene &scene, const Method &method,
                                  const problem::Series &series, const problem::Level &level)
    {
      const method::StripThreshold found = method.dynamic_fracture_solver()->strip_threshold(
          scene::make_double_well(scene, level.horizon), level.h,
          static_cast<int>(std::lround(sides(scene)[1] / level.h)), scene.geometry.backend);
      return {series.name, level.h, level.horizon, found.toughness, found.energy, found.failure};
    }

    /// All but what needs the strip.
    CrackPlan make_plan(const scene::Scene &scene, const std::filesystem::path &folder)
    {
      CrackPlan plan;
      plan.final_time = scene.time.final_time;
      plan.density = scene.time.density;
      plan.scheme = scene.time.schemes.front();
      plan.shows_blow_up = scene.time.shows_blow_up;
      plan.n_samples = scene.crack.n_samples;
      plan.n_frames = scene.time.n_frames;
      plan.interval = scene.crack.interval;
      plan.subject = "plumbline crack\n" + scene.text;
      plan.checkpoint = folder / "checkpoint.h5";
      if (plan.n_frames > plan.n_samples)
        throw InputError("Time/frames = " + std::to_string(plan.n_frames) +
                         " is more than Crack/samples = " + std::to_string(plan.n_samples) +
                         ", of which frames are some; raise that, or write fewer frames");
      return plan;
    }

    /// Its memory and disk are there; nothing is made before that.
    void check_size(const scene::Scene &scene, const problem::Level &level, const CrackPlan &plan,
                    unsigned int n_jobs)
    {
      // in vectors of a number a node: u, v, a and fields to which margins are added (11), a view
      // (4), the moments and their copy in a checkpoint
      constexpr double bytes = 8 * (15 + 2 * n_crack_moments + 4);
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
        std::vector<dealii::Point<2>> nodes;
        for (int j = 0; j < strip.n()[1]; ++j)
          for (int i = 0; i < strip.n()[0]; ++i)
            nodes.push_back(lower + strip.h() * dealii::Point<2>(i, j));
        write(times, nodes, state.u, view.damage);
      };
    }

    /// The motion of the strip.
    void move(const scene::Scene &scene, const NotchedStrip &strip, const WriteStrip &write,
              CrackResults &results)
    {
      results.n = strip.n();
      results.origin = scene.domain.origin;
      results.lower = middle(scene) + dealii::Point<2>(strip.x(0), strip.y(0));
      results.notch_tip = middle(scene)[0] + strip.notch_tip();
      results.n_bonds = strip.n_bonds();
      const CrackModel model = make_model(scene, strip, results.strain);
      const base::CpuTimer timer;
      results.history =
          run_crack(model, results.plan, frame_writer(results.plan, strip, results.lower, write));
      results.seconds = timer.seconds();
      results.asymmetry = strip.asymmetry(results.history.last.u);
      results.motion =
          describe_crack(results.history.samples,
                         {results.notch_tip, scene.domain.boxes.include.front().upper[0], strip.h(),
                          results.own.horizon, sides(scene)[1], results.transverse});
    }
  } // namespace

  void check_crack_size(const scene::Scene &scene, unsigned int n_levels,
                        const std::filesystem::path &folder, unsigned int n_jobs)
  {
    const CrackPlan plan = make_plan(scene, folder);
    for_each_level(scene, n_levels,
                   [&](const problem::Series &, const problem::Level &level, bool)
                   { check_size(scene, level, plan, n_jobs); });
  }

  CrackResults move_crack(const scene::Scene &scene, const Methods &available,
                          unsigned int n_levels, const std::filesystem::path &folder,
                          const WriteStrip &write, const std::function<void()> &before_it_moves)
  {
    CrackResults results;
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    const auto method = fracture_method(scene.methods.names.front(), available);
    results.method = method->name();
    results.crack = scene.crack;
    results.expected = scene.expected.crack;
    results.damping = scene.time.damping;
    results.plan = make_plan(scene, folder);
    bool is_first = true;
    for_each_level(scene, n_levels,
                   [&](const problem::Series &series, const problem::Level &level, bool is_finest)
                   {
                     results.thresholds.push_back(find_threshold(scene, *method, series, level));
                     if (is_first && is_finest)
                     {
                       results.own = results.thresholds.back();
                       is_first = false;
                     }
                   });
    if (!results.own.failure.empty())
      throw NumericalError("horizon " + base::to_text(results.own.horizon, 4) + ": " +
                           results.own.failure);
    const physics::DoubleWell law = scene::make_double_well(scene, results.own.horizon);
    results.toughness = law.toughness();
    results.transverse = law.wave_speeds(scene.time.density).transverse;
    results.longitudinal = law.wave_speeds(scene.time.density).longitudinal;
    const auto strip = make_strip(scene, *method, {results.own.h, results.own.horizon});
    results.strain = strip->strain(scene.crack.load * results.own.energy);
    plan_steps(scene, make_motion(scene, *strip), results.plan);
    if (before_it_moves)
      before_it_moves();
    move(scene, *strip, write, results);
    return results;
  }
} // namespace plumbline::study
