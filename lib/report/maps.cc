#include "report/maps.h"

#include "report/plot.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    /// Within this ratio the colour bar needs powers of ten at its ends to be read.
    constexpr double few_decades = 1e3;

    /// A row of blocks a line, from the lower left corner; a picture needs no more digits.
    std::string data(const study::ErrorMap &map, const ColourScale &scale)
    {
      std::string text;
      for (unsigned int j = 0; j < map.n_y; ++j)
        for (unsigned int i = 0; i < map.n_x; ++i)
        {
          const double value = map.values[std::size_t{j} * map.n_x + i];
          text += std::isfinite(value) ? rounded_error(std::max(value, scale.low)) : "NaN";
          text += i + 1 < map.n_x ? " " : "\n";
        }
      return text;
    }

    double block(const study::ErrorMap &map, unsigned int d)
    {
      return (map.upper[d] - map.lower[d]) / (d == 0 ? map.n_x : map.n_y);
    }

    /// Of panel i; gnuplot counts the blocks of a matrix from 0.
    std::string plot(const study::ErrorMap &map, std::size_t i)
    {
      const auto centre = [&](unsigned int d, const char *index) {
        return "(" + exact(map.lower[d]) + " + (" + index + " + .5)*" + exact(block(map, d)) + ")";
      };
      return "plot $m" + std::to_string(i) + " matrix using " + centre(0, "$1") + ":" +
             centre(1, "$2") + ":3 with image notitle\n";
    }
  } // namespace

  ColourScale colour_scale(const std::vector<study::ErrorMap> &maps)
  {
    double low = 0, high = 0, size = 0;
    for (const study::ErrorMap &map : maps)
      size = std::max(size, map.size);
    for (const study::ErrorMap &map : maps)
      for (const double value : map.values)
        if (std::isfinite(value) && value > 0)
        {
          low = low > 0 ? std::min(low, value) : value;
          high = std::max(high, value);
        }
    low = std::max(low, size * (high > round_off * size ? round_off : smallest_drawn_error));
    high = std::max(high, 10 * low);
    if (high > few_decades * low)
      return {low, high};
    const double from = std::floor(std::log10(low) + 1e-9);
    return {std::pow(10., from), std::pow(10., std::ceil(std::log10(high) - 1e-9))};
  }

  std::string map_title(const std::vector<study::ErrorMap> &maps)
  {
    const study::ErrorMap &first = maps.front();
    const bool is_same = std::all_of(maps.begin(), maps.end(),
                                     [&](const study::ErrorMap &map) { return map.h == first.h; });
    return first.problem + (first.series.empty() ? "" : ", " + first.series) +
           (is_same ? ", h = " + rounded(first.h) : "") + ": where the error sits";
  }

  std::string map_script(const std::vector<study::ErrorMap> &maps, const std::string &file)
  {
    const std::size_t n = maps.size();
    const SmallMultiples panels(n,
                                n <= 4   ? n
                                : n <= 6 ? 3
                                         : 4,
                                maps.front().lower, maps.front().upper);
    const ColourScale scale = colour_scale(maps);
    const int decades = static_cast<int>(std::lround(std::log10(scale.high / scale.low)));
    std::ostringstream out;
    out << "\nreset\n";
    for (std::size_t i = 0; i < n; ++i)
      out << "$m" << i << " << EOD\n" << data(maps[i], scale) << "EOD\n";
    out << panels.begin(file, map_title(maps),
                        "|error of " + maps.front().quantity + "| [unit of the solution]")
        << "set palette defined (" << viridis << ")\nset logscale cb\nset cbrange ["
        << exact(scale.low) << ":" << exact(scale.high) << "]\nset cbtics 1e" << (decades + 7) / 8
        << "\nunset mcbtics\nset format cb '10^{%T}'\n";
    for (std::size_t i = 0; i < n; ++i)
      out << panels.panel(i, maps[i].method) << plot(maps[i], i) << SmallMultiples::next();
    out << SmallMultiples::end();
    return out.str();
  }

  Table map_table(const std::vector<study::ErrorMap> &maps)
  {
    Table table;
    table.columns = {"method",
                     "problem",
                     "series",
                     "h [length]",
                     "x [length]",
                     "y [length]",
                     "|error of " + maps.front().quantity + "|"};
    for (const study::ErrorMap &map : maps)
      for (unsigned int j = 0; j < map.n_y; ++j)
        for (unsigned int i = 0; i < map.n_x; ++i)
          if (const double value = map.values[std::size_t{j} * map.n_x + i]; std::isfinite(value))
            table.rows.push_back(
                {text_cell(map.method), text_cell(map.problem), text_cell(map.series),
                 number_cell(map.h), number_cell(map.lower[0] + (i + .5) * block(map, 0)),
                 number_cell(map.lower[1] + (j + .5) * block(map, 1)), error_cell(value)});
    return table;
  }

  std::string with_sharp_blocks(std::string svg)
  {
    const std::string from = "<image ", to = "<image style='image-rendering:pixelated' ";
    for (std::size_t at = svg.find(from); at != std::string::npos;
         at = svg.find(from, at + to.size()))
      svg.replace(at, from.size(), to);
    return svg;
  }
} // namespace plumbline::report
