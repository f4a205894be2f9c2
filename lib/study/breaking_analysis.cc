#include "study/breaking_analysis.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "physics/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  using dealii::Point;

  namespace
  {
    constexpr unsigned int n_samples = 120, checkpoint_interval = 10;
    constexpr double worst_imbalance = .01, // above them there is a failure, or a warning
        largest_overshoot = .15, largest_gain = .01;

    /// g at a time, see method::BreakingMotion.
    std::vector<double> drive_at(const scene::Scene &scene, const method::MovingBody &body,
                                 double horizon, double t)
    {
      const physics::Names names = scene.names(horizon, t);
      std::optional<physics::Expression> load, constraint;
      if (!scene.problem.loads.empty())
        load.emplace("Problem/load", scene.problem.loads.front().expression, names);
      if (scene.problem.constraint)
        constraint.emplace("Problem/constraint", *scene.problem.constraint, names);
      const std::vector<Point<2>> &nodes = body.parts.nodes;
      std::vector<double> g(2 * nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (const auto &field = body.motion->is_free(i) ? load : constraint)
          for (unsigned int c = 0; c < 2; ++c)
            g[2 * i + c] = (*field)(nodes[i], c);
      return g;
    }

    Vector first_velocity(const scene::Scene &scene, const method::MovingBody &body,
                          const problem::Level &level)
    {
      Vector velocity(body.motion->size());
      if (scene.time.initial_velocity.empty())
        return velocity;
      physics::Names names = scene.names(level.horizon);
      names.constants["h"] = level.h;
      const physics::Expression given("Time/initial velocity", scene.time.initial_velocity, names);
      std::size_t next = 0;
      for (std::size_t i = 0; i < body.parts.nodes.size(); ++i)
        if (body.motion->is_free(i))
          for (unsigned int c = 0; c < 2; ++c)
            velocity[next++] = given(body.parts.nodes[i], c);
      return velocity;
    }

    /// Some nodes in grips, or free ones, spread over all of them.
    std::vector<Point<2>> some_nodes(const method::MovingBody &body, bool are_free)
    {
      std::vector<Point<2>> nodes, some;
      for (std::size_t i = 0; i < body.parts.nodes.size(); ++i)
        if (body.motion->is_free(i) == are_free)
          nodes.push_back(body.parts.nodes[i]);
      constexpr std::size_t most = 1000;
      if (nodes.size() <= most)
        return nodes;
      constexpr double golden = .6180339887498949; // multiples of it meet no row of a lattice twice
      for (std::size_t k = 0; k < most; ++k)
      {
        const double place = golden * static_cast<double>(k);
        some.push_back(nodes[static_cast<std::size_t>((place - std::floor(place)) *
                                                      static_cast<double>(nodes.size()))]);
      }
      return some;
    }

    /// How many times a function takes at least, see analysis::TimeSeries::points: pulses between
    /// few times are not missed.
    std::size_t points_in_time(const scene::Scene &scene, const std::string &key,
                               const std::string &text, const std::vector<Point<2>> &nodes,
                               double horizon)
    {
      const auto values = [&](double t)
      {
        const physics::Expression given(key, text, scene.names(horizon, t));
        Vector result;
        for (const Point<2> &x : nodes)
          for (unsigned int c = 0; c < 2; ++c)
            result.push_back(given(x, c));
        return result;
      };
      const auto n = analysis::TimeSeries::points(values, scene.time.final_time);
      if (!n)
        throw InputError(key + " = '" + text +
                         "' varies so fast in t that 65 Chebyshev points up to Time/final time do "
                         "not resolve it; shorten the time, or give a function that is smoother in "
                         "t");
      return *n;
    }

    /// The displacement at t = 0 is 0, also of grips.
    void check_start(const scene::Scene &scene, const problem::Level &level,
                     const method::MovingBody &body)
    {
      if (!scene.problem.constraint)
        return;
      constexpr double negligible = 1e-9; // of h
      const physics::Expression constraint("Problem/constraint", *scene.problem.constraint,
                                           scene.names(level.horizon, 0));
      const auto text = [](double x, double y)
      { return "(" + base::to_text(x, 4) + ", " + base::to_text(y, 4) + ")"; };
      for (std::size_t i = 0; i < body.parts.nodes.size(); ++i)
        if (!body.motion->is_free(i))
        {
          const Point<2> &node = body.parts.nodes[i];
          const double u = constraint(node, 0), v = constraint(node, 1);
          if (std::max(std::abs(u), std::abs(v)) <= negligible * level.h)
            continue;
          const Point<2> place = node + scene.domain.origin;
          throw InputError("Problem/constraint = '" + *scene.problem.constraint + "' is " +
                           text(u, v) + " at the node " + text(place[0], place[1]) +
                           " of a grip at t = 0, where the body is unstrained; give a function "
                           "that is 0 at t = 0");
        }
    }

    DrivenBody make_driven(const scene::Scene &scene, const problem::Level &level,
                           method::MovingBody body)
    {
      constexpr double tolerance = 1e-11;
      check_start(scene, level, body);
      const auto at = [&](double t) { return drive_at(scene, body, level.horizon, t); };
      std::size_t least = 0;
      if (!scene.is_steady() && !scene.problem.loads.empty())
        least = points_in_time(scene, "Problem/load", scene.problem.loads.front().expression,
                               some_nodes(body, true), level.horizon);
      if (!scene.is_steady() && scene.problem.constraint)
        least =
            std::max(least, points_in_time(scene, "Problem/constraint", *scene.problem.constraint,
                                           some_nodes(body, false), level.horizon));
      const std::string load = scene.problem.loads.empty() ? "" : "Problem/load",
                        grips = scene.problem.constraint ? "Problem/constraint" : "",
                        both = grips + (grips.empty() || load.empty() ? "" : " and ") + load;
      analysis::TimeSeries drive =
          scene.is_steady()
              ? analysis::TimeSeries(at(0))
              : analysis::TimeSeries::resolve(at, scene.time.final_time, tolerance, both, least);
      Vector velocity = first_velocity(scene, body, level);
      return {std::move(body), std::move(drive), scene.time.density, scene.time.damping,
              std::move(velocity)};
    }

    /// A notched plate takes some thousand.
    constexpr double most_steps = 1e6;

    CrackPlan make_plan(const scene::Scene &scene, const DrivenBody &driven,
                        const Checkpoints &checkpoints, bool has_frames)
    {
      CrackPlan plan;
      plan.final_time = scene.time.final_time;
      plan.density = scene.time.density;
      plan.scheme = scene.time.schemes.front();
      if (analysis::scheme(plan.scheme).is_runge_kutta)
        throw InputError("Time/schemes = " + plan.scheme +
                         " chooses its own steps, between which bonds cannot break; write velocity "
                         "Verlet, or another scheme with equal steps");
      plan.shows_blow_up = scene.time.shows_blow_up;
      plan.n_samples = n_samples; // steps end there: not the scene's to choose
      if (scene.time.n_frames > n_samples)
        throw InputError("Time/frames = " + std::to_string(scene.time.n_frames) +
                         " is more than the " + std::to_string(n_samples) +
                         " times at which bodies in motion are recorded; write fewer frames");
      plan.interval = checkpoint_interval;
      plan.subject = "plumbline grow\n" + scene.text;
      plan.checkpoints = checkpoints;
      if (has_frames)
        plan.n_frames = scene.time.n_frames;
      const analysis::Transient transient(*driven.body.motion, driven.drive, driven.density,
                                          driven.damping);
      const double longest = transient.critical_step(analysis::scheme(plan.scheme));
      if (std::isfinite(longest) && longest > 0)
        plan.critical_step = longest;
      plan.step = !scene.time.steps.empty()
                      ? scene.time.steps.back()
                      : scene.time.fractions.back() *
                            (plan.critical_step
                                 ? longest
                                 : transient.critical_step(analysis::scheme("velocity Verlet")));
      const bool is_too_long =
          plan.critical_step && plan.step > *plan.critical_step && !plan.shows_blow_up;
      if (!is_too_long) // else analysis::integrate says so
        plan.step = recorded_step(plan.final_time, n_samples, plan.step, !scene.time.steps.empty());
      if (const double n_steps = plan.final_time / plan.step; n_steps > most_steps)
        throw InputError("Time/final time = " + base::to_text(plan.final_time, 6) + " takes " +
                         base::to_text(n_steps, 3) + " steps of " + base::to_text(plan.step, 3) +
                         ", more than " + base::to_text(most_steps, 3) +
                         "; give the final time in the unit of time that follows from E, "
                         "Time/density and lengths, or choose a larger h");
      return plan;
    }

    WriteBreaking frame_writer(const CrackPlan &plan, const DrivenBody &driven,
                               const WriteStrip &write)
    {
      if (plan.n_frames == 0 || !write)
        return {};
      return [=, &driven](unsigned int index, double t, const State &state,
                          const BreakingHistory &history)
      {
        std::vector<double> times;
        for (unsigned int k = 0; k <= plan.n_samples && times.size() <= index; ++k)
          if (plan.frame(k))
            times.push_back(plan.time(k));
        const method::BreakableBody<2> &parts = driven.body.parts;
        const Vector u = driven.body.motion->displacements(state.u, driven.drive.at(t));
        Vector by_component(u.size());
        for (std::size_t i = 0; i < parts.nodes.size(); ++i)
          for (std::size_t c = 0; c < 2; ++c)
            by_component[c * parts.nodes.size() + i] = u[2 * i + c];
        write(times, parts.nodes, by_component, parts.damage(history.broken(t)));
      };
    }

    double longest_side(const geometry::Domain &domain)
    {
      Point<2> lower = domain.include.front().lower, upper = domain.include.front().upper;
      for (const geometry::Box &box : domain.include)
        for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] = std::min(lower[d], box.lower[d]);
          upper[d] = std::max(upper[d], box.upper[d]);
        }
      return std::max(upper[0] - lower[0], upper[1] - lower[1]);
    }

    void add_samples(const BreakingHistory &history, Record &record)
    {
      analysis::Curve samples =
          curve_of({"t", "kinetic", "bonds", "broken", "dissipated", "work", "excess"});
      samples[0].unit = "time";
      for (const BreakingSample &s : history.samples)
        add_row(samples, {s.t, s.kinetic, s.bond, s.broken, s.dissipated, s.work,
                          s.excess() - history.samples.front().excess()});
      record.curves["samples"] = std::move(samples);
      analysis::Curve breaks = curve_of({"t", "bonds", "energy"});
      breaks[0].unit = "time";
      double overshoot = 0, n = 0;
      for (const TimedBreaks &one : history.breaks)
      {
        add_row(breaks, {one.t, static_cast<double>(one.bonds.size()), one.energy});
        overshoot += one.overshoot;
        n += static_cast<double>(one.bonds.size());
      }
      record.curves["breaks"] = std::move(breaks);
      record.set("broken bonds", n);
      record.set("broken energy", history.samples.back().broken, "force");
      record.set("energy gained", energy_gained(history), "force");
      record.set("energy imbalance", energy_imbalance(history.samples));
      if (n == 0)
        return;
      record.set("overshoot", overshoot / n);
      record.set("first break", history.breaks.front().t, "time");
    }

    void add_moments(const BreakingHistory &history, const method::BreakableBody<2> &parts,
                     const Point<2> &origin, Record &record)
    {
      const double end = history.samples.back().t;
      analysis::PointField field{n_crack_moments, {}, {}};
      for (const Point<2> &node : parts.nodes)
        field.points.push_back(node + origin);
      field.values.resize(n_crack_moments * parts.nodes.size());
      analysis::Curve curve = {{"t", "time", {}}};
      for (std::size_t k = 0; k < n_crack_moments; ++k)
      {
        const double t = end * static_cast<double>(k) / (n_crack_moments - 1);
        curve[0].values.push_back(t);
        const std::vector<double> damage = parts.damage(history.broken(t));
        for (std::size_t i = 0; i < damage.size(); ++i)
          field.values[n_crack_moments * i + k] = damage[i];
      }
      record.fields["damage"] = std::move(field);
      record.curves["moments"] = std::move(curve);
    }

    void add_cracks(const std::vector<NotchCrack> &cracks, const NotchCrack &main,
                    const Point<2> &origin, Record &record)
    {
      analysis::Curve all =
          curve_of({"notch x", "notch y", "tip x", "tip y", "advance", "angle", "branched"});
      for (const NotchCrack &one : cracks)
        add_row(all, {one.from[0] + origin[0], one.from[1] + origin[1], one.to[0] + origin[0],
                      one.to[1] + origin[1], one.advance, one.angle, one.branched});
      record.curves["cracks"] = std::move(all);
      analysis::Curve tip = curve_of({"t", "advance"});
      tip[0].unit = "time";
      tip[1].unit = "length";
      for (std::size_t i = 0; i < main.t.size(); ++i)
        add_row(tip, {main.t[i], main.tip[i]});
      record.curves["tip"] = std::move(tip);
      record.set("advance", main.advance, "length");
      record.set("angle", main.angle, "degree");
      record.set("branched", main.branched, "length");
    }

    /// Speeds of the crack that went farthest, and what becomes of it.
    void add_outcome(const scene::Scene &scene, const GrowthModel &parts, const NotchCrack &main,
                     double last_joined, double horizon, Record &record)
    {
      const physics::Lame lame = scene.material.lame()(main.from);
      const double c_T = std::sqrt(lame.mu / scene.time.density),
                   c_R = c_T * rayleigh_ratio(lame.mu / (lame.lambda + 2 * lame.mu));
      record.set("c_T", c_T, "length/time");
      record.set("c_R", c_R, "length/time");
      if (const auto speed = fitted_speed(main, horizon))
      {
        record.set("speed", *speed, "length/time");
        record.set("speed / c_R", *speed / c_R);
      }
      if (const auto fastest = fastest_speed(main, horizon))
        record.set("fastest / c_R", *fastest / c_R);
      const BreakingOutcome found = judge_breaking(main, last_joined, scene.time.final_time,
                                                   horizon, longest_side(scene.domain.boxes) / c_T,
                                                   is_at_boundary(parts, main.to, horizon));
      record.texts["outcome"] = base::word(found.outcome);
      record.texts["reason"] = found.reason;
    }

    /// What broken bonds dissipate against what G says, and what to think of it.
    void add_dissipation(const BreakingHistory &history, const GrowthModel &parts, Record &record)
    {
      double by_toughness = 0;
      for (const BrokenPart &part : broken_parts(parts, history.broken(history.samples.back().t)))
        by_toughness += part.toughness * part.length;
      if (by_toughness == 0)
        return;
      const double broken = record["broken energy"], overshoot = record["overshoot"],
                   gained = record["energy gained"];
      record.set("broken energy / G", broken / by_toughness);
      if (overshoot > largest_overshoot)
        record.notes.push_back(
            "bonds are found broken at stretches that are " + base::to_text(100 * overshoot, 3) +
            " % beyond s0 on average, so that they dissipate about twice that more energy; write "
            "a smaller Time/critical fractions (or Time/steps), to which the excess is "
            "proportional");
      if (const double part = gained / (broken + gained); gained > 0 && !(part <= largest_gain))
        record.notes.push_back(
            "as bonds broke that were stretched where others are compressed (lambda > mu), the "
            "energy of the body rose in some steps, by " +
            base::to_text(100 * part, 3) +
            " % of what it fell by in the others; take lambda = mu (Material/nu = 0.25 in plane "
            "strain), or do not rely on \"broken energy\"");
    }

    /// The breaks as events whose loads are times.
    std::vector<analysis::Event> events_of(const BreakingHistory &history)
    {
      std::vector<analysis::Event> events;
      for (const TimedBreaks &one : history.breaks)
      {
        analysis::Event event;
        event.critical = event.load = one.t;
        event.bonds = one.bonds;
        events.push_back(std::move(event));
      }
      return events;
    }
  } // namespace

  Record breaking_record(const Place &place, method::MovingBody body,
                         const Checkpoints &checkpoints, const WriteStrip &write, Record record)
  {
    const scene::Scene &scene = place.scene();
    const problem::Level &level = place.level();
    const Point<2> &origin = scene.domain.origin;
    check_mouths(body.parts, scene.domain.cracks, origin);
    DrivenBody driven = make_driven(scene, level, std::move(body));
    const CrackPlan plan = make_plan(scene, driven, checkpoints, static_cast<bool>(write));
    check_room(plan, static_cast<double>(driven.body.parts.nodes.size()));
    const base::CpuTimer timer;
    const BreakingHistory history = run_breaking(driven, plan, frame_writer(plan, driven, write));
    record.cost.solve_seconds = timer.seconds();
    const method::BreakableBody<2> &parts = driven.body.parts;
    record.cost.n_unknowns = driven.body.motion->size();
    record.cost.n_bonds = parts.bonds.size();
    record.texts["scheme"] = plan.scheme;
    record.set("time step", plan.step, "time");
    if (plan.critical_step)
      record.set("critical step", *plan.critical_step, "time");
    record.set("nodes", static_cast<double>(parts.nodes.size()));
    record.set("bonds", static_cast<double>(parts.bonds.size()));
    record.set("resumed at", history.resumed_at, "time");
    add_samples(history, record);
    add_moments(history, parts, origin, record);
    const CrackPath path = find_path(parts, events_of(history));
    std::vector<double> times;
    for (const TimedBreaks &one : history.breaks)
      times.push_back(one.t);
    const std::vector<NotchCrack> cracks =
        notch_cracks(parts, path, times, scene.domain.cracks, level.horizon);
    const NotchCrack &main = *std::max_element(cracks.begin(), cracks.end(),
                                               [](const NotchCrack &a, const NotchCrack &b)
                                               { return a.advance < b.advance; });
    double last_joined = 0;
    for (const NotchCrack &crack : cracks)
      last_joined = std::max(last_joined, crack.last_joined);
    add_cracks(cracks, main, origin, record);
    add_outcome(scene, parts, main, last_joined, level.horizon, record);
    add_dissipation(history, parts, record);
    record.set("apart", static_cast<double>(path.n_elsewhere));
    return record;
  }

  std::vector<Expectation> check_breaking(const Record &record,
                                          const scene::ExpectedSection &expected)
  {
    std::vector<Expectation> found;
    const double imbalance = record["energy imbalance"];
    found.push_back({"energy balance", "below " + base::to_text(worst_imbalance, 2),
                     base::to_text(imbalance, 3), imbalance < worst_imbalance});
    const std::string &outcome = record.text("outcome"), wanted = base::word(expected.crack);
    if (expected.crack != scene::CrackOutcome::unknown)
      found.push_back({"Expected/crack", wanted, outcome, outcome == wanted});
    return found;
  }
} // namespace plumbline::study
