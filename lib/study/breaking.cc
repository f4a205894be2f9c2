#include "study/breaking.h"

#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

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
    constexpr std::size_t n_numbers = 7, n_heads = 4; // of a sample; of breaks before their bonds

    Vector to_records(const BreakingHistory &history)
    {
      Vector records{static_cast<double>(history.samples.size())};
      for (const BreakingSample &s : history.samples)
        records.insert(records.end(),
                       {s.t, s.kinetic, s.bond, s.work, s.dissipated, s.broken, s.drift});
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
        sample.drift = r[at + 6];
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

    /// The kinetic energy of the mean velocity.
    double drift_of(const DrivenBody &driven, const Vector &v)
    {
      Vector mean(v.size());
      for (std::size_t c = 0; c < 2; ++c)
      {
        double sum = 0;
        for (std::size_t i = c; i < v.size(); i += 2)
          sum += v[i];
        for (std::size_t i = c; i < v.size(); i += 2)
          mean[i] = 2 * sum / static_cast<double>(v.size());
      }
      return .5 * driven.density * driven.body.motion->product(mean, mean);
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
      std::vector<TimedBreaks> found;
      motion.changes = [&](const State &now)
      {
        if (plan.checkpoints.is_to_stop())
          throw Interrupted();
        log.observe(now);
        TimedBreaks breaks{driven.body.motion->break_bonds(now.u, driven.drive.at(now.t)), now.t};
        if (breaks.bonds.empty())
          return false;
        sample.broken += breaks.energy;
        found.push_back(std::move(breaks));
        log.change(now);
        return true;
      };
      analysis::integrate(motion, analysis::scheme(plan.scheme),
                          {plan.step, plan.critical_step, plan.shows_blow_up}, end, state);
      const double work = sample.work + log.samples().back().work,
                   dissipated = sample.dissipated + log.samples().back().dissipated;
      static_cast<analysis::Energies &>(sample) = transient.energies(state);
      sample.work = work;
      sample.dissipated = dissipated;
      sample.drift = drift_of(driven, state.v);
      history.samples.push_back(sample);
      std::move(found.begin(), found.end(), std::back_inserter(history.breaks));
    }
  } // namespace

  BreakingHistory run_breaking(DrivenBody &driven, const CrackPlan &plan,
                               const WriteBreaking &write)
  {
    method::BreakingMotion &body = *driven.body.motion;
    const analysis::Transient transient(body, driven.drive, driven.density, driven.damping);
    BreakingHistory history;
    history.last = {Vector(body.size()), driven.velocity, 0};
    SampledMotion motion;
    motion.resume = [&](const Vector &records)
    {
      const State saved = history.last;
      history = from_records(records, driven.body.parts.bonds.size(), plan);
      history.last = saved;
      history.resumed_at = saved.t;
      body.restart(history.broken(saved.t));
    };
    motion.n_taken = [&] { return static_cast<unsigned int>(history.samples.size()); };
    motion.begin = [&]
    {
      BreakingSample first;
      static_cast<analysis::Energies &>(first) = transient.energies(history.last);
      first.drift = drift_of(driven, history.last.v);
      history.samples.push_back(first);
    };
    motion.advance = [&](double end) { advance(driven, transient, plan, end, history); };
    motion.on_sample = [&](unsigned int sample)
    {
      if (const auto frame = plan.frame(sample); frame && write)
        write(*frame, plan.time(sample), history.last, history);
    };
    motion.records = [&] { return to_records(history); };
    run_samples(plan, history.last, motion);
    return history;
  }

  double energy_imbalance(const std::vector<BreakingSample> &samples)
  {
    constexpr double rounding = 1e-10; // of rigid-body motion: its own error is far below
    double largest = 0, size = 0;
    for (const BreakingSample &now : samples)
    {
      const double change = std::abs(now.excess() - samples.front().excess());
      if (!std::isfinite(change))
        return std::numeric_limits<double>::infinity();
      largest = std::max(largest, change);
      size = std::max({size, now.kinetic - now.drift, now.bond, std::abs(now.broken),
                       now.dissipated, rounding * now.kinetic});
    }
    return size > 0 ? largest / size : 0;
  }

  double energy_gained(const BreakingHistory &history)
  {
    double sum = 0;
    for (const TimedBreaks &one : history.breaks)
      sum += std::max(0., -one.energy);
    return sum;
  }

  double recorded_step(double final_time, unsigned int n_samples, double longest, bool is_exact)
  {
    const double interval = final_time / n_samples;
    const std::uint64_t n = analysis::n_equal_steps(interval, longest);
    const double step = interval / static_cast<double>(n);
    constexpr double tolerance = 1e-6;
    if (is_exact && std::abs(step - longest) > tolerance * longest)
    {
      const std::string shorter = base::to_text(step, 8),
                        longer =
                            n > 1 ? " or " + base::to_text(interval / static_cast<double>(n - 1), 8)
                                  : "";
      throw InputError("Time/steps = " + base::to_text(longest, 8) +
                       " does not divide Time/final time / " + std::to_string(n_samples) + " = " +
                       base::to_text(interval, 8) +
                       ", the time between two records of the run, into whole steps; "
                       "write " +
                       shorter + longer);
    }
    return step;
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

    /// The longest distance from `from` over which sides lie in two groups or more.
    double branched_length(const std::vector<CrackSide> &sides, const Point<2> &from, double h,
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
        if (const double advance = middle(*side).distance(crack.from); advance > crack.advance)
        {
          crack.advance = advance;
          crack.to = middle(*side);
          if (!crack.t.empty() && crack.t.back() == times[side->joined])
            crack.tip.back() = advance;
          else
          {
            crack.t.push_back(times[side->joined]);
            crack.tip.push_back(advance);
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
    std::vector<NotchCrack> cracks(notches.size());
    const auto direction = [&](std::size_t n)
    { return notches[n].back() - notches[n][notches[n].size() - 2]; };
    for (const CrackSide &side : path.sides)
      if (side.is_joined)
      {
        const Point<2> at = middle(side);
        std::size_t nearest = 0;
        for (std::size_t n = 1; n < notches.size(); ++n)
          if (at.distance(notches[n].back()) < at.distance(notches[nearest].back()))
            nearest = n;
        cracks[nearest].last_joined = std::max(cracks[nearest].last_joined, times[side.joined]);
        const auto d = direction(nearest);
        if ((at - notches[nearest].back()) * d >= -model.h * d.norm())
          sides[nearest].push_back(side);
      }
    for (std::size_t n = 0; n < notches.size(); ++n)
    {
      NotchCrack &crack = cracks[n];
      crack.from = crack.to = notches[n].back();
      follow(crack, sides[n], times);
      if (crack.advance > 0)
        crack.angle = angle_between(direction(n), crack.to - crack.from);
      crack.branched = branched_length(sides[n], crack.from, model.h, horizon);
    }
    return cracks;
  }

  namespace
  {
    /// Of a body's cells.
    class Cells
    {
    public:
      explicit Cells(const GrowthModel &model) : model_(model)
      {
        for (const Point<2> &node : model.nodes)
          cells_.insert(cell(node));
      }

      bool have(const Point<2> &x) const { return cells_.count(cell(x)) > 0; }

    private:
      std::array<long, 2> cell(const Point<2> &x) const
      {
        const auto along = [&](unsigned int d)
        { return std::lround((x[d] - model_.nodes.front()[d]) / model_.h); };
        return {along(0), along(1)};
      }

      const GrowthModel &model_;
      std::set<std::array<long, 2>> cells_;
    };
  } // namespace

  bool is_at_boundary(const GrowthModel &model, const Point<2> &x, double distance)
  {
    constexpr int n = 16;
    constexpr double rounding = 1e-9;
    const Cells cells(model);
    for (int k = 0; k < n; ++k)
      if (!cells.have(x + (1 + rounding) * distance *
                              Point<2>(std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n))))
        return true;
    return false;
  }

  void check_mouths(const GrowthModel &model, const std::vector<geometry::Polyline> &notches,
                    const Point<2> &origin)
  {
    const auto text = [&](const Point<2> &x)
    {
      return "(" + base::to_text(x[0] + origin[0], 4) + ", " + base::to_text(x[1] + origin[1], 4) +
             ")";
    };
    for (const geometry::Polyline &notch : notches)
      if (!is_at_boundary(model, notch.front(), model.h))
        throw InputError("Domain/cracks: the notch from " + text(notch.front()) + " to " +
                         text(notch.back()) +
                         " begins within the body, and its crack is followed from its last point "
                         "alone; give it from its mouth to its tip, the mouth at the boundary of "
                         "the body or outside of it");
  }

  BreakingOutcome judge_breaking(const NotchCrack &crack, double last_joined, double final_time,
                                 double horizon, double transit, bool is_at_boundary)
  {
    using Outcome = scene::CrackOutcome;
    constexpr double to_branch = 4, to_run = 2; // horizons
    const auto text = [](double value) { return base::to_text(value, 3); };
    const std::string advance =
        "the crack advances by " + text(crack.advance / horizon) + " horizons";
    const double rest = final_time / 3;
    const bool is_quiet = final_time - last_joined >= rest;
    if (crack.branched >= to_branch * horizon)
      return {Outcome::branches, "over " + text(crack.branched / horizon) +
                                     " horizons the crack has two parts or more that are farther "
                                     "apart than a horizon"};
    if (is_at_boundary && crack.advance >= to_run * horizon)
      return {Outcome::runs, advance + " and reaches the boundary of the body"};
    if (is_quiet && rest >= 2 * transit)
      return {Outcome::arrests, advance + ", and no crack grows in the last third of the time"};
    return {Outcome::too_short,
            advance +
                (is_quiet ? ", and the time is shorter than six transits of shear waves through "
                            "the body"
                          : ", and cracks still grow in the last third of the time") +
                "; lengthen Time/final time"};
  }

  std::optional<double> fitted_speed(const NotchCrack &crack, double horizon)
  {
    double n_all = 0, tt_all = 0, tx_all = 0;
    for (std::size_t i = 0; i < crack.t.size();)
    {
      double n = 0, t = 0, x = 0, tt = 0, tx = 0; // of a part between two jumps
      do
      {
        if (const double part = crack.tip[i] / crack.advance; part >= .2 && part <= .8)
        {
          const double since = crack.t[i] - crack.t.front();
          ++n;
          t += since;
          x += crack.tip[i];
          tt += since * since;
          tx += since * crack.tip[i];
        }
        ++i;
      } while (i < crack.t.size() && crack.tip[i] - crack.tip[i - 1] <= horizon);
      if (n < 2)
        continue;
      n_all += n;
      tt_all += tt - t * t / n;
      tx_all += tx - t * x / n;
    }
    return n_all >= 3 ? std::optional(tx_all / tt_all) : std::nullopt;
  }

  std::optional<double> fastest_speed(const NotchCrack &crack, double horizon)
  {
    const double least = 4 * horizon;
    std::optional<double> fastest;
    for (std::size_t i = 0; i < crack.t.size(); ++i)
      for (std::size_t j = i + 1; j < crack.t.size() && crack.tip[j] - crack.tip[j - 1] <= horizon;
           ++j)
        if (crack.tip[j] - crack.tip[i] >= least)
        {
          fastest = std::max(fastest.value_or(0),
                             (crack.tip[j] - crack.tip[i]) / (crack.t[j] - crack.t[i]));
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
