#include "report/damage_maps.h"

#include "report/formats.h"
#include "report/maps.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    double largest(const std::vector<double> &values)
    {
      return *std::max_element(values.begin(), values.end());
    }
  } // namespace

  MapCells cells_of(const std::vector<dealii::Point<2>> &nodes, double h)
  {
    MapCells cells{{}, h, {}};
    for (unsigned int d = 0; d < 2; ++d)
    {
      const auto [first, last] = std::minmax_element(
          nodes.begin(), nodes.end(), [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      cells.lower[d] = (*first)[d] - .5 * h;
      cells.n[d] = static_cast<int>(std::lround(((*last)[d] - (*first)[d]) / h)) + 1;
    }
    return cells;
  }

  DamageMap map_of(const std::string &title, const std::vector<dealii::Point<2>> &nodes,
                   const std::vector<double> &values, const MapCells &cells)
  {
    const auto &[lower, h, n] = cells;
    DamageMap map{title, std::vector<double>(static_cast<std::size_t>(n[0]) * n[1],
                                             std::numeric_limits<double>::quiet_NaN())};
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const auto column = std::lround((nodes[i][0] - lower[0]) / h - .5),
                 row = std::lround((nodes[i][1] - lower[1]) / h - .5);
      map.values[static_cast<std::size_t>(row * n[0] + column)] = values[i];
    }
    return map;
  }

  int block_size(const MapCells &cells, int most_columns)
  {
    return (cells.n[0] + most_columns - 1) / most_columns;
  }

  std::string rows_of(const DamageMap &map, const MapCells &cells, int size,
                      const std::function<double(const std::vector<double> &values)> &show)
  {
    const auto &n = cells.n;
    std::ostringstream out;
    for (int j = 0; j < n[1]; j += size)
    {
      for (int i = 0; i < n[0]; i += size)
      {
        std::vector<double> values;
        for (int b = j; b < std::min(n[1], j + size); ++b)
          for (int a = i; a < std::min(n[0], i + size); ++a)
            if (const double value = map.values[static_cast<std::size_t>(b) * n[0] + a];
                !std::isnan(value))
              values.push_back(value);
        out << (i > 0 ? " " : "") << (values.empty() ? "NaN" : rounded(show(values)));
      }
      out << "\n";
    }
    return out.str();
  }

  std::string image_of(const std::string &rows, const MapCells &cells, int size)
  {
    const auto &[lower, h, n] = cells;
    std::ostringstream out;
    out << rows << " matrix using (" << exact(lower[0]) << " + ($1 + .5)*" << exact(size * h)
        << "):(" << exact(lower[1]) << " + ($2 + .5)*" << exact(size * h)
        << "):3 with image notitle";
    return out.str();
  }

  std::string damage_script(const std::vector<DamageMap> &maps, const std::string &file,
                            const std::string &title, const MapCells &cells)
  {
    const auto &[lower, h, n] = cells;
    constexpr int most_columns = 300;
    const SmallMultiples panels(maps.size(), 2, lower, {lower[0] + h * n[0], lower[1] + h * n[1]});
    const int size = block_size(cells, most_columns);
    std::ostringstream out;
    out << "\nreset\n";
    for (std::size_t i = 0; i < maps.size(); ++i)
      out << "$m" << i << " << EOD\n" << rows_of(maps[i], cells, size, largest) << "EOD\n";
    out << panels.begin(file, title, "fraction of a node's bonds [1]")
        << "set palette defined (0 '#ffffff', 1 '#fde0c8', 2 '#f4a268', 4 '#D55E00', 8 "
           "'#3a1a00')\nset cbrange [0:1]\nset cbtics .2\n";
    for (std::size_t i = 0; i < maps.size(); ++i)
      out << panels.panel(i, maps[i].title) << "set ylabel offset 1.5,0\nplot "
          << image_of("$m" + std::to_string(i), cells, size) << "\n"
          << SmallMultiples::next();
    out << SmallMultiples::end();
    return out.str();
  }

  std::string damage_script(const analysis::PointField &field, double h,
                            const std::vector<std::string> &titles, const std::string &file,
                            const std::string &title)
  {
    const MapCells cells = cells_of(field.points, h);
    std::vector<DamageMap> maps;
    for (std::size_t c = 0; c < titles.size(); ++c)
    {
      std::vector<double> values;
      for (std::size_t i = c; i < field.values.size(); i += field.n_components)
        values.push_back(field.values[i]);
      maps.push_back(map_of(titles[c], field.points, values, cells));
    }
    return damage_script(maps, file, title, cells);
  }

  Picture damage_moments(const study::Record &record, const std::string &title,
                         const std::string &caption)
  {
    std::vector<std::string> titles;
    for (const double t : record.curves.at("moments")[0].values)
      titles.push_back("t = " + rounded(t));
    return {"moments", title,
            damage_script(record.fields.at("damage"), record.key.h, titles, "moments.svg", title),
            caption};
  }

  void sharpen(const std::filesystem::path &picture)
  {
    std::ifstream in(picture, std::ios::binary);
    const std::string svg((std::istreambuf_iterator<char>(in)), {});
    write_file(picture, with_sharp_blocks(svg));
  }
} // namespace plumbline::report
