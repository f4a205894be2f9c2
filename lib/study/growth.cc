#include "study/growth.h"

#include "analysis/checkpoint.h"
#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace plumbline::study
{
  using analysis::Event;
  using analysis::Growth;

  namespace
  {
    constexpr std::size_t n_numbers = 11;     // of an event, before its bonds
    constexpr double worst_imbalance = 1e-10; // what an audit is to hold to

    std::vector<double> to_records(const std::vector<Event> &events)
    {
      std::vector<double> records;
      for (const Event &e : events)
      {
        records.insert(records.end(),
                       {e.critical, e.load, e.reaction_before, e.reaction, e.work, e.stored,
                        e.in_bonds, e.released, e.residual, e.is_factored ? 1. : 0.,
                        static_cast<double>(e.bonds.size())});
        records.insert(records.end(), e.bonds.begin(), e.bonds.end());
      }
      return records;
    }

    /// @throws InputError  records that this run does not write
    std::vector<Event> from_records(const std::vector<double> &records, const GrowthPlan &plan,
                                    std::size_t n_bonds)
    {
      std::vector<Event> events;
      std::vector<char> is_broken(n_bonds, 0);
      const auto require = [&](bool is_good)
      {
        if (!is_good)
          throw InputError("checkpoint '" + plan.checkpoint.string() +
                           "' does not hold what this run writes; remove it to begin anew");
      };
      for (std::size_t at = 0; at < records.size();)
      {
        require(at + n_numbers <= records.size());
        const double *const r = records.data() + at;
        const double n = r[n_numbers - 1];
        require(n >= 1 && n <= static_cast<double>(records.size() - at - n_numbers));
        Event event{r[0], r[1], {}, r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9] != 0};
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
        {
          const double bond = r[n_numbers + i];
          require(bond >= 0 && bond < static_cast<double>(n_bonds) &&
                  is_broken[static_cast<std::size_t>(bond)] == 0);
          event.bonds.push_back(static_cast<std::size_t>(bond));
          is_broken[event.bonds.back()] = 1;
        }
        at += n_numbers + event.bonds.size();
        events.push_back(std::move(event));
      }
      return events;
    }
  } // namespace

  Growth run_growth(const GrowthModel &model, const GrowthPlan &plan)
  {
    std::vector<Event> earlier;
    const auto saved = analysis::read_checkpoint(plan.checkpoint.string());
    if (saved && saved->subject == plan.subject)
      earlier = from_records(saved->records, plan, model.body->n_bonds());
    const auto save = [&](const Growth &growth)
    {
      if (growth.events.size() % plan.rules.interval == 0)
        analysis::write_checkpoint(
            plan.checkpoint.string(),
            {plan.subject, {{}, {}, growth.events.back().load}, to_records(growth.events)});
      return true;
    };
    return analysis::grow(*model.body, plan.rules, std::move(earlier), save);
  }

  std::vector<GrowthMoment> growth_moments(const GrowthModel &model,
                                           const std::vector<Event> &events)
  {
    std::size_t n_broken = 0;
    for (const Event &event : events)
      n_broken += event.bonds.size();
    std::vector<GrowthMoment> moments = {{0, 0, model.damage({})}};
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
      broken.insert(broken.end(), events[i].bonds.begin(), events[i].bonds.end());
      if (broken.size() * (n_growth_moments - 1) >= moments.size() * n_broken)
        moments.push_back({i + 1, events[i].load, model.damage(broken)});
    }
    return moments;
  }

  std::size_t GrowthResults::n_broken() const
  {
    std::size_t n = 0;
    for (const Event &event : growth.events)
      n += event.bonds.size();
    return n;
  }

  double GrowthResults::advance() const
  {
    return path.tips.empty() ? 0 : path.tips.back().distance(notch_tip);
  }

  std::size_t GrowthResults::peak() const
  {
    const auto &events = growth.events;
    return static_cast<std::size_t>(std::max_element(events.begin(), events.end(),
                                                     [](const Event &a, const Event &b) {
                                                       return a.reaction_before < b.reaction_before;
                                                     }) -
                                    events.begin());
  }

  double GrowthResults::largest_imbalance() const
  {
    double largest = 0;
    for (const Event &event : growth.events)
      largest = std::max(largest, event.imbalance());
    return largest;
  }

  double GrowthResults::largest_residual() const
  {
    double largest = 0;
    for (const Event &event : growth.events)
      largest = std::max(largest, event.residual);
    return largest;
  }

  double GrowthResults::toughness_by_bonds() const
  {
    double sum = 0;
    for (const BrokenPart &part : parts)
      sum += part.toughness * part.length;
    return path.width > 0 ? sum / path.width : std::numeric_limits<double>::quiet_NaN();
  }

  double GrowthResults::toughness_by_energy() const
  {
    return path.width > 0
               ? (growth.events.back().in_bonds + growth.events.back().released) / path.width
               : std::numeric_limits<double>::quiet_NaN();
  }

  std::vector<double> GrowthResults::phases() const
  {
    constexpr std::size_t most = 2;
    std::set<double> found;
    for (const double one : toughness)
      if (found.insert(one); found.size() > most)
        return {};
    return {found.begin(), found.end()};
  }

  double GrowthResults::length(double of_toughness) const
  {
    const auto part =
        std::find_if(parts.begin(), parts.end(),
                     [=](const BrokenPart &one) { return one.toughness == of_toughness; });
    return part == parts.end() ? 0 : part->length;
  }

  double GrowthResults::quantity(const std::string &name) const
  {
    using Results = GrowthResults;
    static const auto unknown = std::numeric_limits<double>::quiet_NaN();
    static const std::map<std::string, double (*)(const Results &)> of = {
        {"broken bonds", [](const Results &r) { return static_cast<double>(r.n_broken()); }},
        {"events", [](const Results &r) { return static_cast<double>(r.growth.events.size()); }},
        {"peak load", [](const Results &r)
         { return r.growth.events.empty() ? 0 : r.growth.events[r.peak()].load; }},
        {"peak reaction", [](const Results &r)
         { return r.growth.events.empty() ? 0 : r.growth.events[r.peak()].reaction_before; }},
        {"advance", [](const Results &r) { return r.advance(); }},
        {"G by bonds", [](const Results &r) { return r.toughness_by_bonds(); }},
        {"K by bonds",
         [](const Results &r) { return std::sqrt(r.toughness_by_bonds() * r.plane_modulus); }},
        {"G by energy", [](const Results &r) { return r.toughness_by_energy(); }},
        {"K by energy",
         [](const Results &r) { return std::sqrt(r.toughness_by_energy() * r.plane_modulus); }},
        {"L1",
         [](const Results &r)
         {
           const std::vector<double> G = r.phases();
           return G.empty() ? unknown : r.length(G.front());
         }},
        {"L2",
         [](const Results &r)
         {
           const std::vector<double> G = r.phases();
           return G.empty() ? unknown : G.size() == 1 ? 0 : r.length(G.back());
         }},
        {"Li", [](const Results &r)
         {
           const std::vector<double> G = r.phases();
           return G.empty()       ? unknown
                  : G.size() == 1 ? 0
                                  : r.length(.5 * (G.front() + G.back())); // as of broken_parts
         }}};
    return of.at(name)(*this);
  }

  double bonds_across(const GrowthModel &model)
  {
    // of whole bonds by how far they reach up, for each node that has all of them: of the node
    // whose bonds are most
    std::vector<double> reach(model.nodes.size(), 0);
    for (const auto *const bonds : {&model.bonds, &model.cut})
      for (const auto &bond : *bonds)
      {
        const double rise = (model.nodes[bond[1]][1] - model.nodes[bond[0]][1]) / model.h;
        reach[rise > 0 ? bond[0] : bond[1]] += std::abs(rise);
      }
    return reach.empty() ? 0 : std::round(*std::max_element(reach.begin(), reach.end()));
  }

  std::vector<BrokenPart> broken_parts(const GrowthModel &model,
                                       const std::vector<std::size_t> &broken)
  {
    const double of_bond = model.h / bonds_across(model);
    std::map<double, std::size_t> counts;
    for (const std::size_t bond : broken)
      ++counts[model.toughness_of_bonds[bond]];
    std::vector<BrokenPart> parts;
    for (const auto &[toughness, n] : counts)
      parts.push_back({toughness, n, static_cast<double>(n) * of_bond});
    return parts;
  }

  std::vector<std::string> growth_faults(const GrowthResults &results,
                                         const scene::ExpectedSection &expected)
  {
    std::vector<std::string> faults;
    for (const auto &[name, value] : expected.growth)
      if (const double found = results.quantity(name);
          !(std::abs(found - value) <= expected.error_tolerance * std::abs(value)))
        faults.push_back("Expected/growth = '" + name + ": " + base::to_text(value, 6) +
                         "', but it is " + base::to_text(found, 6));
    if (expected.growth_end != problem::GrowthEnd::unknown &&
        expected.growth_end != results.growth.end)
      faults.push_back("Expected/growth ends = " + base::word(expected.growth_end) +
                       ", but it ends " + base::word(results.growth.end));
    if (const double found = results.largest_imbalance();
        !results.rules.is_corrected() && !(found <= worst_imbalance))
      faults.push_back("work differs from stored, bond and released energy by " +
                       base::to_text(found, 3) + " of it, more than " +
                       base::to_text(worst_imbalance, 3));
    return faults;
  }

  std::vector<std::string> left_out_of_growth(const problem::FractureSettings &rules)
  {
    std::vector<std::string> result = {
        "equilibrium throughout: no inertia, no rate, no heat; what is released where growth is "
        "unstable is gone",
        "the load never falls, so that a snap back is passed at the load that began it",
        "bonds break in tension by their stretch alone, and for good; faces of a crack do not "
        "press on each other, but bonds that are left do",
        "plane, of one lattice, whose rows and columns a crack follows the more gladly the "
        "fewer neighbours there are (Study/m)",
        "nothing of contact, friction or large rotations; Fracture/stretch = finite takes the "
        "finite stretch of small displacements"};
    result.push_back(rules.is_corrected()
                         ? "the balance of energy: no energy has the forces of surface terms"
                         : "free surfaces and faces of cracks end families: no correction of the "
                           "dilatation, no terms that make them free of traction (Fracture/surface "
                           "terms)");
    return result;
  }
} // namespace plumbline::study
