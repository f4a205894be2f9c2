#include "report/breaking_view.h"
#include "report/counted.h"
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

    /// That break in the first event.
    std::size_t first_bonds(const Record &record)
    {
      const Curve &events = record.curves.at("events");
      return events[0].values.empty() ? 0
                                      : static_cast<std::size_t>(column(events, "bonds").front());
    }

    /// Of energies, and of what is conjugate to the load factor: in the plane for each unit of
    /// thickness.
    std::string force_unit(const Record &record)
    {
      return study::is_in_space(record) ? "force length" : "force";
    }

    /// Alone, or besides grips: then what is conjugate to the load factor grows as the body gives
    /// way.
    bool is_pulled_by_loads(const Record &record)
    {
      return record.text("pulled by") == "dead loads";
    }

    std::vector<std::pair<std::string, std::string>> meanings(const Record &record)
    {
      const bool has_factor = record.text("solver") != base::word(problem::GrowthSolver::multigrid),
                 is_in_space = study::is_in_space(record);
      return {
          {"broken bonds", "without those that the notch cuts"},
          {"events", "each breaks one bond and its ties, or a batch of bonds"},
          {"first break", "load factor at which the first bond breaks (event 0, with " +
                              counted(first_bonds(record), "bond") + " at once)"},
          {"first advance", "load factor at which the crack starts to grow (event " +
                                std::to_string(record.count("first advance event")) + ")"},
          {"peak load", "load factor of the peak reaction"},
          {"peak reaction", "of grips and dead loads, work-conjugate to the load factor [" +
                                force_unit(record) + "]"},
          {"advance", is_in_space
                          ? "growth of the crack front, mean over the layers of nodes along z "
                            "[length]"
                          : "growth of the crack, from the notch tip [length]"},
          {"advance min", "the minimum over the layers [length]"},
          {"advance max", "the maximum over the layers [length]"},
          {"G by bonds",
           "energy of the broken bonds, each by its share of a straight crack's " +
               std::string(is_in_space ? "area, over the area" : "length, over the width") +
               " [force/length]"},
          {"G by energy",
           "energy dissipated in broken bonds and released, over the " +
               std::string(is_in_space ? "area" : "width") +
               "; larger than that of the material if growth is unstable [force/length]"},
          {"K by bonds",
           "√(G E/(1 - ν²)) with G by bonds and the mean of E/(1 - ν²) [force/length^1.5]"},
          {"K by energy", "the same with G by energy [force/length^1.5]"},
          {"L1", "length of a straight crack with as many broken bonds in phase 1, the weaker "
                 "one; with one phase, of the whole crack [length]"},
          {"L2", "the same in phase 2, the tougher one [length]"},
          {"Li", "the same on the interface: bonds with one end in each phase [length]"},
          {"width", "of all separated cell faces, projected onto the x-axis [length]"},
          {"area", "of all separated cell faces, projected onto the plane of x and z [length^2]"},
          {"apart", "separated cell faces that are not connected to the notch, or without one to "
                    "the first of them"},
          {"nucleus x", "where the crack begins in a body without a notch: the middle of the first "
                        "separated cell face [length]"},
          {"nucleus y", "the same [length]"},
          {"nucleus z", "the same: the layer of nodes in which it lies [length]"},
          {"connected", "whether bonds still connect the grips at the end"},
          {"reaction left", "reaction at the end relative to its peak"},
          {"load left",
           "part of the dead loads that acts on connected nodes at the end: nodes that "
           "come loose lose their loads"},
          {"s0", "critical stretch of bonds, the minimum over all materials"},
          {"G_h / G",
           "energy of all bonds across a straight " +
               std::string(is_in_space                   ? "plane of the lattice"
                           : study::is_scattered(record) ? "line (the mean over its directions)"
                                                         : "line of the lattice") +
               " at the critical stretch, relative to G"},
          {"G_peak / G", "energy release rate at which a crack grows in a strip of this lattice, "
                         "relative to G; G was divided by this factor"},
          {"unpaired", "broken bonds whose mirror image about the midline is intact"},
          {"unpaired in z",
           "broken bonds whose mirror image about the mid-plane of the thickness is intact"},
          {"imbalance", study::is_corrected(record)
                            ? "maximum imbalance of the bonds' energy relative to the work; the "
                              "surface terms do not derive from an energy"
                            : "maximum imbalance of energy relative to the work"},
          {"residual", "force on a node relative to that of a bond, at the beginning"},
          {"unknowns", "displacement components"},
          {"bonds", "intact at the beginning"},
          {"factorisations", std::string(has_factor ? "of the matrix; " : "setups of multigrid; ") +
                                 rounded_seconds(record["factor seconds"]) + " in all"},
          {"updates", "events without a factorisation, up to rank " +
                          rounded(record["largest rank"]) + "; " +
                          rounded_seconds(record["update seconds"]) + " in all"},
          {"iterations", std::string(has_factor ? "of GMRES" : "of conjugate gradients") +
                             ", at most " + rounded(record["most iterations"]) + " per event"},
          {"resumed", "events read from a checkpoint (0: none)"}};
    }

    Table numbers(const Record &record)
    {
      constexpr std::size_t most_parts = 8; // of a material that varies from place to place
      Table table = quantity_table(record, meanings(record));
      const Curve &parts = record.curves.at("parts");
      const std::size_t n = parts[0].values.size();
      for (std::size_t i = 0; i < n && n <= most_parts && !record.has("L1"); ++i)
        table.rows.push_back(
            {text_cell((study::is_in_space(record) ? "area, G = " : "length, G = ") +
                       rounded(column(parts, "G")[i])),
             number_cell(column(parts, "length")[i]),
             text_cell(rounded(column(parts, "bonds")[i]) + " broken bonds of this toughness; " +
                       (study::is_in_space(record)
                            ? "area of a plane crack with as many [length^2]"
                            : "length of a straight crack with as many [length]"))});
      return table;
    }

    std::string ending(const Record &record)
    {
      const auto end = base::from_word<problem::GrowthEnd>(record.text("end"));
      switch (end.value_or(problem::GrowthEnd::unknown))
      {
      case problem::GrowthEnd::parted:
        return is_pulled_by_loads(record) ? "until no bonds connect what is loaded with the grips"
                                          : "until no bonds connect the grips";
      case problem::GrowthEnd::unloaded:
        return "until the reaction has fallen to " + rounded(record["min reaction"]) +
               " of its peak (Fracture/min reaction)";
      case problem::GrowthEnd::loaded:
        return "until Fracture/max load, " + rounded(record["max load"]);
      case problem::GrowthEnd::whole:
        return "until no breakable bond is left";
      default:
        return "";
      }
    }

    std::string growth_words(const Record &record)
    {
      if (!record.has("first advance"))
        return "The crack does not grow";
      if (record.has("nucleus x"))
        return "A crack begins at (" + rounded(record["nucleus x"]) + ", " +
               rounded(record["nucleus y"]) +
               (record.has("nucleus z") ? ", " + rounded(record["nucleus z"]) : "") + ") at load " +
               rounded(record["first advance"]) + " and advances by " + rounded(record["advance"]) +
               " [length]";
      return "The crack starts to grow at load " + rounded(record["first advance"]) +
             " and advances by " + rounded(record["advance"]) + " [length]";
    }

    std::string peak_words(const Record &record)
    {
      if (is_pulled_by_loads(record))
      {
        const std::vector<double> loads = column(record.curves.at("events"), "load");
        return "; the largest load is " + rounded(*std::max_element(loads.begin(), loads.end()));
      }
      return "; the peak reaction, " + rounded(record["peak reaction"]) + " [" +
             force_unit(record) + "], is at load " + rounded(record["peak load"]);
    }

    /// What still pulls at the end.
    std::string words_of_rest(const Record &record)
    {
      if (!is_pulled_by_loads(record))
        return " connect the grips, and the reaction is " + rounded(record["reaction left"]) +
               " of its peak";
      const double left = record["load left"];
      return " connect what is loaded with the grips" +
             (left > 0 ? ", and " + rounded(left) + " of the dead loads act on connected nodes"
                       : "");
    }

    std::string verdict(const Record &record)
    {
      std::string text;
      const bool is_broken = record.count("events") > 0;
      if (is_broken)
        text = growth_words(record) + peak_words(record) + ". " +
               counted(record.count("broken bonds"), "bond") +
               (record.count("broken bonds") == 1 ? " breaks at " : " break at ") +
               counted(record.count("events"), "event") + ", from load " +
               rounded(column(record.curves.at("events"), "load").front()) + " on, " +
               ending(record);
      else
        text = "No bond breaks up to load " + rounded(record["last load"]);
      if (record.count("apart") > 0)
        text += "; " + counted(record.count("apart"), "cell face") +
                (record.count("apart") == 1 ? " separates" : " separate") +
                " elsewhere, not connected to " +
                (record.has("nucleus x") ? "the crack" : "the notch");
      if (is_broken)
        text += ". At the end " +
                std::string(record.text("connected") == "no" ? "no bonds" : "bonds still") +
                words_of_rest(record);
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
      return n == 0 ? ""
                    : " Bonds across " + counted(n, "line") +
                          " have their own G (Fracture/interfaces).";
    }

    /// With what makes it again.
    std::string model(const Record &record)
    {
      const std::string &seeds = record.text("seeds"), &field = record.text("field");
      const bool is_in_space = study::is_in_space(record);
      const bool is_scattered = study::is_scattered(record);
      return "Model: " + record.text("model") + ". A bond breaks at the critical stretch s0, " +
             record.text("critical stretch") + ", at which all bonds across a " +
             (is_in_space ? "plane" : "straight") +
             " cut of the continuum store the energy G; exact where λ = μ. " +
             (is_scattered ? "Between these nodes" : "On this lattice") + " they store " +
             rounded(record["G_h / G"]) + " G, and a crack needs more than that to pass from one " +
             (is_scattered ? "node to the next" : "column of nodes to the next") +
             (record.has("G_peak / G") ? ": " + rounded(record["G_peak / G"]) +
                                             " G, found in a strip; s0 was divided by the square "
                                             "root of this factor (Fracture/"
                                             "criterion = calibrated)."
                                       : ".") +
             phase_words(record) + interface_words(record) +
             (field.empty() ? "" : " With the random field " + field + ".") +
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

    DataChart load_chart(const Record &record, const Curve &events)
    {
      DataChart chart =
          linear_chart("load", "Reaction versus load", "load factor [1]",
                       "reaction [" + force_unit(record) + "]",
                       std::string("Solid: monotonically increasing load; each event ") +
                           (is_pulled_by_loads(record)
                                ? "moves the dead loads on at constant load, which raises their "
                                  "displacement, the reaction here"
                                : "lowers the reaction at constant load") +
                           ". Dashed: the equilibria at which each event begins, the path "
                           "under crack-controlled loading.");
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
      chart.plot.lines = {dashed_line("events begin", 1, std::move(critical)),
                          long_line("increasing load", 0, std::move(path))};
      return chart;
    }

    DataChart energy_chart(const Record &record, const Curve &events)
    {
      DataChart chart = linear_chart(
          "energies", "Energy balance", "broken bonds [1]", "energy [" + force_unit(record) + "]",
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

    DataChart tip_chart(const Curve &events, bool is_in_space)
    {
      DataChart chart = linear_chart(
          "tip", "Load at which the crack grows", "crack advance [length]",
          "load factor at which an event begins [1]",
          std::string(is_in_space
                          ? "Advance of the crack front: the mean over the layers of nodes. "
                          : "") +
              "The crack consists of the cell faces whose two nodes have separated; its tip is the "
              "end of these faces that is farthest from the notch tip. The nodes trap the tip, a "
              "lattice at each of its columns, and release it at a lower load.");
      chart.data =
          data_of(events, is_in_space ? std::vector<std::string>{"event", "critical load", "load",
                                                                 "way", "way min", "way max"}
                                      : std::vector<std::string>{"event", "critical load", "load",
                                                                 "tip x", "tip y", "way"});
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

    /// A line for each moment after the first.
    DataChart front_chart(const Curve &front)
    {
      DataChart chart = linear_chart(
          "front", "Crack front", "z [length]", "advance from the notch tip [length]",
          "Advance of the crack in each layer of nodes along z, at equal steps of the number of "
          "broken bonds. In a layer it is determined as in two dimensions, from the bonds in it.");
      chart.data = table_of(front);
      std::vector<std::vector<Vertex>> lines;
      std::vector<double> n_events;
      for (std::size_t i = 0; i < front[0].values.size(); ++i)
      {
        const auto moment = static_cast<std::size_t>(column(front, "moment")[i]);
        lines.resize(std::max(lines.size(), moment + 1));
        n_events.resize(lines.size());
        n_events[moment] = column(front, "events")[i];
        lines[moment].push_back({column(front, "z")[i], column(front, "way")[i]});
      }
      for (std::size_t k = 1; k < lines.size(); ++k)
        chart.plot.lines.push_back(long_line(rounded(n_events[k]) + " events",
                                             static_cast<unsigned int>(k - 1),
                                             std::move(lines[k])));
      return chart;
    }

    std::vector<DataChart> charts(const Record &record)
    {
      const Curve &events = record.curves.at("events");
      if (events[0].values.empty())
        return {};
      std::vector<DataChart> all = {load_chart(record, events), energy_chart(record, events),
                                    tip_chart(events, study::is_in_space(record))};
      if (study::is_in_space(record))
        all.push_back(front_chart(record.curves.at("front")));
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
      const bool is_in_space = study::is_in_space(record);
      const char *const title =
          is_in_space ? "Damage: broken bonds, at mid-thickness" : "Damage: broken bonds";
      std::vector<Picture> all = {
          {"moments", title,
           damage_script(record.fields.at("damage"), record.key.h, titles, "moments.svg", title),
           "The fraction of each node's bonds that is broken or cut, on the undeformed body, at "
           "equal steps of the number of broken bonds. " +
               std::string(is_in_space
                               ? "For all nodes, as VTU: frames/damage.pvd."
                               : "Beside a straight crack at m = 3 it is 11/28, 6/28 and 1/28.")}};
      if (has_microstructure(record))
        all.insert(
            all.begin(),
            {"microstructure", "The crack in its microstructure", microstructure_script(record),
             "Grey: G of the nodes, darker is tougher. Separated cell faces: orange those of "
             "the crack, blue those apart from it, black those of the notch. Data: "
             "grow/sides.csv."});
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
    if (is_of_breaking(record))
      return breaking_view(record);
    view.answer = verdict(record);
    view.parts.push_back(model_part(model(record)));
    view.parts.push_back(omitted_part(study::left_out_of_growth(record)));
    view.facts = {record.key.method + ", m = " + rounded(record.key.m()), record.key.problem,
                  record.text("end")};
    view.parts.insert(view.parts.begin(), {"numbers", "Numbers", "", numbers(record)});
    view.galleries = {{"picture", "Results", "", charts(record), pictures(record)}};
    view.tables = {{"events", table_of(record.curves.at("events"))},
                   {"sides", table_of(record.curves.at("sides"))}};
    return view;
  }
} // namespace plumbline::report
