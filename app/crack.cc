#include "crack.h"

#include "analysis/critical_step.h"
#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "meshfree/lattice/crack_strip.h"
#include "output_folder.h"
#include "report/crack_page.h"
#include "report/formats.h"
#include "report/frames.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using analysis::Vector;
  using meshfree::CrackStrip;
  using study::CrackPlan;
  using study::CrackResults;

  namespace
  {
    dealii::Tensor<1, 2> sides(const scene::Scene &scene)
    {
      const geometry::Box &strip = scene.domain.boxes.include.front();
      return strip.upper - strip.lower;
    }

    std::vector<meshfree::WellBond> make_bonds(const scene::Scene &scene, const problem::Level &level)
    {
      const physics::DoubleWell law = scene::make_double_well(scene, level.horizon);
      const auto kernel = law.linear_kernel();
      const auto rule = find_rule(scene.methods.names.front()).of(kernel);
      return well_bonds(law, lattice_bonds(rule, kernel, level.h, scene.geometry.backend));
    }

    study::CrackThreshold find_threshold(const scene::Scene &scene, const problem::Series &series,
                                         const problem::Level &level)
    {
      const meshfree::CrackColumn column(make_bonds(scene, level), level.h,
                                         static_cast<int>(std::lround(sides(scene)[1] / level.h)));
      study::CrackThreshold threshold{series.name,
                                      level.h,
                                      level.horizon,
                                      column.toughness(),
                                      std::numeric_limits<double>::quiet_NaN(),
                                      {}};
      try
      {
        threshold.energy = column.threshold();
      }
      catch (const NumericalError &error)
      {
        threshold.failure = error.what();
      }
      return threshold;
    }

    /// All but what needs the strip.
    CrackPlan make_plan(const scene::Scene &scene, const fs::path &folder)
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
      constexpr double bytes = 8 * (15 + 2 * study::n_crack_moments + 4);
      const double n_nodes =
          sides(scene)[0] / level.h * (sides(scene)[1] + 2 * level.horizon) / level.h;
      base::require_memory(bytes * n_nodes, "a strip of " + base::to_text(n_nodes, 3) + " nodes",
                           "choose a larger h (Study/h)", n_jobs);
      study::check_room(plan, n_nodes);
    }

    /// Where what the scene calls (0, 0) lies for the strip, whose origin is its middle.
    dealii::Point<2> middle(const scene::Scene &scene)
    {
      return scene.domain.boxes.include.front().lower + .5 * sides(scene);
    }

    CrackStrip make_strip(const scene::Scene &scene, const problem::Level &level)
    {
      const auto cells = [&](double length)
      { return static_cast<int>(std::lround(length / level.h)); };
      return {
          make_bonds(scene, level),
          {{cells(sides(scene)[0]), cells(sides(scene)[1])}, cells(scene.crack.notch), level.h}};
    }

    /// @param strip  outlives it
    analysis::Motion make_motion(const scene::Scene &scene, const CrackStrip &strip)
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

    study::CrackModel make_model(const scene::Scene &scene, const CrackStrip &strip, double strain)
    {
      study::CrackModel model;
      model.motion = make_motion(scene, strip);
      model.start = strip.at_rest(strain, scene.crack.start == scene::CrackStart::opened);
      model.mass = scene.time.density * strip.h() * strip.h();
      model.energy = [&strip](const Vector &u) { return strip.energy(u); };
      model.view = [&strip, x = middle(scene)[0]](const Vector &u)
      {
        CrackStrip::View view = strip.view(u);
        return study::CrackView{view.tip + x, view.soft_energy, view.n_branches,
                                std::move(view.damage)};
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

    study::WriteFrame frame_writer(const CrackPlan &plan, const CrackStrip &strip,
                                   const dealii::Point<2> &lower, const fs::path &folder)
    {
      if (plan.n_frames == 0)
        return {};
      return [=, &strip](unsigned int index, const analysis::State &state,
                         const study::CrackView &view)
      {
        std::vector<double> times;
        for (unsigned int k = 0; k <= plan.n_samples && times.size() <= index; ++k)
          if (plan.frame(k))
            times.push_back(plan.time(k));
        std::vector<dealii::Point<2>> nodes;
        for (int j = 0; j < strip.n()[1]; ++j)
          for (int i = 0; i < strip.n()[0]; ++i)
            nodes.push_back(lower + strip.h() * dealii::Point<2>(i, j));
        const auto u = [&](std::size_t node, unsigned int component)
        { return state.u[component * nodes.size() + node]; };
        const auto damage = [&](std::size_t node, unsigned int) { return view.damage[node]; };
        report::write_frame(folder / "frames", "frame", times, nodes,
                            {{"u", true, u}, {"damage", false, damage}});
      };
    }

    /// The motion of the strip.
    void move(const scene::Scene &scene, const CrackStrip &strip, const fs::path &folder,
              CrackResults &results)
    {
      results.n = strip.n();
      results.origin = scene.domain.origin;
      results.lower = middle(scene) + dealii::Point<2>(strip.x(0), strip.y(0));
      results.notch_tip = middle(scene)[0] + strip.notch_tip();
      results.n_bonds = strip.n_bonds();
      const study::CrackModel model = make_model(scene, strip, results.strain);
      const base::CpuTimer timer;
      results.history = study::run_crack(model, results.plan,
                                         frame_writer(results.plan, strip, results.lower, folder));
      results.seconds = timer.seconds();
      results.asymmetry = strip.asymmetry(results.history.last.u);
      results.motion = study::describe_crack(
          results.history.samples,
          {results.notch_tip, scene.domain.boxes.include.front().upper[0], strip.h(),
           results.own.horizon, sides(scene)[1], results.transverse});
    }
  } // namespace

  void check_crack_size(const scene::Scene &scene, unsigned int n_levels, const fs::path &folder,
                        unsigned int n_jobs)
  {
    const CrackPlan plan = make_plan(scene, folder);
    for_each_level(scene, n_levels,
                   [&](const problem::Series &, const problem::Level &level, bool)
                   { check_size(scene, level, plan, n_jobs); });
  }

  CrackResults move_crack(const scene::Scene &scene, unsigned int n_levels, const fs::path &folder,
                          const std::function<void()> &before_it_moves)
  {
    CrackResults results;
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    results.method = find_rule(scene.methods.names.front()).name;
    results.crack = scene.crack;
    results.expected = scene.expected.crack;
    results.damping = scene.time.damping;
    results.plan = make_plan(scene, folder);
    bool is_first = true;
    for_each_level(scene, n_levels,
                   [&](const problem::Series &series, const problem::Level &level, bool is_finest)
                   {
                     results.thresholds.push_back(find_threshold(scene, series, level));
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
    const CrackStrip strip = make_strip(scene, {results.own.h, results.own.horizon});
    results.strain = strip.column().strain(scene.crack.load * results.own.energy);
    plan_steps(scene, make_motion(scene, strip), results.plan);
    if (before_it_moves)
      before_it_moves();
    move(scene, strip, folder, results);
    return results;
  }

  int crack(const CrackOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    if (!scene.crack.is_there())
      throw InputError("scene '" + scene.name +
                       "': Crack/notch = 0, so there is no crack to follow; give its length, or "
                       "use 'plumbline run'");
    const fs::path folder = output_folder(options, scene);
    std::optional<OutputFolder> output; // once nothing is refused any more
    check_crack_size(scene, options.n_levels, folder);
    const CrackResults results =
        move_crack(scene, options.n_levels, folder,
                   [&]
                   {
                     output.emplace(folder, OutputFolder::Owner{"crack", scene.name, scene.text},
                                    base::Communicator::alone());
                     report::write_file(folder / "crack.md", ""); // can it be written?
                   });
    if (!options.quiet && results.history.resumed_at > 0)
      std::cerr << "continued from t = " << base::to_text(results.history.resumed_at, 4) << ", of '"
                << results.plan.checkpoint.string() << "'\n";
    report::write_crack(results, folder);
    for (const std::string &warning : results.warnings())
      std::cerr << "warning: " << warning << '\n';
    std::error_code code;
    fs::remove(results.plan.checkpoint, code); // what is complete is done again, as its user asks
    if (options.json)
      std::cout << report::crack_json(results);
    else if (!options.quiet)
      std::cout << report::crack_text(results) << "\nwritten: " << (folder / "crack.html").string()
                << '\n';
    if (options.check && !results.is_as_expected())
    {
      std::cerr << "Expected/crack = " << base::word(results.expected) << ", but it "
                << report::crack_outcome_words(results.motion.outcome) << '\n';
      return 1;
    }
    return 0;
  }
} // namespace plumbline::app
