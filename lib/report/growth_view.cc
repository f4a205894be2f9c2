#include "report/damage_maps.h"
#include "report/microstructure.h"
#include "report/spectrum_chart.h"
#include "report/view.h"
#include "study/growth.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using analysis::Curve;

    const std::vector<double> &column(const Curve &curve, const std::string &name)
    {
      return std::find_if(curve.begin(), curve.end(),
                          [&](const analysis::Column &one) { return one.name == name; })
          ->values;
    }

    /// That break in the first event.
    std::size_t first_bonds(const Record &record)
    {
      const Curve &events = record.curves.at("events");
      return events[0].values.empty() ? 0
                                      : static_cast<std::size_t>(column(events, "bonds").front());
    }

    std::vector<std::pair<std::string, std::string>> meanings(const Record &record)
    {
      const bool has_factor = record.text("solver") != base::word(problem::GrowthSolver::multigrid);
      return {
          {"broken bonds", "the notch's not counted"},
          {"events", "at each a bond and its ties, or a batch"},
          {"first break", "load at which the first bond breaks: event 0, " +
                              std::to_string(first_bonds(record)) + " at once"},
          {"first advance", "load at which the tip leaves the notch's: event " +
                                std::to_string(record.count("first advance event"))},
          {"peak load", "where the reaction is largest"},
          {"peak reaction", "of the grips on what they do [force]"},
          {"advance", "of the tip, from the notch's [length]"},
          {"G by bonds", "of broken bonds, each by its part of a straight crack's length, over the "
                         "width [force/length]"},
          {"G by energy", "all that bonds held and that was released, over the width: above the "
                          "material's where growth is unstable [force/length]"},
          {"K by bonds", "root of that and the mean of E/(1 - nu²)"},
          {"K by energy", "the same of G by energy"},
          {"L1", "of the crack within phase 1, the weaker, as a straight crack breaks so many "
                 "bonds; of one phase all [length]"},
          {"L2", "the same within phase 2, the tougher"},
          {"Li", "the same on their interface, of bonds with an end in each"},
          {"width", "of all sides that separated, projected onto the x-axis [length]"},
          {"apart", "sides that separated elsewhere, not connected to the notch"},
          {"connected", "paths of bonds join the grips at the end"},
          {"reaction left", "at the end, over its largest"},
          {"s0", "critical stretch of bonds, the smallest of all materials"},
          {"G_h / G", "all bonds across a straight line of the lattice at their limits"},
          {"G_peak / G",
           "at which a crack goes on in a strip of this lattice; G was divided by it"},
          {"unpaired", "broken bonds whose mirror image about the middle is whole"},
          {"imbalance",
           study::is_corrected(record)
               ? "maximum imbalance of the bonds' energy relative to the work; surface "
                 "terms derive from no energy"
               : "maximum imbalance of energy relative to the work"},
          {"residual", "force on a node over a bond's at the beginning"},
          {"unknowns", "displacements"},
          {"bonds", "whole at the beginning"},
          {"factorisations",
           std::string(has_factor ? "of the equations; " : "set-ups of multigrid; ") +
               rounded_seconds(record["factor seconds"]) + " in all"},
          {"updates", "events without one, up to rank " + rounded(record["largest rank"]) + "; " +
                          rounded_seconds(record["update seconds"]) + " in all"},
          {"iterations", std::string(has_factor ? "of GMRES" : "of conjugate gradients") +
                             ", at most " + rounded(record["most iterations"]) + " an event"},
          {"resumed", "events of the checkpoint that the growth went on from; 0: none"}};
    }

    Table numbers(const Record &record)
    {
      constexpr std::size_t most_parts = 8; // of a material that varies from place to place
      Table table = quantity_table(record, meanings(record));
      const Curve &parts = record.curves.at("parts");
      const std::size_t n = parts[0].values.size();
      for (std::size_t i = 0; i < n && n <= most_parts && !record.has("L1"); ++i)
        table.rows.push_back(
            {text_cell("length, G = " + rounded(column(parts, "G")[i])),
             number_cell(column(parts, "length")[i]),
             text_cell(rounded(column(parts, "bonds")[i]) +
                       " broken bonds of this toughness, as a straight crack has them [length]")});
      return table;
    }

    std::string ending(const Record &record)
    {
      const auto end = base::from_word<problem::GrowthEnd>(record.text("end"));
      switch (end.value_or(problem::GrowthEnd::unknown))
      {
      case problem::GrowthEnd::parted:
        return "until no path of bonds joins the grips";
      case problem::GrowthEnd::unloaded:
        return "until the reaction is " + rounded(record["min reaction"]) +
               " of its largest (Fracture/min reaction)";
      case problem::GrowthEnd::loaded:
        return "until Fracture/max load, " + rounded(record["max load"]);
      case problem::GrowthEnd::whole:
        return "until no bond is left that can break";
      default:
        return "";
      }
    }

    std::string verdict(const Record &record)
    {
      std::string text;
      const bool is_broken = record.count("events") > 0;
      if (is_broken)
        text = std::to_string(record.count("broken bonds")) + " bonds break at " +
               std::to_string(record.count("events")) + " events from load " +
               rounded(column(record.curves.at("events"), "load").front()) + " on, " +
               ending(record) + ". The reaction is largest, " + rounded(record["peak reaction"]) +
               ", at load " + rounded(record["peak load"]) + "; the crack advances by " +
               rounded(record["advance"]);
      else
        text = "No bond breaks up to load " + rounded(record["last load"]);
      if (record.count("apart") > 0)
        text += "; bonds also part elsewhere, " + std::to_string(record.count("apart")) +
                " sides that do not join the notch";
      if (is_broken)
        text += ". At the end " +
                std::string(record.text("connected") == "no" ? "no bonds" : "bonds still") +
                " join the grips, and " + rounded(record["reaction left"]) +
                " of the largest reaction is left";
      return text + ".";
    }

    std::string phase_words(const Record &record)
    {
      const std::vector<double> &phases = record.curves.at("phases")[0].values;
      if (phases.size() != 2)
        return "";
      const bool is_least =
          record.text("toughness of bonds") == base::word(problem::BondToughness::minimum);
      return " Phase 1 has G = " + rounded(phases[0]) +
             " and phase 2 has G = " + rounded(phases[1]) +
             (is_least ? "; each bond has the minimum of G along its length."
                       : "; a bond between the phases has the mean of both values.");
    }

    std::string interface_words(const Record &record)
    {
      const std::size_t n = record.count("interfaces");
      return n == 0
                 ? ""
                 : " Bonds across " + std::to_string(n) + (n == 1 ? " line has" : " lines have") +
                       " a G of its own (Fracture/interfaces).";
    }

    /// With what makes it again.
    std::string model(const Record &record)
    {
      const std::string &seeds = record.text("seeds"), &field = record.text("field");
      return "Model: " + record.text("model") +
             ". A bond breaks at the stretch s0, s0² = πG/(3δ(λ + μ)), at which all bonds across a "
             "straight cut of the continuum hold G (Fan et al. 2022, eq. (2.25); exact where λ = "
             "μ). On this lattice they hold " +
             rounded(record["G_h / G"]) +
             " G, and a crack needs more than that to pass from one column of nodes to the next" +
             (record.has("G_peak / G")
                  ? ": " + rounded(record["G_peak / G"]) +
                        " G, as a strip shows, by the root of which s0 was lowered (Fracture/"
                        "criterion = calibrated)."
                  : ".") +
             phase_words(record) + interface_words(record) +
             (field.empty() ? "" : " Of the random field " + field + ".") +
             (seeds.empty() ? "" : " " + seeds + ".");
    }

    /// Columns of the events.
    Table data_of(const Curve &events, const std::vector<std::string> &names)
    {
      Curve chosen;
      for (const std::string &name : names)
        chosen.push_back({name, "", column(events, name)});
      return table_of(chosen);
    }

    DataChart load_chart(const Curve &events)
    {
      DataChart chart = linear_chart(
          "load", "Reaction over load", "load factor [1]", "reaction [force]",
          "Under a load that never falls a break lets the reaction fall at once. Dashed: "
          "the same bonds at loads at which each event would just begin, equilibria that a "
          "load that follows would pass through.");
      std::vector<Vertex> path = {{0, 0}}, critical = {{0, 0}};
      chart.data =
          data_of(events, {"event", "load", "reaction before", "reaction", "critical load"});
      chart.data.columns.emplace_back("reaction there");
      const auto &load = column(events, "load"), &before = column(events, "reaction before"),
                 &after = column(events, "reaction"), &begins = column(events, "critical load");
      for (std::size_t i = 0; i < load.size(); ++i)
      {
        const double there = before[i] * begins[i] / load[i];
        path.push_back({load[i], before[i]});
        path.push_back({load[i], after[i]});
        critical.push_back({begins[i], there});
        chart.data.rows[i].push_back(number_cell(there));
      }
      chart.plot.lines = {dashed_line("where events begin", 1, std::move(critical)),
                          long_line("load that never falls", 0, std::move(path))};
      return chart;
    }

    DataChart energy_chart(const Record &record, const Curve &events)
    {
      DataChart chart = linear_chart(
          "energies", "Energy balance", "broken bonds [1]", "energy [force]",
          "Energy balance: the external work is stored, dissipated in broken bonds, or released in "
          "unstable crack growth. The maximum imbalance relative to the work is " +
              rounded(record["imbalance"]) +
              (study::is_corrected(record)
                   ? ", because the surface terms do not derive from an energy."
                   : "."));
      chart.data =
          data_of(events, {"event", "load", "bonds", "work", "stored", "in bonds", "released"});
      unsigned int style = 0;
      for (const char *const name : {"work", "stored", "in bonds", "released"})
      {
        std::vector<Vertex> points;
        double n = 0;
        for (std::size_t i = 0; i < events[0].values.size(); ++i)
        {
          n += column(events, "bonds")[i];
          points.push_back({n, column(events, name)[i]});
        }
        const std::string label = std::string(name) == "in bonds" ? "in broken bonds" : name;
        chart.plot.lines.push_back(long_line(label, style++, std::move(points)));
      }
      return chart;
    }

    DataChart tip_chart(const Curve &events)
    {
      DataChart chart = linear_chart(
          "tip", "What load the crack needs", "tip's way from the notch [length]",
          "load factor at which an event begins [1]",
          "The crack is where next neighbours have separated; its tip the end of these sides "
          "that is farthest from the notch's tip. From column to column the lattice traps "
          "it, and lets it go at a lower load.");
      chart.data = data_of(events, {"event", "critical load", "load", "tip x", "tip y", "way"});
      std::vector<Vertex> points;
      double way = 0;
      for (std::size_t i = 0; i < events[0].values.size(); ++i)
      {
        points.push_back({way, column(events, "critical load")[i]});
        way = column(events, "way")[i];
      }
      chart.plot.lines = {long_line("", 0, std::move(points))};
      return chart;
    }

    std::vector<DataChart> charts(const Record &record)
    {
      const Curve &events = record.curves.at("events");
      if (events[0].values.empty())
        return {};
      std::vector<DataChart> all = {load_chart(events), energy_chart(record, events),
                                    tip_chart(events)};
      for (DataChart &chart : all)
        fit_y(chart.plot);
      if (record["variance kept"] > 0)
      {
        const Curve &spectrum = record.curves.at("spectrum");
        all.push_back(spectrum_chart(column(spectrum, "share"), column(spectrum, "kept"),
                                     record.text("field")));
      }
      return all;
    }

    std::vector<Picture> pictures(const Record &record)
    {
      const Curve &moments = record.curves.at("moments");
      std::vector<std::string> titles;
      for (std::size_t i = 0; i < moments[0].values.size(); ++i)
        titles.push_back("load " + rounded(column(moments, "load")[i]) + ", " +
                         rounded(column(moments, "events")[i]) + " events");
      const char *const title = "Where bonds are broken";
      std::vector<Picture> all = {
          {"moments", title,
           damage_script(record.fields.at("damage"), record.key.h, titles, "moments.svg", title),
           "The part of each node's bonds that is broken or cut, on the body at rest, after even "
           "parts of all broken bonds. Beside a straight crack at m = 3 it is 11/28, 6/28 and "
           "1/28."}};
      if (has_microstructure(record))
        all.insert(all.begin(),
                   {"microstructure", "The crack in its microstructure",
                    microstructure_script(record),
                    "Grey: G of the nodes, the tougher the darker. Sides between next "
                    "neighbours that have separated: of the crack orange, apart from it blue; "
                    "of the notch black. Data: grow/sides.csv."});
      return all;
    }
  } // namespace

  View growth_view(const StudyResults &results)
  {
    View view{"Quasi-static fracture"};
    view.parts = {failures(results, "No result", "because")};
    const auto grown = study::finest_records(results);
    if (grown.empty())
      return view;
    const Record &record = *grown.front();
    view.answer = verdict(record);
    view.model = model(record);
    view.omitted = study::left_out_of_growth(study::is_corrected(record));
    view.facts = {record.key.method + ", m = " + rounded(record.key.m()), record.key.problem,
                  record.text("end")};
    view.parts.insert(view.parts.begin(), {"numbers", "Numbers", "", numbers(record)});
    view.galleries = {{"picture", "What happens", "", charts(record), pictures(record)}};
    view.tables = {{"events", table_of(record.curves.at("events"))},
                   {"sides", table_of(record.curves.at("sides"))}};
    return view;
  }
} // namespace plumbline::report
