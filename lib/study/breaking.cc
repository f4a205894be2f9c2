#include "study/breaking.h"

#include "analysis/checkpoint.h"
#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace plumbline::study
{
  using dealii::Point;

  std::vector<std::size_t> BreakingHistory::broken(double until) const
  {
    std::vector<std::size_t> bonds;
    for (const TimedBreaks &one : breaks)
      if (one.t <= until)
        bonds.insert(bonds.end(), one.bonds.begin(), one.bonds.end());
    return bonds;
  }

  namespace
  {
    constexpr std::size_t n_numbers = 6, n_heads = 4; // of a sample; of breaks before their bonds

    Vector to_records(const BreakingHistory &history)
    {
      Vector records{static_cast<double>(history.samples.size())};
      for (const BreakingSample &s : history.samples)
        records.insert(records.end(), {s.t, s.kinetic, s.bond, s.work, s.dissipated, s.broken});
      for (const TimedBreaks &one : history.breaks)
      {
        records.insert(records.end(),
                       {one.t, one.energy, one.overshoot, static_cast<double>(one.bonds.size())});
        records.insert(records.end(), one.bonds.begin(), one.bonds.end());
      }
      return records;
    }

    /// @throws InputError  other numbers than to_records() gives
    BreakingHistory from_records(const Vector &r, std::size_t n_bonds, const CrackPlan &plan)
    {
      const auto require = [&](bool is_good)
      {
        if (!is_good)
          throw InputError("checkpoint '" + plan.checkpoints.file().string() +
                           "' does not hold what this run writes; remove it to begin anew");
      };
      BreakingHistory history;
      require(!r.empty() && r[0] >= 1 && r[0] <= plan.n_samples);
      std::size_t at = 1;
      for (const std::size_t end = 1 + n_numbers * static_cast<std::size_t>(r[0]); at < end;
           at += n_numbers)
      {
        require(at + n_numbers <= r.size());
        BreakingSample sample;
        sample.t = r[at];
        sample.kinetic = r[at + 1];
        sample.bond = r[at + 2];
        sample.work = r[at + 3];
        sample.dissipated = r[at + 4];
        sample.broken = r[at + 5];
        history.samples.push_back(sample);
      }
      while (at < r.size())
      {
        require(at + n_heads <= r.size());
        TimedBreaks one;
        one.t = r[at];
        one.energy = r[at + 1];
        one.overshoot = r[at + 2];
        const double n = r[at + 3];
        at += n_heads;
        require(n >= 1 && n <= static_cast<double>(r.size() - at));
        for (const std::size_t end = at + static_cast<std::size_t>(n); at < end; ++at)
        {
          require(r[at] >= 0 && r[at] < static_cast<double>(n_bonds));
          one.bonds.push_back(static_cast<std::size_t>(r[at]));
        }
        history.breaks.push_back(std::move(one));
      }
      return history;
    }

    /// Move from one sample to the next.
    void advance(DrivenBody &driven, const analysis::Transient &transient, const CrackPlan &plan,
                 double end, BreakingHistory &history)
    {
      State &state = history.last;
      analysis::Motion motion = transient.motion();
      analysis::EnergyLog log(transient, state, analysis::n_equal_steps(end - state.t, plan.step),
                              1);
      BreakingSample sample = history.samples.back();
      motion.changes = [&](const State &now)
      {
        log.observe(now);
        TimedBreaks breaks{driven.body.motion->break_bonds(now.u, driven.drive.at(now.t)), now.t};
        if (breaks.bonds.empty())
          return false;
        sample.broken += breaks.energy;
        history.breaks.push_back(std::move(breaks));
        log.change(now);
        return true;
      };
      history.n_steps +=
          analysis::integrate(motion, analysis::scheme(plan.scheme),
                              {plan.step, plan.critical_step, plan.shows_blow_up}, end, state)
              .n_steps;
      const double work = sample.work + log.samples().back().work,
                   dissipated = sample.dissipated + log.samples().back().dissipated;
      static_cast<analysis::Energies &>(sample) = transient.energies(state);
      sample.work = work;
      sample.dissipated = dissipated;
      history.samples.push_back(sample);
    }
  } // namespace

  BreakingHistory run_breaking(DrivenBody &driven, const CrackPlan &plan,
                               const WriteBreaking &write)
  {
    method::BreakingMotion &motion = *driven.body.motion;
    const analysis::Transient transient(motion, driven.drive, driven.density, driven.damping);
    BreakingHistory history;
    history.last = {Vector(motion.size()), driven.velocity, 0};
    const std::string file = plan.checkpoints.file().string();
    const auto saved = analysis::read_checkpoint(file);
    if (saved && saved->subject == plan.subject && saved->state.u.size() == motion.size())
    {
      history = from_records(saved->records, driven.body.parts.bonds.size(), plan);
      history.last = saved->state;
      history.resumed_at = saved->state.t;
      motion.restart(history.broken(saved->state.t));
    }
    const auto look = [&](unsigned int sample)
    {
      if (const auto frame = plan.frame(sample); frame && write)
        write(*frame, plan.time(sample), history.last, history);
    };
    if (history.samples.empty())
    {
      BreakingSample first;
      static_cast<analysis::Energies &>(first) = transient.energies(history.last);
      history.samples.push_back(first);
      look(0);
    }
    for (auto k = static_cast<unsigned int>(history.samples.size()); k <= plan.n_samples; ++k)
    {
      advance(driven, transient, plan, plan.time(k), history);
      look(k);
      const bool is_to_stop = k < plan.n_samples && plan.checkpoints.is_to_stop();
      if ((k % plan.interval == 0 && k < plan.n_samples) || is_to_stop)
        analysis::write_checkpoint(file, {plan.subject, history.last, to_records(history)});
      if (is_to_stop)
        throw Interrupted();
    }
    return history;
  }

  double energy_imbalance(const std::vector<BreakingSample> &samples)
  {
    double largest = 0, size = 0;
    for (const BreakingSample &now : samples)
    {
      largest = std::max(largest, std::abs(now.excess() - samples.front().excess()));
      size = std::max({size, now.kinetic, now.bond, std::abs(now.work), now.dissipated});
    }
    return size > 0 ? largest / size : 0;
  }

  namespace
  {
    Point<2> middle(const CrackSide &side)
    {
      return side.ends[0] + .5 * (side.ends[1] - side.ends[0]);
    }

    /// The number of groups of points, any two of which are farther apart than `gap`.
    std::size_t n_groups(const std::vector<Point<2>> &points, double gap)
    {
      std::vector<std::size_t> group(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        group[i] = i;
        for (std::size_t j = 0; j < i; ++j)
          if (points[i].distance(points[j]) <= gap)
            for (std::size_t k = 0, old = group[j]; k < i; ++k)
              if (group[k] == old)
                group[k] = i;
      }
      std::sort(group.begin(), group.end());
      return static_cast<std::size_t>(std::unique(group.begin(), group.end()) - group.begin());
    }

    /// The longest way from `from` over which sides lie in two groups or more.
    double branched_way(const std::vector<CrackSide> &sides, const Point<2> &from, double h,
                        double horizon)
    {
      std::map<long, std::vector<Point<2>>> rings;
      for (const CrackSide &side : sides)
      {
        const long ring = static_cast<long>(middle(side).distance(from) / h);
        for (const long near : {ring, ring + 1}) // no ring within the crack is empty
          rings[near].push_back(middle(side));
      }
      long longest = 0, run = 0, last = -1;
      for (const auto &[ring, points] : rings)
      {
        run = n_groups(points, horizon) < 2 ? 0 : (ring == last + 1 ? run + 1 : 1);
        last = ring;
        longest = std::max(longest, run);
      }
      return static_cast<double>(longest) * h;
    }

    void follow(NotchCrack &crack, const std::vector<CrackSide> &sides,
                const std::vector<double> &times)
    {
      std::vector<const CrackSide *> in_time;
      for (const CrackSide &side : sides)
        in_time.push_back(&side);
      std::stable_sort(in_time.begin(), in_time.end(),
                       [](const CrackSide *a, const CrackSide *b)
                       { return a->joined < b->joined; });
      for (const CrackSide *const side : in_time)
        if (const double way = middle(*side).distance(crack.from); way > crack.way)
        {
          crack.way = way;
          crack.to = middle(*side);
          if (!crack.t.empty() && crack.t.back() == times[side->joined])
            crack.tip.back() = way;
          else
          {
            crack.t.push_back(times[side->joined]);
            crack.tip.push_back(way);
          }
        }
    }

    double angle_between(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a * b)) * 180 / M_PI;
    }
  } // namespace

  std::vector<NotchCrack> notch_cracks(const GrowthModel &model, const CrackPath &path,
                                       const std::vector<double> &times,
                                       const std::vector<geometry::Polyline> &notches,
                                       double horizon)
  {
    std::vector<std::vector<CrackSide>> sides(notches.size());
    for (const CrackSide &side : path.sides)
      if (side.is_joined)
      {
        const Point<2> at = middle(side);
        std::size_t nearest = 0;
        for (std::size_t n = 1; n < notches.size(); ++n)
          if (at.distance(notches[n].back()) < at.distance(notches[nearest].back()))
            nearest = n;
        sides[nearest].push_back(side);
      }
    std::vector<NotchCrack> cracks(notches.size());
    for (std::size_t n = 0; n < notches.size(); ++n)
    {
      NotchCrack &crack = cracks[n];
      crack.from = crack.to = notches[n].back();
      follow(crack, sides[n], times);
      if (crack.way > 0)
        crack.angle =
            angle_between(crack.from - notches[n][notches[n].size() - 2], crack.to - crack.from);
      crack.branched = branched_way(sides[n], crack.from, model.h, horizon);
    }
    return cracks;
  }

  BreakingOutcome judge_breaking(const NotchCrack &crack, double final_time, double horizon,
                                 double transit, bool is_at_boundary)
  {
    using Outcome = scene::CrackOutcome;
    constexpr double to_branch = 4, to_run = 2; // horizons
    const auto text = [](double value) { return base::to_text(value, 3); };
    const std::string advance = "the crack advances by " + text(crack.way / horizon) + " horizons";
    const double last = crack.t.empty() ? 0 : crack.t.back(), rest = final_time / 3;
    if (crack.branched >= to_branch * horizon)
      return {Outcome::branches, "over " + text(crack.branched / horizon) +
                                     " horizons the crack has two parts or more that are farther "
                                     "apart than a horizon"};
    if (is_at_boundary && crack.way >= to_run * horizon)
      return {Outcome::runs, advance + " and comes to the boundary of the body"};
    if (final_time - last >= rest && rest >= 2 * transit)
      return {Outcome::arrests, advance + ", and not in the last third of the time"};
    return {Outcome::too_short,
            advance +
                (final_time - last >= rest
                     ? ", and the time is shorter than six transits of shear waves through "
                       "the body"
                     : ", some of it in the last third of the time") +
                "; lengthen Time/final time"};
  }

  double fitted_speed(const NotchCrack &crack)
  {
    double n = 0, t = 0, x = 0, tt = 0, tx = 0;
    for (std::size_t i = 0; i < crack.t.size(); ++i)
      if (const double part = crack.tip[i] / crack.way; part >= .2 && part <= .8)
      {
        const double since = crack.t[i] - crack.t.front();
        ++n;
        t += since;
        x += crack.tip[i];
        tt += since * since;
        tx += since * crack.tip[i];
      }
    return n >= 3 ? (n * tx - t * x) / (n * tt - t * t) : 0;
  }

  double fastest_speed(const NotchCrack &crack, double horizon)
  {
    const double way = 4 * horizon;
    double fastest = 0;
    for (std::size_t i = 0; i < crack.t.size(); ++i)
      for (std::size_t j = i + 1; j < crack.t.size() && crack.tip[j] - crack.tip[j - 1] <= horizon;
           ++j)
        if (crack.tip[j] - crack.tip[i] >= way)
        {
          fastest = std::max(fastest, (crack.tip[j] - crack.tip[i]) / (crack.t[j] - crack.t[i]));
          break;
        }
    return fastest;
  }

  std::vector<std::string> left_out_of_breaking()
  {
    return {"contact: broken bonds carry no force, so crack faces may overlap",
            "large rotations: stretches are linearised",
            "surface terms and corrected dilatations at free surfaces and crack faces",
            "sliding grips: nodes in Domain/fixed have both displacements prescribed"};
  }
} // namespace plumbline::study
