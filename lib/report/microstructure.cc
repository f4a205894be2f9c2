#include "report/microstructure.h"

#include "report/damage_maps.h"
#include "report/formats.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using study::GrowthResults;

    using Sides = std::vector<std::array<dealii::Point<2>, 2>>;

    struct Overlay
    {
      std::string name, label, colour;
      Sides sides;
    };

    std::vector<Overlay> overlays_of(const GrowthResults &results)
    {
      Overlay crack{"crack", "the crack", "#D55E00", {}},
          apart{"apart", "separated elsewhere", "#0072B2", {}};
      for (const study::CrackSide &side : results.path.sides)
        (side.is_joined ? crack : apart).sides.push_back(side.ends);
      return {{"notch", "the notch", "#000000", results.path.notch}, crack, apart};
    }

    double mean(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
    }
  } // namespace

  bool has_microstructure(const GrowthResults &results)
  {
    const auto [least, largest] =
        std::minmax_element(results.toughness.begin(), results.toughness.end());
    return least != results.toughness.end() && *least < *largest;
  }

  std::string microstructure_script(const GrowthResults &results)
  {
    constexpr int most_columns = 600; // a pixel each
    const MapCells cells = cells_of(results.nodes, results.h);
    const int size = block_size(cells, most_columns);
    const DamageMap map = map_of("G", results.nodes, results.toughness, cells);
    const auto [least, largest] =
        std::minmax_element(results.toughness.begin(), results.toughness.end());
    const SmallMultiples panels(
        1, 1, cells.lower,
        {cells.lower[0] + cells.h * cells.n[0], cells.lower[1] + cells.h * cells.n[1]});
    std::ostringstream data, plot;
    data << "\nreset\n$G << EOD\n" << rows_of(map, cells, size, mean) << "EOD\n";
    plot << "plot " << image_of("$G", cells, size);
    for (const Overlay &overlay : overlays_of(results))
    {
      if (overlay.sides.empty())
        continue;
      data << "$" << overlay.name << " << EOD\n";
      for (const auto &[from, to] : overlay.sides)
        data << exact(from[0]) << " " << exact(from[1]) << "\n"
             << exact(to[0]) << " " << exact(to[1]) << "\n\n";
      data << "EOD\n";
      plot << ", $" << overlay.name << " with lines lw 2 lc rgb '" << overlay.colour << "' title '"
           << overlay.label << "'";
    }
    const study::GrowthMoment &end = results.moments.back();
    return data.str() +
           panels.begin("microstructure.svg", "The crack in its microstructure",
                        "G [force/length]") +
           "set palette defined (0 '#f2f2f2', 1 '#8c8c8c')\nset cbrange [" + exact(*least) + ":" +
           exact(*largest) +
           "]\nset key at screen .98, screen .97 right top horizontal Left reverse noenhanced font "
           "',12' samplen 2 width -2\n" +
           panels.panel(0, "load " + rounded(end.load) + ", " + std::to_string(end.n_events) +
                               " events") +
           "set ylabel offset 1.5,0\n" + plot.str() + "\n" + SmallMultiples::next() +
           SmallMultiples::end();
  }
} // namespace plumbline::report
