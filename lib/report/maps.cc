#include "report/maps.h"

#include "report/data_charts.h"
#include "report/plot.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    /// Within this ratio the colour bar needs powers of ten at its ends to be read.
    constexpr double few_decades = 1e3;

    /// A row of blocks a line, from the lower left corner; a picture needs no more digits.
    /// @param least  smaller values are drawn like it
    std::string data(const study::ErrorMap &map, const std::vector<double> &values, double least)
    {
      std::string text;
      for (unsigned int j = 0; j < map.n_y; ++j)
        for (unsigned int i = 0; i < map.n_x; ++i)
        {
          const double value = values[std::size_t{j} * map.n_x + i];
          text += std::isfinite(value) ? rounded_error(std::max(value, least)) : "NaN";
          text += i + 1 < map.n_x ? " " : "\n";
        }
      return text;
    }

    /// Of the finite ones.
    Range range_of(const std::vector<double> &values)
    {
      Range range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
      for (const double value : values)
        if (std::isfinite(value))
          range = {std::min(range.low, value), std::max(range.high, value)};
      return range;
    }

    bool has_solution(const study::ErrorMap &map)
    {
      const Range range = range_of(map.solution);
      return range.low <= range.high;
    }

    /// What the solution of a map is called.
    std::string symbol(const study::ErrorMap &map)
    {
      return map.n_components == 1 ? "u" : "|u|";
    }

    std::string place(const study::ErrorMap &map)
    {
      return map.problem + (map.series.empty() ? "" : ", " + map.series);
    }

    std::string colours(double low, double high)
    {
      return std::string("set palette defined (") + viridis + ")\nset cbrange [" + exact(low) +
             ":" + exact(high) + "]\n";
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

    /// What is drawn of maps along x.
    struct Curves
    {
      std::vector<double> study::ErrorMap::*values;
      bool is_log = false; ///< the axis; zeros are not drawn then
    };

    /// A line for each interval, the first of them in the legend.
    void add_curve(const study::ErrorMap &map, const Curves &curves, const Style &style,
                   std::vector<Line> &lines)
    {
      constexpr unsigned int n_symbols = 12;
      const std::vector<double> &values = map.*curves.values;
      bool is_going_on = false;
      for (unsigned int i = 0; i < map.n_x; ++i)
      {
        if (!std::isfinite(values[i]) || (curves.is_log && values[i] <= 0))
        {
          is_going_on = false;
          continue;
        }
        if (!is_going_on)
        {
          const bool is_first = lines.empty() || lines.back().style.colour != style.colour ||
                                lines.back().style.symbol != style.symbol ||
                                lines.back().style.is_dashed != style.is_dashed;
          lines.push_back({is_first ? map.method : "", style, 1.8, {}});
          lines.back().symbol_interval = std::max(1u, map.n_x / n_symbols);
        }
        is_going_on = true;
        lines.back().points.push_back({map.lower[0] + (i + .5) * block(map, 0), values[i]});
      }
    }

    /// Lines along x, without the ordinate's name.
    Plot curve_plot(const std::vector<study::ErrorMap> &maps, const std::string &file,
                    const Curves &curves, const std::vector<MethodName> &methods)
    {
      Plot plot;
      plot.file = file;
      plot.x_label = "x [length]";
      plot.is_x_log = false;
      plot.is_y_log = curves.is_log;
      for (const study::ErrorMap &map : maps)
        add_curve(map, curves, style_of(methods, map.method), plot.lines);
      return plot;
    }

    /// @param values  of the map's blocks
    void add_rows(const study::ErrorMap &map, const std::vector<double> &values,
                  Cell (*cell)(double), Table &table)
    {
      for (unsigned int j = 0; j < map.n_y; ++j)
        for (unsigned int i = 0; i < map.n_x; ++i)
          if (const double value = values[std::size_t{j} * map.n_x + i]; std::isfinite(value))
            table.rows.push_back(
                {text_cell(map.method), text_cell(map.problem), text_cell(map.series),
                 number_cell(map.h), number_cell(map.lower[0] + (i + .5) * block(map, 0)),
                 number_cell(map.lower[1] + (j + .5) * block(map, 1)), cell(value)});
    }

    /// Of maps with the same axes.
    Table table_with(const std::string &axes, const std::string &value)
    {
      Table table;
      table.columns = {"method", "problem", "series", "h [length]"};
      for (const char axis : axes)
        table.columns.push_back(axis + std::string(" [length]"));
      table.columns.push_back(value);
      return table;
    }
  } // namespace

  bool is_curve(const study::ErrorMap &map)
  {
    return map.n_y == 1 && map.lower[1] == map.upper[1];
  }

  std::vector<std::vector<study::ErrorMap>> maps_by_axes(const std::vector<study::ErrorMap> &maps)
  {
    std::vector<std::vector<study::ErrorMap>> groups;
    for (const study::ErrorMap &map : maps)
    {
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const std::vector<study::ErrorMap> &one)
                                { return one.front().axes == map.axes; });
      if (group == groups.end())
        group = groups.insert(groups.end(), std::vector<study::ErrorMap>());
      group->push_back(map);
    }
    return groups;
  }

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
    if (high == 0) // no error anywhere: any colours do
      return {smallest_drawn_error, 1};
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
    return place(first) + (is_same ? ", h = " + rounded(first.h) : "") + ": where the error sits";
  }

  std::string map_script(const std::vector<study::ErrorMap> &maps, const std::string &file,
                         const std::vector<MethodName> &methods)
  {
    const std::size_t n = maps.size();
    if (is_curve(maps.front()))
    {
      const bool has_errors = std::any_of( // a method that is the reference has none
          maps.begin(), maps.end(),
          [](const study::ErrorMap &map) { return range_of(map.values).high > 0; });
      Plot plot = curve_plot(maps, file, {&study::ErrorMap::values, has_errors}, methods);
      plot.title = map_title(maps);
      plot.y_label = "|error of " + maps.front().quantity + "| [unit of the solution]";
      return gnuplot_script({plot});
    }
    const SmallMultiples panels(n,
                                n <= 4   ? n
                                : n <= 6 ? 3
                                         : 4,
                                maps.front().lower, maps.front().upper, maps.front().axes);
    const ColourScale scale = colour_scale(maps);
    const int decades = static_cast<int>(std::lround(std::log10(scale.high / scale.low)));
    std::ostringstream out;
    out << "\nreset\n";
    for (std::size_t i = 0; i < n; ++i)
      out << "$m" << i << " << EOD\n" << data(maps[i], maps[i].values, scale.low) << "EOD\n";
    out << panels.begin(file, map_title(maps),
                        "|error of " + maps.front().quantity + "| [unit of the solution]")
        << "set logscale cb\n"
        << colours(scale.low, scale.high) << "set cbtics 1e" << (decades + 7) / 8
        << "\nunset mcbtics\nset format cb '10^{%T}'\n";
    for (std::size_t i = 0; i < n; ++i)
      out << panels.panel(i, maps[i].method) << plot(maps[i], i) << SmallMultiples::next();
    out << SmallMultiples::end();
    return out.str();
  }

  const study::ErrorMap *solution_map(const std::vector<study::ErrorMap> &maps,
                                      const std::vector<MethodName> &methods)
  {
    const study::ErrorMap *best = nullptr;
    for (const study::ErrorMap &map : maps)
    {
      if (!has_solution(map))
        continue;
      if (std::any_of(methods.begin(), methods.end(),
                      [&](const MethodName &method)
                      { return method.name == map.method && method.is_reference(); }))
        return &map;
      if (best == nullptr || range_of(map.values).high < range_of(best->values).high)
        best = &map;
    }
    return best;
  }

  std::string solution_title(const study::ErrorMap &map)
  {
    return place(map) + ", h = " + rounded(map.h) + ": solution computed with " + map.method;
  }

  std::string solution_script(const study::ErrorMap &map, const std::string &file,
                              const std::vector<MethodName> &methods)
  {
    if (is_curve(map))
    {
      const Range along = range_of(map.solution);
      const double margin = along.high > along.low ? .05 * (along.high - along.low) : .5;
      Plot plot = curve_plot({map}, file, {&study::ErrorMap::solution}, methods);
      plot.title = solution_title(map);
      plot.y_label = symbol(map) + " [unit of the solution]";
      plot.y_range = Range{along.low - margin, along.high + margin};
      return gnuplot_script({plot});
    }
    const SmallMultiples panels(1, 1, map.lower, map.upper, map.axes);
    const Range range = range_of(map.solution);
    const double high = range.high > range.low ? range.high : range.low + 1;
    std::ostringstream out;
    out << "\nreset\n$m0 << EOD\n"
        << data(map, map.solution, range.low) << "EOD\n"
        << panels.begin(file, solution_title(map), symbol(map) + " [unit of the solution]")
        << colours(range.low, high) << panels.panel(0, map.quantity) << plot(map, 0)
        << SmallMultiples::next() << SmallMultiples::end();
    return out.str();
  }

  Table solution_table(const study::ErrorMap &map)
  {
    Table table = table_with(map.axes, symbol(map));
    add_rows(map, map.solution, number_cell, table);
    return table;
  }

  Table map_table(const std::vector<study::ErrorMap> &maps)
  {
    Table table = table_with(maps.front().axes, "|error of " + maps.front().quantity + "|");
    for (const study::ErrorMap &map : maps)
      add_rows(map, map.values, error_cell, table);
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
