#include "report/maps.h"

#include "report/plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    // Viridis at equal steps (Smith and van der Walt 2015): lightness grows evenly, so that grey
    // print and colour-blind readers keep the order.
    constexpr const char *palette =
        "0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
        "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725'";

    /// Within this ratio the colour bar needs powers of ten at its ends to be read.
    constexpr double few_decades = 1e3;

    /// The grid of panels, in pixels from the upper left corner.
    struct Layout
    {
      static constexpr double width = 820, left = 74, right = 136, top = 52, bottom = 86;
      static constexpr double column_gap = 24, row_gap = 34, tallest = 380;
      unsigned int n_columns, n_rows;
      double panel_width, panel_height, height;
      double x(std::size_t i) const
      {
        return left + static_cast<double>(i % n_columns) * (panel_width + column_gap);
      }
      double y(std::size_t i) const
      {
        return top + 18 + static_cast<double>(i / n_columns) * (panel_height + row_gap);
      }
      double across(double pixels) const { return pixels / width; }
      double up(double pixels) const { return 1 - pixels / height; }
    };

    Layout layout_of(const std::vector<study::ErrorMap> &maps)
    {
      const auto n = static_cast<unsigned int>(maps.size());
      const study::ErrorMap &first = maps.front();
      const double aspect = (first.upper[1] - first.lower[1]) / (first.upper[0] - first.lower[0]);
      Layout layout{};
      layout.n_columns = n <= 4 ? n : n <= 6 ? 3 : 4;
      layout.n_rows = (n + layout.n_columns - 1) / layout.n_columns;
      const double room = Layout::width - Layout::left - Layout::right -
                          (layout.n_columns - 1) * Layout::column_gap;
      layout.panel_width = room / layout.n_columns;
      layout.panel_height = aspect * layout.panel_width;
      if (layout.panel_height > Layout::tallest)
      {
        layout.panel_height = Layout::tallest;
        layout.panel_width = Layout::tallest / aspect;
      }
      // The colour bar and its label need some height.
      layout.height =
          std::max(360., layout.y(maps.size() - 1) + layout.panel_height + Layout::bottom);
      return layout;
    }

    /// 1, 2 or 5 times a power of ten: two or three steps in the interval.
    double tick_step(double low, double high)
    {
      const double least = (high - low) / 3;
      const double power = std::pow(10., std::floor(std::log10(least)));
      for (const double factor : {1., 2., 5.})
        if (factor * power >= least)
          return factor * power;
      return 10 * power;
    }

    std::string axis(char name, const study::ErrorMap &map, unsigned int d, bool has_figures)
    {
      std::ostringstream out;
      out << "set " << name << "range [" << exact(map.lower[d]) << ":" << exact(map.upper[d])
          << "]\nset " << name << "tics nomirror " << exact(tick_step(map.lower[d], map.upper[d]))
          << "\nset format " << name << " '" << (has_figures ? "%g" : "") << "'\nset " << name
          << "label '" << (has_figures ? std::string(1, name) + " [length]" : "") << "'\n";
      return out.str();
    }

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

    /// One panel; gnuplot counts the blocks of a matrix from 0.
    std::string panel(const study::ErrorMap &map, std::size_t i, std::size_t n,
                      const Layout &layout)
    {
      const bool is_lowest = i + layout.n_columns >= n;
      const double x = layout.x(i), y = layout.y(i);
      const auto centre = [&](unsigned int d, const char *index) {
        return "(" + exact(map.lower[d]) + " + (" + index + " + .5)*" + exact(block(map, d)) + ")";
      };
      std::ostringstream out;
      out << "set lmargin at screen " << layout.across(x) << "\nset rmargin at screen "
          << layout.across(x + layout.panel_width) << "\nset tmargin at screen " << layout.up(y)
          << "\nset bmargin at screen " << layout.up(y + layout.panel_height) << "\n"
          << "set title " << quote_gnuplot(map.method) << " noenhanced font ',12' offset 0,-.7\n"
          << axis('x', map, 0, is_lowest) << axis('y', map, 1, i % layout.n_columns == 0)
          << "plot $m" << i << " matrix using " << centre(0, "$1") << ":" << centre(1, "$2")
          << ":3 with image notitle\nunset label\nunset colorbox\n";
      return out.str();
    }
  } // namespace

  ColourScale colour_scale(const std::vector<study::ErrorMap> &maps)
  {
    double low = 0, high = 0;
    for (const study::ErrorMap &map : maps)
      for (const double value : map.values)
        if (std::isfinite(value) && value > 0)
        {
          low = low > 0 ? std::min(low, value) : value;
          high = std::max(high, value);
        }
    low = std::max(low, high > round_off ? round_off : smallest_drawn_error);
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
    const Layout layout = layout_of(maps);
    const ColourScale scale = colour_scale(maps);
    const int decades = static_cast<int>(std::lround(std::log10(scale.high / scale.low)));
    std::ostringstream out;
    out << "\nreset\n";
    for (std::size_t i = 0; i < maps.size(); ++i)
      out << "$m" << i << " << EOD\n" << data(maps[i], scale) << "EOD\n";
    const double bar_height = std::min(320., layout.height - Layout::top - 18 -
                                                 Layout::bottom); // from the first panel on
    out << "set terminal svg size " << Layout::width << "," << layout.height
        << " dynamic enhanced font 'sans-serif,14' background '#ffffff'\nset output "
        << quote_gnuplot(file) << "\nset multiplot\n"
        << "set border lc rgb '#888888'\nset tics out scale .5 font ',11' textcolor rgb '#222222'\n"
        << "set palette defined (" << palette << ")\nset logscale cb\nset cbrange ["
        << exact(scale.low) << ":" << exact(scale.high) << "]\nset cbtics 1e" << (decades + 7) / 8
        << "\nunset mcbtics\nset format cb '10^{%T}'\nset cblabel "
        << quote_gnuplot("|error of " + maps.front().quantity + "| [unit of the solution]")
        << " noenhanced offset -.4,0 font ',12'\n"
        << "set colorbox user origin screen "
        << layout.across(layout.x(layout.n_columns - 1) + layout.panel_width + 22) << ", screen "
        << layout.up(Layout::top + 18 + bar_height) << " size screen " << layout.across(14)
        << ", screen " << bar_height / layout.height << " noborder\nset label 1 "
        << quote_gnuplot(map_title(maps)) << " at screen " << layout.across(Layout::left)
        << ", screen " << layout.up(22) << " left noenhanced font ',15'\n";
    for (std::size_t i = 0; i < maps.size(); ++i)
      out << panel(maps[i], i, maps.size(), layout);
    out << "unset multiplot\nunset output\n";
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
