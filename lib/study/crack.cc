#include "study/crack.h"

#include "analysis/integrate.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    constexpr std::size_t n_numbers = 7; // of a sample

    Vector to_records(const CrackHistory &history)
    {
      Vector records{static_cast<double>(history.samples.size())};
      for (const CrackSample &s : history.samples)
        records.insert(records.end(),
                       {s.t, s.tip, s.kinetic, s.bonds, s.soft, s.dissipated, s.n_branches});
      for (const CrackMoment &moment : history.moments)
      {
        records.push_back(moment.t);
        records.insert(records.end(), moment.damage.begin(), moment.damage.end());
      }
      return records;
    }

    /// @throws InputError  other numbers than to_records() gives
    CrackHistory from_records(const Vector &records, std::size_t n_nodes, const CrackPlan &plan)
    {
      CrackHistory history;
      const std::size_t n = records.empty() || !(records[0] >= 1) || !(records[0] <= plan.n_samples)
                                ? 0
                                : static_cast<std::size_t>(records[0]);
      std::size_t n_moments = 0;
      for (unsigned int i = 0; i < n; ++i)
        n_moments += plan.moment(i) ? 1 : 0;
      if (n == 0 || records.size() != 1 + n_numbers * n + n_moments * (1 + n_nodes))
        throw InputError("checkpoint '" + plan.checkpoints.file().string() +
                         "' does not hold what this run writes; remove it to begin anew");
      auto next = records.begin() + 1;
      for (std::size_t i = 0; i < n; ++i, next += n_numbers)
        history.samples.push_back({next[0], next[1], next[2], next[3], next[4], next[5], next[6]});
      for (std::size_t i = 0; i < n_moments; ++i)
      {
        const auto begin = next + 1, end = begin + static_cast<std::ptrdiff_t>(n_nodes);
        history.moments.push_back({*next, {begin, end}});
        next = end;
      }
      return history;
    }

    CrackSample take_sample(const CrackModel &model, const State &state, const CrackView &view,
                            double dissipated)
    {
      return {state.t,
              view.tip,
              .5 * model.mass * analysis::dot(state.v, state.v),
              model.energy(state.u),
              view.soft_energy,
              dissipated,
              static_cast<double>(view.n_branches)};
    }
  } // namespace

  namespace
  {
    /// @return  the energy that damping has dissipated on the way
    double advance(const CrackModel &model, const CrackPlan &plan, double end, State &state,
                   std::uint64_t &n_steps)
    {
      double dissipated = 0;
      analysis::Observer observer;
      if (model.motion.damping > 0)
        observer = [&, before = State{{}, {}, state.t},
                    rate = analysis::dot(state.v, state.v)](const State &now) mutable
        {
          const double next = analysis::dot(now.v, now.v);
          dissipated += .5 * model.motion.damping * model.mass * (now.t - before.t) * (rate + next);
          before.t = now.t;
          rate = next;
        };
      n_steps += analysis::integrate(model.motion, analysis::scheme(plan.scheme),
                                     {plan.step, plan.critical_step, plan.shows_blow_up}, end,
                                     state, observer)
                     .n_steps;
      return dissipated;
    }
  } // namespace

  CrackHistory run_crack(const CrackModel &model, const CrackPlan &plan,
                         const WriteFrame &write_frame)
  {
    CrackHistory history;
    State &state = history.last;
    state = {model.start, Vector(model.start.size()), 0};
    CrackView view;
    const auto take = [&](double dissipated)
    {
      view = model.view(state.u);
      history.samples.push_back(take_sample(model, state, view, dissipated));
    };
    SampledMotion motion;
    motion.resume = [&](const Vector &records)
    {
      const State saved = state;
      history = from_records(records, model.start.size() / 2, plan);
      history.last = saved;
      history.resumed_at = saved.t;
    };
    motion.n_taken = [&] { return static_cast<unsigned int>(history.samples.size()); };
    motion.begin = [&] { take(0); };
    motion.advance = [&](double end)
    {
      const double dissipated = history.samples.back().dissipated;
      take(dissipated + advance(model, plan, end, state, history.n_steps));
    };
    motion.on_sample = [&](unsigned int sample)
    {
      if (plan.moment(sample))
        history.moments.push_back({state.t, view.damage});
      if (const auto frame = plan.frame(sample); frame && write_frame)
        write_frame(*frame, state, view);
    };
    motion.records = [&] { return to_records(history); };
    run_samples(plan, state, motion);
    return history;
  }

  namespace
  {
    using Samples = std::vector<CrackSample>;

    /// Slope of the line fitted to the tip where it is between 1/5 and 4/5 of its way.
    double fitted_speed(const Samples &samples, double way)
    {
      double n = 0, t = 0, x = 0, tt = 0, tx = 0;
      for (const CrackSample &sample : samples)
        if (const double part = (sample.tip - samples.front().tip) / way; part >= .2 && part <= .8)
        {
          ++n;
          t += sample.t;
          x += sample.tip;
          tt += sample.t * sample.t;
          tx += sample.t * sample.tip;
        }
      return n >= 2 ? (n * tx - t * x) / (n * tt - t * t) : 0;
    }

    /// From the last one before the tip leaves its place to the first one where it ends.
    std::size_t samples_in_motion(const Samples &samples)
    {
      const auto leaves =
          std::find_if(samples.begin(), samples.end(),
                       [&](const CrackSample &sample) { return sample.tip > samples.front().tip; });
      const auto ends =
          std::find_if(samples.begin(), samples.end(),
                       [&](const CrackSample &sample) { return sample.tip >= samples.back().tip; });
      return leaves < ends ? static_cast<std::size_t>(ends - leaves) + 1 : 1;
    }

    /// The longest way of the tip while there are several cracks side by side.
    double branched_way(const Samples &samples)
    {
      double longest = 0;
      for (std::size_t first = 0, i = 0; i < samples.size(); ++i)
        if (samples[i].n_branches > 1)
          longest = std::max(longest, samples[i].tip - samples[first].tip);
        else
          first = i + 1;
      return longest;
    }

    /// How far the tip went in the last part of the time.
    double last_way(const Samples &all, double part)
    {
      const double since = (1 - part) * all.back().t;
      const auto first = std::find_if(all.begin(), all.end() - 1,
                                      [&](const CrackSample &sample) { return sample.t >= since; });
      return all.back().tip - (first == all.end() - 1 ? all[all.size() - 2].tip : first->tip);
    }

    /// Kinetic energy in the last quarter of the time is larger than in the one before, and not
    /// rounding of the whole.
    bool is_gathering_speed(const Samples &all)
    {
      constexpr double rounding = 1e-12;
      double before = 0, last = 0;
      for (const CrackSample &sample : all)
      {
        double &largest = sample.t < .75 * all.back().t ? before : last;
        if (sample.t >= .5 * all.back().t)
          largest = std::max(largest, sample.kinetic);
      }
      return last > before && last > rounding * std::abs(all.front().total());
    }

    /// @param before_end  samples while the tip is away from the strip's end
    void judge_motion(const Samples &all, const Samples &before_end, const CrackScales &scales,
                      CrackMotion &motion)
    {
      using Outcome = scene::CrackOutcome;
      constexpr double few_horizons = 2, to_branch = 4; // horizons
      constexpr double few_crossings = 10, few_transits = 2, to_arrest = 4;
      const auto text = [](double value) { return base::to_text(value, 3); };
      const double time = all.back().t, horizon = scales.horizon;
      const double crossings = time / scales.crossing(), transits = time / scales.transit();
      const std::string length = "the time is " + text(crossings) + " crossings of a horizon and " +
                                 text(transits) + " transits from grip to grip by shear waves";
      const auto conclude = [&](Outcome outcome, const std::string &reason)
      {
        motion.outcome = outcome;
        motion.reason = reason;
      };
      const double branched = branched_way(before_end);
      const std::string beside = // cracks come and go side by side where they run fast
          branched < horizon
              ? ""
              : ", for " + text(branched / horizon) +
                    " horizons with a second crack beside it (a branch: " + text(to_branch) +
                    " or more)";
      if (branched >= to_branch * horizon)
        conclude(Outcome::branches,
                 "two cracks or more run side by side while the tip advances by " +
                     text(branched / horizon) + " horizons");
      else if (before_end.size() < all.size())
        conclude(Outcome::runs, "the tip comes to the end of the strip" + beside);
      else if (crossings < few_crossings || transits < few_transits)
        conclude(Outcome::too_short, length + "; the run needs at least " + text(few_crossings) +
                                         " and " + text(few_transits) + ", and " + text(to_arrest) +
                                         " transits to show an arrest: Time/final time = " +
                                         text(std::max(few_crossings * scales.crossing(),
                                                       to_arrest * scales.transit())) +
                                         " or more");
      else if (motion.advance >= few_horizons * horizon && last_way(all, .2) >= scales.h)
        conclude(Outcome::runs, "the tip advances by " + text(motion.advance / horizon) +
                                    " horizons and still moves at the final time" + beside);
      else if (last_way(all, .5) >= scales.h)
        conclude(Outcome::too_short,
                 "the tip advances by " + text(motion.advance / horizon) +
                     " horizons, some of it in the second half of the time; lengthen Time/final "
                     "time");
      else if (transits < to_arrest)
        conclude(Outcome::too_short, length + "; a crack that stands still needs " +
                                         text(to_arrest) + " transits to be called arrested");
      else if (is_gathering_speed(all))
        conclude(Outcome::too_short, "the tip stands still, but the kinetic energy still grows; "
                                     "lengthen Time/final time");
      else
        conclude(Outcome::arrests,
                 "the tip advances by less than h in the second half of the time, " +
                     text(transits / 2) + " transits from grip to grip");
    }
  } // namespace

  CrackMotion describe_crack(const std::vector<CrackSample> &all, const CrackScales &scales)
  {
    CrackMotion motion;
    const double start = all.front().total();
    for (const CrackSample &sample : all)
      motion.energy_drift = std::max(motion.energy_drift, std::abs(sample.total() - start) / start);
    const auto at_end = std::find_if(all.begin(), all.end(),
                                     [&](const CrackSample &sample)
                                     { return sample.tip >= scales.right_end - scales.horizon; });
    const Samples samples(all.begin(), at_end);
    if (samples.size() < 2)
      return motion;
    const CrackSample &first = samples.front(), &last = samples.back();
    motion.advance = last.tip - scales.notch_tip;
    const double way = last.tip - first.tip;
    if (way > scales.h)
      motion.soft_per_length = (last.soft - first.soft) / way;
    if (way > scales.horizon)
      motion.speed = fitted_speed(samples, way);
    const std::size_t window = std::max<std::size_t>(1, samples_in_motion(samples) / 10);
    for (std::size_t i = window; i < samples.size(); ++i)
    {
      const CrackSample &from = samples[i - window], &to = samples[i];
      motion.window = to.t - from.t;
      motion.speeds.push_back({.5 * (from.t + to.t), (to.tip - from.tip) / motion.window});
      motion.fastest = std::max(motion.fastest, motion.speeds.back()[1]);
    }
    judge_motion(all, samples, scales, motion);
    return motion;
  }

  std::vector<std::string> warnings_of_strain(double strain)
  {
    if (std::abs(strain) <= large_strain)
      return {};
    return {"the strain of the grips is " + base::to_text(strain, 3) + ", beyond " +
            base::to_text(large_strain, 2) +
            ": bonds have linear kinematics, which hold for small strains. With Material/beta "
            "times k² and Material/c over k² the same motion, with the same speeds and outcome, "
            "has 1/k of the strains; to keep the material, lower Crack/load"};
  }

  double rayleigh_ratio(double k)
  {
    double low = 0, high = 1;
    while (high - low > 1e-15)
    {
      const double x = .5 * (low + high);
      (((x - 8) * x + 24 - 16 * k) * x - 16 * (1 - k) < 0 ? low : high) = x;
    }
    return std::sqrt(low);
  }

  void check_room(const CrackPlan &plan, double n_nodes)
  {
    // a point of a frame: its place, u and damage, indices, as compressed text; of a checkpoint: u,
    // v and the moments, while the last one is still there; of journal and results, as text
    constexpr double frame_bytes = 50, checkpoint_bytes = 2 * 8 * (4 + n_crack_moments),
                     record_bytes = 2 * 20 * (2 + n_crack_moments);
    const std::string folder = plan.checkpoints.folder.string();
    const double available = base::available_disk(folder);
    const double frames = plan.n_frames == 0 ? 0 : (plan.n_frames + 1.) * frame_bytes * n_nodes,
                 needed = frames + (checkpoint_bytes + record_bytes) * n_nodes;
    if (needed > available)
      throw InputError("Time/frames = " + std::to_string(plan.n_frames) + ": " +
                       std::to_string(plan.n_frames) + " frames and a checkpoint of " +
                       std::to_string(static_cast<long long>(n_nodes)) + " nodes need some " +
                       base::bytes_to_text(needed) + " of disk, and " +
                       base::bytes_to_text(available) + " are free in '" + folder +
                       "'; write fewer frames, raise Study/h, or give another folder (-o)");
  }

  std::vector<std::string> left_out_of_cracks()
  {
    return {
        "two dimensions, one lattice, λ = μ: Poisson's ratio is 1/4 in plane strain, 1/3 in plane "
        "stress",
        "double-well bonds are reversible: an unloaded crack closes and its bonds are intact "
        "again; only the notch is cut permanently, which the paper's model does not have",
        "no contact forces between crack faces, except those of their bonds",
        "both ends of the strip are free, without a surface correction of the bonds",
        "no wear, heat or rate dependence of the bonds; no damping except that of the scene",
        "the energy of softened bonds is not the surface energy: while a crack runs it exceeds G_c "
        "per length, because bonds beside the crack soften as well"};
  }
} // namespace plumbline::study
