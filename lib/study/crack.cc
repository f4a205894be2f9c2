#include "study/crack.h"

#include "analysis/checkpoint.h"
#include "base/error.h"
#include "base/memory.h"

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
        throw InputError("checkpoint '" + plan.checkpoint.string() +
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

    /// i if sample is the i-th of `intervals` even parts of all samples, rounded.
    std::optional<unsigned int> part(unsigned int sample, unsigned int n_samples,
                                     unsigned int intervals)
    {
      const double ratio = static_cast<double>(n_samples) / intervals;
      const auto i = static_cast<unsigned int>(std::lround(sample / ratio));
      if (static_cast<unsigned int>(std::lround(i * ratio)) == sample)
        return i;
      return {};
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

  double CrackPlan::time(unsigned int sample) const
  {
    return sample == n_samples ? final_time : final_time * sample / n_samples;
  }

  std::optional<unsigned int> CrackPlan::frame(unsigned int sample) const
  {
    if (n_frames == 0)
      return {};
    return part(sample, n_samples, n_frames);
  }

  std::optional<unsigned int> CrackPlan::moment(unsigned int sample) const
  {
    return part(sample, n_samples, n_crack_moments - 1);
  }

  CrackHistory run_crack(const CrackModel &model, const CrackPlan &plan,
                         const WriteFrame &write_frame)
  {
    const std::size_t n_nodes = model.start.size() / 2;
    State state{model.start, Vector(model.start.size()), 0};
    CrackHistory history;
    const auto saved = analysis::read_checkpoint(plan.checkpoint.string());
    if (saved && saved->subject == plan.subject && saved->state.u.size() == state.u.size())
    {
      history = from_records(saved->records, n_nodes, plan);
      state = saved->state;
      history.resumed_at = state.t;
    }
    const auto look = [&](unsigned int sample, double dissipated)
    {
      const CrackView view = model.view(state.u);
      history.samples.push_back(take_sample(model, state, view, dissipated));
      if (plan.moment(sample))
        history.moments.push_back({state.t, view.damage});
      if (const auto frame = plan.frame(sample); frame && write_frame)
        write_frame(*frame, state, view);
    };
    if (history.samples.empty())
      look(0, 0);
    const auto &scheme = analysis::scheme(plan.scheme);
    for (auto k = static_cast<unsigned int>(history.samples.size()); k <= plan.n_samples; ++k)
    {
      double dissipated = history.samples.back().dissipated;
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
      history.n_steps += analysis::integrate(model.motion, scheme,
                                             {plan.step, plan.critical_step, plan.shows_blow_up},
                                             plan.time(k), state, observer)
                             .n_steps;
      look(k, dissipated);
      if (k % plan.interval == 0 && k < plan.n_samples)
        analysis::write_checkpoint(plan.checkpoint.string(),
                                   {plan.subject, state, to_records(history)});
    }
    history.last = std::move(state);
    return history;
  }

  CrackMotion describe_crack(const std::vector<CrackSample> &all, double notch_tip,
                             double right_end, double h, double horizon)
  {
    CrackMotion motion;
    const double start = all.front().total();
    for (const CrackSample &sample : all)
      motion.energy_drift = std::max(motion.energy_drift, std::abs(sample.total() - start) / start);
    const auto at_end =
        std::find_if(all.begin(), all.end(),
                     [&](const CrackSample &sample) { return sample.tip >= right_end - horizon; });
    const std::vector<CrackSample> samples(all.begin(), at_end);
    if (samples.size() < 2)
      return motion;
    const CrackSample &first = samples.front(), &last = samples.back();
    motion.advance = last.tip - notch_tip;
    const double way = last.tip - first.tip;
    if (way > h)
      motion.soft_per_length = (last.soft - first.soft) / way;

    double n = 0, t = 0, x = 0, tt = 0, tx = 0;
    for (const CrackSample &sample : samples)
      if (const double part = (sample.tip - first.tip) / way; part >= .2 && part <= .8)
      {
        ++n;
        t += sample.t;
        x += sample.tip;
        tt += sample.t * sample.t;
        tx += sample.t * sample.tip;
      }
    if (way > horizon && n >= 2)
      motion.speed = (n * tx - t * x) / (n * tt - t * t);
    const std::size_t window = std::max<std::size_t>(1, (all.size() - 1) / 10);
    for (std::size_t i = window; i < samples.size(); ++i)
      motion.fastest = std::max(motion.fastest, (samples[i].tip - samples[i - window].tip) /
                                                    (samples[i].t - samples[i - window].t));
    const std::size_t before = all.size() - 1 - std::min(window, all.size() - 1);
    const bool runs = at_end != all.end() || all.back().tip - all[before].tip >= h;
    motion.outcome = !runs                       ? scene::CrackOutcome::arrests
                     : all.back().n_branches > 1 ? scene::CrackOutcome::branches
                                                 : scene::CrackOutcome::runs;
    return motion;
  }

  double rayleigh_ratio()
  {
    constexpr double k = 1. / 3;
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
    // v and the moments, while the last one is still there
    constexpr double frame_bytes = 50, checkpoint_bytes = 2 * 8 * (4 + n_crack_moments);
    const std::string folder = plan.checkpoint.parent_path().string();
    const double available = base::available_disk(folder);
    const double frames = plan.n_frames == 0 ? 0 : (plan.n_frames + 1.) * frame_bytes * n_nodes,
                 needed = frames + checkpoint_bytes * n_nodes;
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
    return {"plane, of one lattice, with λ = μ: Poisson's ratio is 1/4 in plane strain",
            "wells are reversible: where a crack is unloaded it closes and its bonds are whole "
            "again; only the notch is cut for good, which the paper's model does not have",
            "faces of a crack do not feel each other in contact beyond what their bonds do",
            "both ends of the strip are free, bonds end there and are not corrected for it",
            "no wear, heat, rate dependence of the bonds, or anything beyond the damping that the "
            "scene gives",
            "energy of soft bonds is no surface energy: while a crack runs it is more than G_c a "
            "length, for bonds beside it are soft as well"};
  }
} // namespace plumbline::study
