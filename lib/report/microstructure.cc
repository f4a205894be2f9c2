#include "report/microstructure.h"

#include "report/damage_maps.h"
#include "report/formats.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using analysis::Curve;
    using analysis::Record;

    using Sides = std::vector<std::array<dealii::Point<2>, 2>>;

    struct Overlay
    {
      std::string name, label, colour;
      Sides sides;
    };

    /// @param first  column of the first coordinate of four
    std::array<dealii::Point<2>, 2> side_of(const Curve &curve, std::size_t first, std::size_t row)
    {
      const auto at = [&](std::size_t column) { return curve[first + column].values[row]; };
      return {{{at(0), at(1)}, {at(2), at(3)}}};
    }

    std::vector<Overlay> overlays_of(const Record &record)
    {
      Overlay cut{"notch", "the notch", "#000000", {}}, crack{"crack", "the crack", "#D55E00", {}},
          apart{"apart", "separated elsewhere", "#0072B2", {}};
      const Curve &notch = record.curves.at("notch"), &sides = record.curves.at("sides");
      for (std::size_t i = 0; i < notch.front().values.size(); ++i)
        cut.sides.push_back(side_of(notch, 0, i));
      const std::vector<double> &is_joined = sides.back().values;
      for (std::size_t i = 0; i < is_joined.size(); ++i)
        (is_joined[i] > 0 ? crack : apart).sides.push_back(side_of(sides, 1, i));
      return {cut, crack, apart};
    }

    double mean(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
    }
  } // namespace

  bool has_microstructure(const Record &record)
  {
    return record.fields.count("G") > 0;
  }

  std::string microstructure_script(const Record &record)
  {
    constexpr int most_columns = 600; // a pixel each
    const analysis::PointField &field = record.fields.at("G");
    const MapCells cells = cells_of(field.points, record.key.h);
    const int size = block_size(cells, most_columns);
    const DamageMap map = map_of("G", field.points, field.values, cells);
    const auto [least, largest] = std::minmax_element(field.values.begin(), field.values.end());
    const SmallMultiples panels(
        1, 1, cells.lower,
        {cells.lower[0] + cells.h * cells.n[0], cells.lower[1] + cells.h * cells.n[1]});
    std::ostringstream data, plot;
    data << "\nreset\n$G << EOD\n" << rows_of(map, cells, size, mean) << "EOD\n";
    plot << "plot " << image_of("$G", cells, size);
    for (const Overlay &overlay : overlays_of(record))
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
    const Curve &moments = record.curves.at("moments");
    return data.str() +
           panels.begin("microstructure.svg", "The crack in its microstructure",
                        "G [force/length]") +
           "set palette defined (0 '#f2f2f2', 1 '#8c8c8c')\nset cbrange [" + exact(*least) + ":" +
           exact(*largest) +
           "]\nset key at screen .98, screen .97 right top horizontal Left reverse noenhanced font "
           "',12' samplen 2 width -2\n" +
           panels.panel(0, "load " + rounded(moments[1].values.back()) + ", " +
                               rounded(moments[0].values.back()) + " events") +
           "set ylabel offset 1.5,0\n" + plot.str() + "\n" + SmallMultiples::next() +
           SmallMultiples::end();
  }
} // namespace plumbline::report
