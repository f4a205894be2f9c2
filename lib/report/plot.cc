#include "report/plot.h"

#include "base/number_text.h"
#include "report/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    const std::array<const char *, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#E69F00", "#56B4E9", "#000000"};

    /// Point types of gnuplot: open, filled.
    constexpr std::array<std::array<int, 2>, 6> point_types = {
        {{6, 7}, {4, 5}, {8, 9}, {12, 13}, {10, 11}, {14, 15}}};

    std::string two(double x, double y)
    {
      return exact(x) + " " + exact(y);
    }

    /// Within this ratio powers of ten alone are too few to read an axis by.
    constexpr double narrow = 30;

    /// 1, 2 and 5 times powers of ten.
    std::vector<double> one_two_five(const Range &range)
    {
      std::vector<double> ticks;
      for (double power = std::pow(10., std::floor(std::log10(range.low))); power <= range.high;
           power *= 10)
        for (const double factor : {1., 2., 5.})
          if (factor * power >= range.low && factor * power <= range.high)
            ticks.push_back(factor * power);
      return ticks;
    }

    constexpr int usual_digits = 6;

    /// That figures at linear steps need to differ.
    int digits_of_steps(const Range &range)
    {
      constexpr double n_steps = 10, most = 11;
      const double largest = std::max(std::abs(range.low), std::abs(range.high)),
                   step = (range.high - range.low) / n_steps;
      return std::max(usual_digits, 1 + static_cast<int>(std::clamp(
                                            std::ceil(std::log10(largest / step)), 0., most)));
    }

    /// Width of a text of 14 pixels in a wide font; in a narrower one there is room to spare.
    /// [pixel]
    double width_of(const std::string &utf8)
    {
      constexpr double wide = 10.2, usual = 8.4;
      double width = 0;
      for (const char c : utf8)
        if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) // the first byte of a character
          width += (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? wide : usual;
      return width;
    }

    constexpr double picture_width = 820, widest_left = 140; ///< [pixel]

    double legend_width(const Plot &plot)
    {
      double longest = width_of(plot.frontier_label);
      for (const Line &one : plot.lines)
        longest = std::max(longest, width_of(one.label));
      return std::min(.5 * picture_width, 56 + longest);
    }

    /// Steps of a linear x axis whose figures do not touch: 1, 2 or 5 times a power of ten.
    double step_of_figures(const Range &range, double width)
    {
      constexpr double most = 10, gap = 18;
      const double length = range.high - range.low;
      const int digits = digits_of_steps(range);
      double step = 0;
      for (double power = std::pow(10., std::floor(std::log10(length / most))); step == 0;
           power *= 10)
        for (const double factor : {1., 2., 5.})
        {
          const double one = factor * power;
          double longest = 0;
          for (double tick = std::ceil(range.low / one); tick * one <= range.high; ++tick)
            longest = std::max(longest, width_of(base::to_text(tick * one, digits)));
          if (step == 0 && length / one <= most && (longest + gap) * length / one <= width)
            step = one;
        }
      return step;
    }

    /// Size, margins and legend: every method has a line of the one column of the legend.
    /// @param y_digits  of figures at its steps
    std::string frame(const Plot &plot, int y_digits)
    {
      // In pixels; a line of the legend is this high.
      constexpr double width = picture_width, line = 23.5, figure = 10, left = 100,
                       left_of_many = 114;
      const int n_more = y_digits - usual_digits;
      const auto n = 1 + std::count_if(plot.lines.begin(), plot.lines.end(),
                                       [](const Line &one) { return !one.label.empty(); });
      const double height = std::max(480., 112 + line * static_cast<double>(n));
      const double legend = legend_width(plot);
      std::ostringstream out;
      out << "set terminal svg size " << width << "," << height
          << " dynamic enhanced font 'sans-serif,14' background '#ffffff'\n"
          << "set lmargin at screen "
          << (n_more > 0 ? left_of_many + figure * n_more : left) / width
          << "\nset rmargin at screen " << 1 - (legend + 14) / width << "\nset bmargin at screen "
          << 62 / height << "\nset tmargin at screen " << 1 - 40 / height << "\nset key at screen "
          << 1 - legend / width << ", screen " << 1 - 36 / height
          << " left top Left reverse samplen 2.4 spacing 1.1 maxcols 1 noenhanced\n";
      return out.str();
    }

    /// Powers of ten, or linear steps; every level of h where there are few.
    /// @param width  of a linear axis whose figures are side by side [pixel]; 0: one above another
    std::string axis(char name, const Range &range, bool is_log, const std::vector<double> &ticks,
                     double width)
    {
      std::ostringstream out;
      if (!ticks.empty())
      {
        std::string list, separator, last;
        double last_tick = 0;
        for (const double tick : std::set<double>(ticks.begin(), ticks.end()))
        {
          const std::string label = rounded(tick);
          // Labels closer than this would touch: a character is a sixtieth of the axis wide.
          const double width_of_both = static_cast<double>(last.size() + label.size()) / 2 + 1;
          const bool is_apart =
              last_tick == 0 ||
              std::log(tick / last_tick) * 60 > width_of_both * std::log(range.high / range.low);
          list += std::exchange(separator, ", ") + quote_gnuplot(is_apart ? label : "") + " " +
                  exact(tick);
          if (is_apart)
          {
            last = label;
            last_tick = tick;
          }
        }
        out << "unset m" << name << "tics\nset " << name << "tics nomirror (" << list << ")\n";
      }
      else if (is_log)
      {
        const double first = std::ceil(std::log10(range.low) - 1e-9);
        if (std::pow(10., first) > range.high) // no power of ten inside: one figure in the middle
          return axis(name, range, is_log, {std::sqrt(range.low * range.high)}, width);
        const int decades = static_cast<int>(std::ceil(std::log10(range.high / range.low)));
        const int step = (decades + 7) / 8; // eight figures along an axis are enough
        // From a power of ten inside, so that a strip below the range has no figures.
        out << "set " << name << "tics nomirror 1e" << static_cast<int>(first) << ",1e" << step
            << "," << exact(range.high * (1 + 1e-9)) << "\nset format " << name << " '10^{%T}'\n";
        out << (step == 1 ? "set m" : "unset m") << name << "tics\n";
      }
      else
        out << "set " << name << "tics nomirror "
            << (width > 0 ? exact(step_of_figures(range, width)) : "autofreq") << "\nset format "
            << name << " '%." << digits_of_steps(range) << "g'\nunset m" << name << "tics\n";
      return out.str();
    }

    std::string slope_commands(const SlopeTriangle &t, unsigned int number)
    {
      const auto at = [](double x, double y) { return exact(x) + "," + exact(y); };
      std::ostringstream out;
      out << "set object " << number << " polygon from " << at(t.x0, t.y0) << " to "
          << at(t.x1, t.y0) << " to " << at(t.x1, t.y1) << " to " << at(t.x0, t.y0)
          << " fillcolor rgb '#eeeeee' fillstyle solid border lc rgb '#777777' behind\n"
          << "set label " << 2 * number << " '1' at " << at(std::sqrt(t.x0 * t.x1), t.y0)
          << " center offset 0,-.55 font ',12' textcolor rgb '#555555'\n"
          << "set label " << 2 * number + 1 << " '" << t.slope << "' at "
          << at(t.x1, std::sqrt(t.y0 * t.y1))
          << " left offset .45,0 font ',12' textcolor rgb '#555555'\n";
      return out.str();
    }

    /// The parts of the lines above the strip, between points that are neighbours.
    std::vector<Line> parts_above(const std::vector<Line> &lines, double level)
    {
      std::vector<Line> parts;
      for (const Line &line : lines)
      {
        Line part;
        for (const Vertex &v : line.points)
          if (v.y >= level)
            part.points.push_back(v);
          else
            parts.push_back(std::exchange(part, {}));
        parts.push_back(part);
      }
      return parts;
    }

    Range span(const std::vector<double> &values)
    {
      return {*std::min_element(values.begin(), values.end()),
              *std::max_element(values.begin(), values.end())};
    }

    Range x_range(const std::vector<double> &xs, std::vector<double> &ticks, bool is_log)
    {
      const Range values = span(xs);
      if (!is_log)
        return {values.low, values.high > values.low ? values.high : values.low + 1};
      if (!ticks.empty())
        return {values.low / 1.25, values.high * 1.25};
      if (values.high >= narrow * values.low)
        return log_range(xs);
      const Range x = {values.low / 1.5, values.high * 1.5};
      ticks = one_two_five(x);
      return x;
    }

    std::string strip_commands(const Strip &strip)
    {
      return "set object 9 rectangle from graph 0, first " + exact(strip.range.low) +
             " to graph 1, first " + exact(strip.range.high) +
             " fillcolor rgb '#f3f3f3' fillstyle solid noborder behind\n"
             "set arrow 9 from graph 0, first " +
             exact(strip.range.high) + " to graph 1, first " + exact(strip.range.high) +
             " nohead lc rgb '#aaaaaa' lw .8 back\nset label 9 'round-off' at graph 0, first " +
             exact(std::sqrt(strip.range.low * strip.range.high)) +
             " right offset -.8,0 font ',11' textcolor rgb '#555555'\n";
    }

    /// What a plot shows: ranges of its axes, and its strip of errors of the size of rounding.
    struct View
    {
      Range x, y;
      std::vector<double> x_ticks;
      bool has_strip = false;
      Strip strip;
    };

    View view_of(const Plot &plot)
    {
      std::vector<double> xs, ys;
      for (const Line &line : plot.lines)
        for (const Vertex &v : line.points)
        {
          xs.push_back(v.x);
          ys.push_back(v.y);
        }
      View view;
      view.x_ticks = plot.x_ticks;
      view.x = x_range(xs, view.x_ticks, plot.is_x_log);
      view.has_strip = plot.shows_round_off && plot.is_y_log && span(ys).low < plot.noise &&
                       span(ys).high >= plot.noise;
      if (view.has_strip)
        ys.erase(std::remove_if(ys.begin(), ys.end(), [&](double y) { return y < plot.noise; }),
                 ys.end());
      view.y = plot.is_y_log  ? log_range(ys)
               : plot.y_range ? *plot.y_range
                              : Range{0, 1.12 * std::max(1., span(ys).high)};
      view.strip = view.has_strip ? make_strip(plot.lines, view.y, plot.noise)
                                  : Strip{{}, {view.y.low, view.y.low}};
      return view;
    }

    std::string axes_commands(const Plot &plot, const View &view)
    {
      std::ostringstream out;
      out << (plot.is_x_log ? "set logscale x\n" : "") << (plot.is_y_log ? "set logscale y\n" : "")
          << "set border 3 lc rgb '#555555'\nset tics textcolor rgb '#222222'\n"
          << "set grid xtics ytics lt 1 lc rgb '#e4e4e4' lw .8\n"
          << "set title " << quote_gnuplot(plot.title) << " noenhanced\n"
          << "set xlabel " << quote_gnuplot(plot.x_label) << " noenhanced\n"
          << "set ylabel " << quote_gnuplot(plot.y_label) << " noenhanced\n"
          << "set xrange [" << exact(view.x.low) << ":" << exact(view.x.high) << "]\nset yrange ["
          << exact(view.strip.range.low) << ":" << exact(view.y.high) << "]\n"
          << axis('x', view.x, plot.is_x_log, view.x_ticks,
                  picture_width - widest_left - legend_width(plot))
          << axis('y', view.y, plot.is_y_log, {}, 0);
      return out.str();
    }

    std::string slopes_commands(const Plot &plot, const View &view)
    {
      const std::vector<Line> lines =
          plot.shows_round_off ? parts_above(plot.lines, plot.noise) : plot.lines;
      if (std::none_of(lines.begin(), lines.end(),
                       [](const Line &line) { return line.points.size() > 1; }))
        return "";
      std::vector<SlopeTriangle> triangles;
      std::string text;
      for (const unsigned int slope : {2, 1})
        if (const auto triangle = place_slope(slope, lines, view.x, view.y, triangles))
        {
          triangles.push_back(*triangle);
          text += slope_commands(*triangle, static_cast<unsigned int>(triangles.size()));
        }
      return text;
    }

    /// Curves as commands, and the blocks of data that they name.
    class Curves
    {
    public:
      explicit Curves(const View &view) : view_(view) {}

      void add_frontier(const Plot &plot)
      {
        add(view_.has_strip ? view_.strip.cut(plot.frontier) : plot.frontier, false);
        commands_ << "lines lc rgb '#dcdcdc' lw 9 title " << quote_gnuplot(plot.frontier_label);
      }

      void add_bars(const Line &line)
      {
        data_ << "$d" << ++n_ << " << EOD\n";
        for (std::size_t i = 0; i < line.bars.size(); ++i)
          if (line.bars[i] > 0)
            data_ << two(line.points[i].x, line.points[i].y) << " " << exact(line.bars[i]) << "\n";
        data_ << "EOD\n";
        next() << " using 1:2:3 with yerrorbars lc rgb '" << line.style.colour
               << "' lw 1.2 pt 0 notitle";
      }

      void add_line(const Line &line)
      {
        const Style &style = line.style;
        // A method without a point keeps its line of the legend: gnuplot needs one value to draw
        // it.
        add(line.points.empty() ? std::vector<Vertex>{{view_.x.low / 10, view_.y.high * 10}}
            : view_.has_strip   ? view_.strip.enter(line)
                                : line.points,
            view_.has_strip);
        commands_ << "linespoints lc rgb '" << style.colour << "' lw " << line.width << " pt "
                  << point_types[style.symbol][style.is_dashed ? 0 : 1] << " ps " << .85
                  << (style.is_dashed ? " dt (6,4)" : "")
                  << (line.symbol_interval > 1 ? " pi " + std::to_string(line.symbol_interval) : "")
                  << (line.label.empty() ? " notitle" : " title " + quote_gnuplot(line.label));
      }

      std::string data() const { return data_.str(); }
      std::string commands() const { return commands_.str() + "\n"; }

    private:
      /// Begin the curve of the last block.
      std::ostream &next()
      {
        return commands_ << std::exchange(separator_, ", \\\n  ") << "$d" << n_;
      }

      void add(const std::vector<Vertex> &points, bool has_gap)
      {
        data_ << "$d" << ++n_ << " << EOD\n";
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          // An empty line interrupts: the way into the strip has no slope.
          if (has_gap && i > 0 && (points[i].y < view_.y.low) != (points[i - 1].y < view_.y.low))
            data_ << "\n";
          data_ << two(points[i].x, points[i].y) << "\n";
        }
        data_ << "EOD\n";
        next() << " using 1:2 with ";
      }

      const View &view_;
      std::ostringstream data_, commands_;
      std::string separator_ = "plot ";
      unsigned int n_ = 0;
    };

    /// Whether two lines lie on each other in a picture: at the same places, nowhere further apart
    /// than the lines are wide.
    bool coincide(const Line &a, const Line &b, bool is_log, const Range &y)
    {
      constexpr double part = .004; // of the axis
      const auto place = [&](double value)
      { return is_log ? std::log(std::max(value, y.low)) : value; };
      const double width = part * (place(y.high) - place(y.low));
      return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                        [&](const Vertex &v, const Vertex &w)
                        { return v.x == w.x && std::abs(place(v.y) - place(w.y)) <= width; });
    }

    std::string plot_commands(const Plot &plot)
    {
      const View view = view_of(plot);
      Curves curves(view);
      if (plot.frontier.size() > 1)
        curves.add_frontier(plot);
      for (const Line &line : plot.lines)
      {
        if (line.points.empty() && line.label.empty())
          continue;
        if (!line.bars.empty()) // below the symbols
          curves.add_bars(line);
        curves.add_line(line);
      }
      return curves.data() + "reset\n" +
             frame(plot, plot.is_y_log ? usual_digits : digits_of_steps(view.y)) + "set output " +
             quote_gnuplot(plot.file) + "\n" + axes_commands(plot, view) +
             (plot.has_slopes ? slopes_commands(plot, view) : "") +
             (view.has_strip ? strip_commands(view.strip) : "") + curves.commands();
    }
  } // namespace

  std::string coinciding_lines(const Plot &plot)
  {
    if (std::all_of(plot.lines.begin(), plot.lines.end(),
                    [](const Line &line) { return line.points.empty(); }))
      return "";
    const View view = view_of(plot);
    std::vector<std::pair<const Line *, std::string>> groups; // the first of each, and all labels
    for (const Line &line : plot.lines)
    {
      const bool is_seen = std::any_of(line.points.begin(), line.points.end(),
                                       [&](const Vertex &v) { return v.y >= view.y.low; });
      if (line.label.empty() || line.points.size() < 2 || !is_seen)
        continue;
      const auto same = std::find_if(
          groups.begin(), groups.end(),
          [&](const auto &group) { return coincide(*group.first, line, plot.is_y_log, view.y); });
      if (same == groups.end())
        groups.emplace_back(&line, line.label);
      else
        same->second += " = " + line.label;
    }
    std::string text;
    for (const auto &[first, labels] : groups)
      if (labels != first->label)
        text += (text.empty() ? "" : "; ") + labels;
    return text;
  }

  Style style_of(unsigned int i, bool is_reference)
  {
    const unsigned int n = colours.size();
    // References count from black backwards, so that the first few differ in colour as well.
    return {colours[is_reference ? n - 1 - i % n : i % n],
            static_cast<unsigned int>(i % point_types.size()), is_reference};
  }

  Range log_range(const std::vector<double> &values)
  {
    const double low = std::log10(*std::min_element(values.begin(), values.end()));
    const double high = std::log10(*std::max_element(values.begin(), values.end()));
    const double margin = std::max(.05 * (high - low), .05);
    double from = low - margin, to = high + margin;
    const auto n_powers = [&] { return std::floor(to) - std::ceil(from) + 1; };
    // A power of ten close outside is taken in, and both if there were fewer than two.
    const double reach = .3 * (high - low);
    if (n_powers() < 2 || from - std::floor(from) < reach)
      from = std::floor(from);
    if (n_powers() < 2 || std::ceil(to) - to < reach)
      to = std::ceil(to);
    return {std::pow(10., from), std::pow(10., to)};
  }

  std::string quote_gnuplot(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      if (c == '\'')
        result += "''";
      else
        result += c == '\n' || c == '\r' ? ' ' : c;
    return result + "'";
  }

  std::string gnuplot_script(const std::vector<Plot> &plots)
  {
    std::string script = "# Draws the charts of this folder again: gnuplot charts.gp\n"
                         "set encoding utf8\n";
    for (const Plot &plot : plots)
      script += "\n" + plot_commands(plot);
    return script + "unset output\n";
  }
} // namespace plumbline::report
