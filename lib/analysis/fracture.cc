#include "analysis/fracture.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::analysis
{
  namespace
  {
    using method::QuasistaticFractureModel;
    using problem::BreakMode;
    using problem::FractureSettings;
    using problem::GrowthEnd;

    constexpr double worst_imbalance = 1e-8; ///< beyond rounding of sums of 1e6 bonds

    double square(double x)
    {
      return x * x;
    }

    /// The load at which bonds break that can at `critical` or before.
    double breaking_load(const FractureSettings &rules, double critical, double load)
    {
      if (rules.breaking != BreakMode::steps || critical <= load * (1 + rules.tie_tolerance))
        return std::max(load, critical);
      return rules.load_step * std::ceil(critical / rules.load_step * (1 - rules.tie_tolerance));
    }

    std::vector<std::size_t> bonds_up_to(double limit, const std::vector<double> &critical_loads)
    {
      std::vector<std::size_t> bonds;
      for (std::size_t b = 0; b < critical_loads.size(); ++b)
        if (critical_loads[b] <= limit)
          bonds.push_back(b);
      return bonds;
    }

    /// Break them, and keep the books.
    void carry_out(QuasistaticFractureModel &body, const Event *before, Event &event)
    {
      const QuasistaticFractureModel::Response first = body.response();
      const double from = before ? before->load : 0;
      event.reaction_before = first.reaction * event.load;
      event.work =
          (before ? before->work : 0) + .5 * first.reaction * (square(event.load) - square(from));
      const QuasistaticFractureModel::Release release = body.break_bonds(event.bonds);
      event.work += release.work * square(event.load);
      double at_limits = 0;
      for (std::size_t i = 0; i < event.bonds.size(); ++i)
        at_limits += release.single[i] * square(first.critical_loads[event.bonds[i]]);
      const QuasistaticFractureModel::Response &after = body.response();
      event.in_bonds = (before ? before->in_bonds : 0) + at_limits;
      event.released = (before ? before->released : 0) +
                       (release.bonds + release.relaxing) * square(event.load) - at_limits;
      event.stored = after.energy * square(event.load);
      event.reaction = after.reaction * event.load;
      event.residual = after.residual;
      event.is_factored = release.is_factored;
      if (body.has_energy() && !(event.imbalance() <= worst_imbalance))
        throw NumericalError("the audit of energy is wrong by " +
                             std::to_string(event.imbalance()) +
                             " of the work; the equations are not solved well enough");
    }

    /// The body as it was after these events: from the last one that factored, as they went on.
    void go_back_to(QuasistaticFractureModel &body, const std::vector<Event> &events)
    {
      std::size_t first = events.size();
      while (first > 0 && !events[first - 1].is_factored)
        --first;
      std::vector<std::size_t> broken;
      for (std::size_t i = 0; i < first; ++i)
        broken.insert(broken.end(), events[i].bonds.begin(), events[i].bonds.end());
      if (first > 0)
        body.restart(broken);
      for (std::size_t i = first; i < events.size(); ++i)
        body.break_bonds(events[i].bonds);
    }

    double largest_reaction(const std::vector<Event> &events)
    {
      double largest = 0;
      for (const Event &event : events)
        largest = std::max({largest, event.reaction_before, event.reaction});
      return largest;
    }

    /// Whether it has come to its end by what was broken.
    GrowthEnd end_of(const QuasistaticFractureModel &body, const FractureSettings &rules,
                     const std::vector<Event> &events)
    {
      if (body.is_separated())
        return GrowthEnd::parted;
      constexpr double nothing = 1e-9; // of the largest reaction: rounding, on a mechanism
      if (!events.empty() && events.back().reaction <=
                                 std::max(nothing, rules.least_reaction) * largest_reaction(events))
        return GrowthEnd::unloaded;
      return GrowthEnd::unknown;
    }
  } // namespace

  double Event::imbalance() const
  {
    return std::abs(work - stored - in_bonds - released) / work;
  }

  double Growth::reaction_left() const
  {
    if (events.empty())
      return 1;
    const Event &last = events.back();
    const double reaction = last.reaction * last_load / last.load; // linear since then
    return reaction / std::max(reaction, largest_reaction(events));
  }

  Growth grow(QuasistaticFractureModel &body, const FractureSettings &rules,
              std::vector<Event> earlier, const EventObserver &observe)
  {
    Growth growth;
    growth.first_stiffness = body.response().reaction;
    growth.events = std::move(earlier);
    growth.n_resumed = growth.events.size();
    go_back_to(body, growth.events);
    growth.end = end_of(body, rules, growth.events);
    while (growth.end == GrowthEnd::unknown)
    {
      const Event *const before = growth.events.empty() ? nullptr : &growth.events.back();
      const std::vector<double> &loads = body.response().critical_loads;
      Event event;
      event.critical = *std::min_element(loads.begin(), loads.end());
      if (!std::isfinite(event.critical))
      {
        growth.end = GrowthEnd::whole;
        break;
      }
      event.load = breaking_load(rules, event.critical, before ? before->load : 0);
      if (event.load > rules.largest_load)
      {
        growth.end = GrowthEnd::loaded;
        break;
      }
      event.bonds =
          bonds_up_to((rules.breaking == BreakMode::events ? event.critical : event.load) *
                          (1 + rules.tie_tolerance),
                      loads);
      carry_out(body, before, event);
      growth.events.push_back(std::move(event));
      growth.end = end_of(body, rules, growth.events);
      if (observe && !observe(growth))
        break;
    }
    growth.last_load = growth.events.empty() ? 0 : growth.events.back().load;
    if (growth.end == GrowthEnd::loaded)
      growth.last_load = rules.largest_load;
    growth.is_separated = body.is_separated();
    growth.load_left = body.load_left();
    return growth;
  }
} // namespace plumbline::analysis
