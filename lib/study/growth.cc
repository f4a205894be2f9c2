#include "study/growth.h"

#include "analysis/checkpoint.h"
#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
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
          throw InputError("checkpoint '" + plan.checkpoints.file().string() +
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

  Growth run_growth(method::QuasistaticFractureModel &body, const GrowthPlan &plan)
  {
    std::vector<Event> earlier;
    const std::string file = plan.checkpoints.file().string();
    const auto saved = analysis::read_checkpoint(file);
    if (saved && saved->subject == plan.subject)
      earlier = from_records(saved->records, plan, body.n_bonds());
    const auto save = [&](const Growth &growth)
    {
      const bool is_to_stop =
          growth.end == problem::GrowthEnd::unknown && plan.checkpoints.is_to_stop();
      if (growth.events.size() % plan.rules.interval == 0 || is_to_stop)
        analysis::write_checkpoint(
            file, {plan.subject, {{}, {}, growth.events.back().load}, to_records(growth.events)});
      if (is_to_stop)
        throw Interrupted();
      return true;
    };
    return analysis::grow(body, plan.rules, std::move(earlier), save);
  }

  template <int dim>
  std::vector<GrowthMoment> growth_moments(const method::BreakableBody<dim> &model,
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

  template <int dim>
  LatticePlace<dim> lattice_place(const method::BreakableBody<dim> &model,
                                  const dealii::Point<dim> &x)
  {
    LatticePlace<dim> place{};
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = std::lround(2 * (x[d] - model.nodes.front()[d]) / model.h);
    return place;
  }

  template <int dim>
  std::size_t n_unpaired(const method::BreakableBody<dim> &model,
                         const std::vector<std::size_t> &broken, unsigned int axis, double middle)
  {
    using BondEnds = std::array<LatticePlace<dim>, 2>;
    const auto key = [&](std::size_t bond, bool is_mirrored)
    {
      BondEnds ends{};
      for (unsigned int i = 0; i < 2; ++i)
      {
        dealii::Point<dim> x = model.nodes[model.bonds[bond][i]];
        if (is_mirrored)
          x[axis] = 2 * middle - x[axis];
        ends[i] = lattice_place(model, x);
      }
      std::sort(ends.begin(), ends.end());
      return ends;
    };
    std::set<BondEnds> all;
    for (const std::size_t bond : broken)
      all.insert(key(bond, false));
    return static_cast<std::size_t>(std::count_if(broken.begin(), broken.end(),
                                                  [&](std::size_t bond)
                                                  { return all.count(key(bond, true)) == 0; }));
  }

  namespace
  {
    /// Of scattered nodes: half the rises of a node's bonds over the area of its cell, the median
    /// over all nodes.
    double bonds_across_cells(const GrowthModel &model)
    {
      std::vector<double> rises(model.nodes.size(), 0);
      for (const auto *const bonds : {&model.bonds, &model.cut})
        for (const auto &bond : *bonds)
          for (const unsigned int node : bond)
            rises[node] += .5 * model.h *
                           std::abs(model.nodes[bond[1]][1] - model.nodes[bond[0]][1]) /
                           model.cells->area[node];
      const auto middle = rises.begin() + static_cast<std::ptrdiff_t>(rises.size() / 2);
      std::nth_element(rises.begin(), middle, rises.end());
      return *middle;
    }
  } // namespace

  template <int dim>
  double bonds_across(const method::BreakableBody<dim> &model)
  {
    if constexpr (dim == 2)
      if (model.cells)
        return bonds_across_cells(model);
    // for each node the sum of the rises, in h, of its bonds that point to larger y; the result is
    // the maximum, in space of the means over the columns of nodes along z
    std::vector<double> reach(model.nodes.size(), 0);
    for (const auto *const bonds : {&model.bonds, &model.cut})
      for (const auto &bond : *bonds)
      {
        const double rise = (model.nodes[bond[1]][1] - model.nodes[bond[0]][1]) / model.h;
        reach[rise > 0 ? bond[0] : bond[1]] += std::abs(rise);
      }
    std::map<LatticePlace<2>, std::array<double, 2>> columns; // sum and number of nodes
    for (std::size_t i = 0; i < reach.size(); ++i)
    {
      const LatticePlace<dim> place = lattice_place(model, model.nodes[i]);
      auto &[sum, n] = columns[{place[0], place[1]}];
      sum += reach[i];
      ++n;
    }
    double most = 0;
    for (const auto &[place, column] : columns)
      most = std::max(most, column[0] / column[1]);
    return dim == 2 ? std::round(most) : most;
  }

  template <int dim>
  std::vector<BrokenPart> broken_parts(const method::BreakableBody<dim> &model,
                                       const std::vector<std::size_t> &broken)
  {
    const double of_bond = (dim == 2 ? model.h : model.h * model.h) / bonds_across(model);
    std::map<double, std::size_t> counts;
    for (const std::size_t bond : broken)
      ++counts[model.toughness_of_bonds[bond]];
    std::vector<BrokenPart> parts;
    for (const auto &[toughness, n] : counts)
      parts.push_back({toughness, n, static_cast<double>(n) * of_bond});
    return parts;
  }

#define INSTANTIATE(dim)                                                                           \
  template std::vector<GrowthMoment> growth_moments(const method::BreakableBody<dim> &,            \
                                                    const std::vector<Event> &);                   \
  template LatticePlace<dim> lattice_place<dim>(const method::BreakableBody<dim> &,                \
                                                const dealii::Point<dim> &);                       \
  template std::size_t n_unpaired(const method::BreakableBody<dim> &,                              \
                                  const std::vector<std::size_t> &, unsigned int, double);         \
  template double bonds_across(const method::BreakableBody<dim> &);                                \
  template std::vector<BrokenPart> broken_parts(const method::BreakableBody<dim> &,                \
                                                const std::vector<std::size_t> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE

  namespace
  {
    /// G of the body's phases, the weaker one first: two, or one where G is the same everywhere;
    /// none where it has more values than that.
    std::vector<double> find_phases(const std::vector<double> &toughness)
    {
      constexpr std::size_t most = 2;
      std::set<double> found;
      for (const double one : toughness)
        if (found.insert(one); found.size() > most)
          return {};
      return {found.begin(), found.end()};
    }

    /// @param separated  width or area of the crack; 0: there is none
    template <int dim>
    void set_toughness(const CommonFindings<dim> &found, double separated, Record &record)
    {
      if (separated == 0)
        return;
      double in_parts = 0;
      for (const BrokenPart &part : found.parts)
        in_parts += part.toughness * part.length;
      const Event &last = found.growth.events.back();
      record.set("G by bonds", in_parts / separated, "force/length");
      record.set("G by energy", (last.in_bonds + last.released) / separated, "force/length");
    }

    /// K = sqrt(G E/(1 - nu^2)), of plane strain.
    void set_intensity(double plane_modulus, Record &record)
    {
      record.set("plane modulus", plane_modulus, "force/length^2");
      for (const std::string by : {"bonds", "energy"})
        if (record.has("G by " + by))
          record.set("K by " + by, std::sqrt(record["G by " + by] * plane_modulus));
    }

    void set_lengths(const GrowthFindings &found, Record &record)
    {
      const std::vector<double> G = find_phases(found.toughness);
      record.curves["phases"] = {{"G", "force/length", G}};
      if (G.empty())
        return;
      const auto length = [&](double of_toughness)
      {
        const auto part =
            std::find_if(found.parts.begin(), found.parts.end(),
                         [=](const BrokenPart &one) { return one.toughness == of_toughness; });
        return part == found.parts.end() ? 0 : part->length;
      };
      record.set("L1", length(G.front()), "length");
      record.set("L2", G.size() == 1 ? 0 : length(G.back()), "length");
      record.set("Li",
                 G.size() == 1 ? 0 : length(.5 * (G.front() + G.back())), // as of broken_parts
                 "length");
    }

    /// @param force  unit of what is conjugate to the load factor: in the plane for each unit of
    /// thickness
    void set_events(const std::vector<Event> &events, const std::string &force, Record &record)
    {
      // the first of those with the largest reaction before them
      const auto peak = std::max_element(events.begin(), events.end(),
                                         [](const Event &a, const Event &b)
                                         { return a.reaction_before < b.reaction_before; });
      std::size_t n_broken = 0;
      double imbalance = 0, residual = 0;
      for (const Event &event : events)
      {
        n_broken += event.bonds.size();
        imbalance = std::max(imbalance, event.imbalance());
        residual = std::max(residual, event.residual);
      }
      record.set("broken bonds", static_cast<double>(n_broken));
      record.set("events", static_cast<double>(events.size()));
      record.set("peak load", events.empty() ? 0 : peak->load);
      record.set("peak reaction", events.empty() ? 0 : peak->reaction_before, force);
      record.set("imbalance", imbalance);
      record.set("residual", residual);
    }

    /// Loads of the first broken bond and of the first event after which the crack has advanced.
    /// @param way  of the tip, or the mean over a front, after each event
    void set_beginnings(const std::vector<Event> &events, const std::vector<double> &way,
                        Record &record)
    {
      if (events.empty())
        return;
      record.set("first break", events.front().load);
      const auto moved =
          std::find_if(way.begin(), way.end(), [](double advance) { return advance > 0; });
      if (moved == way.end())
        return;
      const std::ptrdiff_t event = moved - way.begin();
      record.set("first advance", events[static_cast<std::size_t>(event)].load);
      record.set("first advance event", static_cast<double>(event));
    }

    void set_end(const Growth &growth, const std::string &force, Record &record)
    {
      record.set("reaction left", growth.reaction_left());
      if (growth.load_left)
        record.set("load left", *growth.load_left);
      record.set("last load", growth.last_load);
      record.set("first stiffness", growth.first_stiffness, force);
      record.set("resumed", static_cast<double>(growth.n_resumed));
      record.texts["end"] = base::word(growth.end);
      record.texts["connected"] = growth.is_separated ? "no" : "yes";
    }

    /// Curves of the events and of the bonds that they break.
    /// @param names, places  further columns, of where the crack is after each event
    void add_events(const std::vector<Event> &events, const std::vector<std::string> &names,
                    const std::vector<std::vector<double>> &places, Record &record)
    {
      std::vector<std::string> columns = {
          "event", "critical load", "load",     "bonds",    "reaction before", "reaction",
          "work",  "stored",        "in bonds", "released", "residual",        "factored"};
      columns.insert(columns.end(), names.begin(), names.end());
      analysis::Curve all = curve_of(columns);
      for (std::size_t i = 0; i < events.size(); ++i)
      {
        const Event &e = events[i];
        std::vector<double> row = {static_cast<double>(i),
                                   e.critical,
                                   e.load,
                                   static_cast<double>(e.bonds.size()),
                                   e.reaction_before,
                                   e.reaction,
                                   e.work,
                                   e.stored,
                                   e.in_bonds,
                                   e.released,
                                   e.residual,
                                   e.is_factored ? 1. : 0.};
        row.insert(row.end(), places[i].begin(), places[i].end());
        add_row(all, row);
      }
      record.curves["events"] = std::move(all);
      analysis::Curve broken = curve_of({"event", "bond"});
      for (std::size_t i = 0; i < events.size(); ++i)
        for (const std::size_t bond : events[i].bonds)
          add_row(broken, {static_cast<double>(i), static_cast<double>(bond)});
      record.curves["broken"] = std::move(broken);
    }

    void add_path(const GrowthFindings &found, Record &record)
    {
      const dealii::Point<2> &origin = found.origin;
      analysis::Curve sides = curve_of({"event", "x0", "y0", "x1", "y1", "joined"});
      analysis::Curve notch = curve_of({"x0", "y0", "x1", "y1"});
      for (const CrackSide &side : found.path.sides)
        add_row(sides, {static_cast<double>(side.event), origin[0] + side.ends[0][0],
                        origin[1] + side.ends[0][1], origin[0] + side.ends[1][0],
                        origin[1] + side.ends[1][1], side.is_joined ? 1. : 0.});
      for (const auto &[from, to] : found.path.notch)
        add_row(notch,
                {origin[0] + from[0], origin[1] + from[1], origin[0] + to[0], origin[1] + to[1]});
      record.curves["sides"] = std::move(sides);
      record.curves["notch"] = std::move(notch);
    }

    void add_moments_and_parts(const std::vector<GrowthMoment> &found_moments,
                               const std::vector<BrokenPart> &found_parts, Record &record)
    {
      analysis::Curve moments = curve_of({"events", "load"});
      for (const GrowthMoment &moment : found_moments)
        add_row(moments, {static_cast<double>(moment.n_events), moment.load});
      record.curves["moments"] = std::move(moments);
      analysis::Curve parts = curve_of({"G", "bonds", "length"});
      for (const BrokenPart &part : found_parts)
        add_row(parts, {part.toughness, static_cast<double>(part.n_bonds), part.length});
      record.curves["parts"] = std::move(parts);
    }

    void add_fields(const GrowthFindings &found, Record &record)
    {
      analysis::PointField damage{static_cast<unsigned int>(found.moments.size()), found.nodes, {}};
      for (dealii::Point<2> &node : damage.points)
        node += found.origin;
      const auto [least, largest] =
          std::minmax_element(found.toughness.begin(), found.toughness.end());
      if (least != largest && *least < *largest)
        record.fields["G"] = {1, damage.points, found.toughness};
      for (std::size_t i = 0; i < found.nodes.size(); ++i)
        for (const GrowthMoment &moment : found.moments)
          damage.values.push_back(moment.damage[i]);
      record.fields["damage"] = std::move(damage);
      add_moments_and_parts(found.moments, found.parts, record);
    }
  } // namespace

  Record growth_record(Record record, const GrowthFindings &found)
  {
    const Growth &growth = found.growth;
    const CrackPath &path = found.path;
    std::vector<double> way;
    std::vector<std::vector<double>> places;
    for (const dealii::Point<2> &tip : path.tips)
    {
      way.push_back(tip.distance(found.notch_tip));
      places.push_back({found.origin[0] + tip[0], found.origin[1] + tip[1], way.back()});
    }
    set_events(growth.events, "force", record);
    set_beginnings(growth.events, way, record);
    record.set("advance", way.empty() ? 0 : way.back(), "length");
    set_toughness(found, path.width, record);
    set_intensity(found.plane_modulus, record);
    set_lengths(found, record);
    record.set("width", path.width, "length");
    if (path.notch.empty() && !path.sides.empty())
    {
      record.set("nucleus x", found.origin[0] + found.notch_tip[0], "length");
      record.set("nucleus y", found.origin[1] + found.notch_tip[1], "length");
    }
    record.set("apart", static_cast<double>(path.n_elsewhere));
    if (found.n_unpaired)
      record.set("unpaired", static_cast<double>(*found.n_unpaired));
    set_end(growth, "force", record);
    add_events(growth.events, {"tip x", "tip y", "way"}, places, record);
    add_path(found, record);
    add_fields(found, record);
    return record;
  }

  namespace
  {
    double mean(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double one : values)
        sum += one;
      return sum / static_cast<double>(values.size());
    }

    void add_front(const FrontFindings &found, Record &record)
    {
      const CrackFront &front = found.front;
      analysis::Curve line = curve_of({"moment", "events", "z", "way"}),
                      sides = curve_of({"event", "z", "x0", "y0", "x1", "y1", "joined"});
      for (std::size_t k = 0; k < found.moments.size(); ++k)
        for (std::size_t l = 0; l < front.z.size(); ++l)
          add_row(
              line,
              {static_cast<double>(k), static_cast<double>(found.moments[k].n_events), front.z[l],
               found.moments[k].n_events == 0 ? 0 : front.way[found.moments[k].n_events - 1][l]});
      for (std::size_t l = 0; l < front.z.size(); ++l)
        for (const CrackSide &side : front.layers[l].sides)
          add_row(sides,
                  {static_cast<double>(side.event), front.z[l], side.ends[0][0], side.ends[0][1],
                   side.ends[1][0], side.ends[1][1], side.is_joined ? 1. : 0.});
      record.curves["front"] = std::move(line);
      record.curves["sides"] = std::move(sides);
    }

    /// Of the layer in the middle of the thickness.
    analysis::PointField damage_in_the_middle(const FrontFindings &found)
    {
      const double z = found.front.z[(found.front.z.size() - 1) / 2];
      analysis::PointField damage{static_cast<unsigned int>(found.moments.size()), {}, {}};
      for (std::size_t i = 0; i < found.nodes.size(); ++i)
        if (std::abs(found.nodes[i][2] - z) < .5 * found.h)
        {
          damage.points.emplace_back(found.nodes[i][0], found.nodes[i][1]);
          for (const GrowthMoment &moment : found.moments)
            damage.values.push_back(moment.damage[i]);
        }
      return damage;
    }
  } // namespace

  Record growth_record(Record record, const FrontFindings &found)
  {
    const Growth &growth = found.growth;
    const auto extent = [](const std::vector<double> &of_layers) -> std::vector<double>
    {
      const auto [least, most] = std::minmax_element(of_layers.begin(), of_layers.end());
      return {mean(of_layers), *least, *most};
    };
    std::vector<double> way;
    std::vector<std::vector<double>> places;
    for (const std::vector<double> &of_layers : found.front.way)
    {
      places.push_back(extent(of_layers));
      way.push_back(places.back().front());
    }
    set_events(growth.events, "force length", record);
    set_beginnings(growth.events, way, record);
    const std::vector<double> last = places.empty() ? std::vector<double>(3, 0) : places.back();
    record.set("advance", last[0], "length");
    record.set("advance min", last[1], "length");
    record.set("advance max", last[2], "length");
    set_toughness(found, found.front.area, record);
    record.set("area", found.front.area, "length^2");
    if (found.nucleus)
      for (unsigned int d = 0; d < 3; ++d)
        record.set(std::string("nucleus ") + "xyz"[d], (*found.nucleus)[d], "length");
    record.set("apart", static_cast<double>(found.front.n_elsewhere));
    record.set("unpaired", static_cast<double>(found.n_unpaired_in_y));
    record.set("unpaired in z", static_cast<double>(found.n_unpaired_in_z));
    set_end(growth, "force length", record);
    add_events(growth.events, {"way", "way min", "way max"}, places, record);
    add_front(found, record);
    add_moments_and_parts(found.moments, found.parts, record);
    record.curves["phases"] = {{"G", "force/length", {}}};
    record.fields["damage"] = damage_in_the_middle(found);
    return record;
  }

  bool is_in_space(const Record &record)
  {
    return record.curves.count("front") > 0;
  }

  bool is_scattered(const Record &record)
  {
    return record.text("nodes") == scattered_nodes;
  }

  bool is_corrected(const Record &record)
  {
    const std::string &terms = record.text("surface terms");
    return !terms.empty() && terms != base::word(problem::SurfaceTerms::uncorrected);
  }

  std::vector<Expectation> check_crack_growth(const Record &record,
                                              const scene::ExpectedSection &expected)
  {
    if (!record.failure.empty())
      return {{record.key.label(), "a result", record.failure, false}};
    std::vector<Expectation> all;
    for (const auto &[name, value] : expected.growth)
      all.push_back({name, base::to_text(value, 6),
                     record.has(name) ? base::to_text(record[name], 6) : "unknown",
                     record.has(name) && std::abs(record[name] - value) <=
                                             expected.error_tolerance * std::abs(value)});
    if (expected.growth_end != problem::GrowthEnd::unknown)
      all.push_back({"end", base::word(expected.growth_end), record.text("end"),
                     base::word(expected.growth_end) == record.text("end")});
    if (!is_corrected(record) && !(record["imbalance"] <= worst_imbalance))
      all.push_back({"energy balance", "imbalance <= " + base::to_text(worst_imbalance, 3),
                     base::to_text(record["imbalance"], 3), false});
    return all;
  }

  std::vector<std::string> left_out_of_growth(const Record &record)
  {
    std::vector<std::string> result = {
        "equilibrium at all times: no inertia, rate dependence or heat; the energy released in "
        "unstable growth is lost",
        "monotonically increasing load: a snap-back appears as a drop of the reaction at constant "
        "load",
        "bonds break irreversibly, by their tensile stretch alone; crack faces transmit pressure "
        "only through intact bonds",
        std::string(is_in_space(record) ? "one lattice: cracks tend to follow its planes"
                    : is_scattered(record)
                        ? "two dimensions, one set of nodes, on which the path of cracks depends"
                        : "two dimensions, one lattice: cracks tend to follow its rows and "
                          "columns") +
            ", the more so the fewer neighbours nodes have (Study/m)",
        "no contact, friction or large rotations; Fracture/stretch = finite uses the finite "
        "stretch of small displacements"};
    result.push_back(
        is_corrected(record)
            ? "the energy balance: the surface terms do not derive from an energy"
            : "families are incomplete at free surfaces and crack faces: no correction "
              "of the dilatation, no terms that make them traction-free "
              "(Fracture/surface terms)");
    return result;
  }
} // namespace plumbline::study
