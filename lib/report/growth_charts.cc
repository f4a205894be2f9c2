#include "report/growth_charts.h"

#include "report/damage_maps.h"
#include "report/microstructure.h"
#include "report/spectrum_chart.h"

namespace plumbline::report
{
  namespace
  {
    using analysis::Event;
    using study::GrowthResults;

    DataChart chart(const std::string &name, const std::string &title, const std::string &x_label,
                    const std::string &y_label, const std::string &caption)
    {
      DataChart result = named(name, title, caption);
      result.plot.x_label = x_label;
      result.plot.y_label = y_label;
      result.plot.is_x_log = result.plot.is_y_log = false;
      return result;
    }

    /// A line with few symbols.
    Line line(const std::string &label, unsigned int style, std::vector<Vertex> points)
    {
      const auto interval = static_cast<unsigned int>(points.size() / 12 + 1);
      return {label, style_of(style, false), 1.8, std::move(points), interval};
    }

    DataChart load_chart(const GrowthResults &results)
    {
      DataChart result =
          chart("load", "Reaction over load", "load", "reaction [force]",
                "Under a load that never falls a break lets the reaction fall at once. Dashed: "
                "the same bonds at loads at which each event would just begin, equilibria that a "
                "load that follows would pass through.");
      std::vector<Vertex> path = {{0, 0}}, critical = {{0, 0}};
      result.data.columns = {"event",    "load",          "reaction before",
                             "reaction", "critical load", "reaction there"};
      std::size_t i = 0;
      for (const Event &e : results.growth.events)
      {
        const double there = e.reaction_before * e.critical / e.load;
        path.push_back({e.load, e.reaction_before});
        path.push_back({e.load, e.reaction});
        critical.push_back({e.critical, there});
        result.data.rows.push_back({count_cell(i++), number_cell(e.load),
                                    number_cell(e.reaction_before), number_cell(e.reaction),
                                    number_cell(e.critical), number_cell(there)});
      }
      Line begins = line("where events begin", 1, std::move(critical));
      begins.style = style_of(1, true);
      begins.width = 1;
      result.plot.lines = {begins, line("load that never falls", 0, std::move(path))};
      return result;
    }

    DataChart energy_chart(const GrowthResults &results)
    {
      DataChart result = chart(
          "energies", "Energy balance", "broken bonds", "energy [force]",
          "Energy balance: the external work is stored, dissipated in broken bonds, or released in "
          "unstable crack growth. The maximum imbalance relative to the work is " +
              rounded(results.largest_imbalance()) +
              (results.rules.is_corrected()
                   ? ", because the surface terms do not derive from an energy."
                   : "."));
      std::vector<Vertex> work, stored, bonds, released;
      result.data.columns = {"event",  "load",     "broken bonds", "work",
                             "stored", "in bonds", "released"};
      std::size_t i = 0, n = 0;
      for (const Event &e : results.growth.events)
      {
        n += e.bonds.size();
        const auto x = static_cast<double>(n);
        work.push_back({x, e.work});
        stored.push_back({x, e.stored});
        bonds.push_back({x, e.in_bonds});
        released.push_back({x, e.released});
        result.data.rows.push_back({count_cell(i++), number_cell(e.load), count_cell(n),
                                    number_cell(e.work), number_cell(e.stored),
                                    number_cell(e.in_bonds), number_cell(e.released)});
      }
      result.plot.lines = {line("work", 0, std::move(work)), line("stored", 1, std::move(stored)),
                           line("in broken bonds", 2, std::move(bonds)),
                           line("released", 3, std::move(released))};
      return result;
    }

    DataChart tip_chart(const GrowthResults &results)
    {
      DataChart result =
          chart("tip", "What load the crack needs", "tip's way from the notch [length]",
                "load at which an event begins",
                "The crack is where next neighbours have separated; its tip the end of these sides "
                "that is farthest from the notch's tip. From column to column the lattice traps "
                "it, and lets it go at a lower load.");
      std::vector<Vertex> points;
      result.data.columns = {"event", "critical load", "load", "tip x", "tip y", "way"};
      double way = 0;
      for (std::size_t i = 0; i < results.growth.events.size(); ++i)
      {
        const Event &e = results.growth.events[i];
        points.push_back({way, e.critical});
        const dealii::Point<2> &tip = results.path.tips[i];
        way = tip.distance(results.notch_tip);
        result.data.rows.push_back({count_cell(i), number_cell(e.critical), number_cell(e.load),
                                    number_cell(results.origin[0] + tip[0]),
                                    number_cell(results.origin[1] + tip[1]), number_cell(way)});
      }
      result.plot.lines = {line("", 0, std::move(points))};
      return result;
    }

    std::string moments_picture(const GrowthResults &results)
    {
      const MapCells cells = cells_of(results.nodes, results.h);
      std::vector<DamageMap> maps;
      for (const study::GrowthMoment &moment : results.moments)
        maps.push_back(map_of("load " + rounded(moment.load) + ", " +
                                  std::to_string(moment.n_events) + " events",
                              results.nodes, moment.damage, cells));
      return damage_script(maps, "moments.svg", "Where bonds are broken", cells);
    }

    Table sides_table(const GrowthResults &results)
    {
      Table table;
      table.columns = {"event", "x0", "y0", "x1", "y1", "joined"};
      const dealii::Point<2> &origin = results.origin;
      for (const study::CrackSide &side : results.path.sides)
        table.rows.push_back(
            {count_cell(side.event), number_cell(origin[0] + side.ends[0][0]),
             number_cell(origin[1] + side.ends[0][1]), number_cell(origin[0] + side.ends[1][0]),
             number_cell(origin[1] + side.ends[1][1]), count_cell(side.is_joined ? 1 : 0)});
      return table;
    }
  } // namespace

  std::vector<DataChart> growth_charts(const GrowthResults &results)
  {
    if (results.growth.events.empty())
      return {};
    std::vector<DataChart> charts = {load_chart(results), energy_chart(results),
                                     tip_chart(results)};
    if (results.spectrum && results.spectrum->variance_kept() > 0)
      charts.push_back(spectrum_chart(*results.spectrum));
    return charts;
  }

  Table growth_events_table(const GrowthResults &results)
  {
    Table table;
    table.columns = {"event",           "critical load", "load",     "bonds",
                     "reaction before", "reaction",      "work",     "stored",
                     "in bonds",        "released",      "residual", "factored"};
    std::size_t i = 0;
    for (const Event &e : results.growth.events)
      table.rows.push_back({count_cell(i++), number_cell(e.critical), number_cell(e.load),
                            count_cell(e.bonds.size()), number_cell(e.reaction_before),
                            number_cell(e.reaction), number_cell(e.work), number_cell(e.stored),
                            number_cell(e.in_bonds), number_cell(e.released),
                            error_cell(e.residual), count_cell(e.is_factored ? 1 : 0)});
    return table;
  }

  void write_growth_pictures(const GrowthResults &results, const std::filesystem::path &dir)
  {
    const std::filesystem::path folder = dir / "grow";
    write_file(folder / "events.csv", to_csv(growth_events_table(results)));
    write_file(folder / "sides.csv", to_csv(sides_table(results)));
    write_charts(growth_charts(results), folder);
    write_file(folder / "moments.gp", moments_picture(results));
    run_gnuplot(folder, "moments.gp", {"moments.svg"});
    sharpen(folder / "moments.svg");
    if (!has_microstructure(results))
      return;
    write_file(folder / "microstructure.gp", microstructure_script(results));
    run_gnuplot(folder, "microstructure.gp", {"microstructure.svg"});
    sharpen(folder / "microstructure.svg");
  }
} // namespace plumbline::report
