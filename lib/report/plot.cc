#include "report/plot.h"

#include "base/error.h"
#include "report/formats.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char **environ;

namespace plumbline::report
{
  namespace
  {
    const std::array<const char *, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#E69F00", "#56B4E9", "#000000"};

    /// Point types of gnuplot: open, filled.
    constexpr std::array<std::array<int, 2>, 6> point_types = {
        {{6, 7}, {4, 5}, {8, 9}, {12, 13}, {10, 11}, {14, 15}}};

    /// Single quotes: no command or escape inside is carried out.
    std::string quote(const std::string &text)
    {
      std::string result = "'";
      for (const char c : text)
        if (c == '\'')
          result += "''";
        else
          result += c == '\n' || c == '\r' ? ' ' : c;
      return result + "'";
    }

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

    /// Powers of ten, or linear steps; every level of h where there are few.
    std::string axis(char name, const Range &range, bool is_log, const std::vector<double> &ticks)
    {
      std::ostringstream out;
      out << "set " << name << "range [" << exact(range.low) << ":" << exact(range.high) << "]\n";
      if (!ticks.empty())
      {
        std::string list, separator;
        double last = 0;
        for (const double tick : std::set<double>(ticks.begin(), ticks.end()))
        {
          // Labels closer than this would touch.
          const bool is_apart = std::log(tick / (last > 0 ? last : tick / 1e9)) >
                                .075 * std::log(range.high / range.low);
          list += std::exchange(separator, ", ") + quote(is_apart ? rounded(tick) : "") + " " +
                  exact(tick);
          last = is_apart ? tick : last;
        }
        out << "unset m" << name << "tics\nset " << name << "tics nomirror (" << list << ")\n";
      }
      else if (is_log)
      {
        const int decades = static_cast<int>(std::ceil(std::log10(range.high / range.low)));
        const int step = (decades + 7) / 8; // eight figures along an axis are enough
        out << "set " << name << "tics nomirror autofreq 1e" << step << "\nset format " << name
            << " '10^{%T}'\n";
        out << (step == 1 ? "set m" : "unset m") << name << "tics\n";
      }
      else
        out << "set " << name << "tics nomirror autofreq\nset format " << name << " '%g'\nunset m"
            << name << "tics\n";
      return out.str();
    }

    std::size_t n_characters(const std::string &utf8)
    {
      return static_cast<std::size_t>(
          std::count_if(utf8.begin(), utf8.end(),
                        [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
    }

    /// Size, margins and legend: every method has a line of the one column of the legend.
    std::string frame(const Plot &plot)
    {
      // In pixels; a character is this wide on average, a line of the legend this high.
      constexpr double width = 820, character = 7.4, line = 23.5;
      std::size_t longest = 11, n = 1; // "best of all"
      for (const Line &one : plot.lines)
        if (!one.label.empty())
        {
          longest = std::max(longest, n_characters(one.label));
          ++n;
        }
      const double height = std::max(480., 112 + line * static_cast<double>(n));
      const double legend = std::min(.5 * width, 56 + character * static_cast<double>(longest));
      std::ostringstream out;
      out << "set terminal svg size " << width << "," << height
          << " dynamic enhanced font 'sans-serif,14' background '#ffffff'\n"
          << "set lmargin at screen " << 92 / width << "\nset rmargin at screen "
          << 1 - (legend + 14) / width << "\nset bmargin at screen " << 62 / height
          << "\nset tmargin at screen " << 1 - 40 / height << "\nset key at screen "
          << 1 - legend / width << ", screen " << 1 - 36 / height
          << " left top Left reverse samplen 2.4 spacing 1.1 maxcols 1 noenhanced\n";
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

    std::string plot_commands(const Plot &plot)
    {
      std::vector<double> xs, ys;
      for (const Line &line : plot.lines)
        for (const Vertex &v : line.points)
        {
          xs.push_back(v.x);
          ys.push_back(v.y);
        }
      const Range values = {*std::min_element(xs.begin(), xs.end()),
                            *std::max_element(xs.begin(), xs.end())};
      std::vector<double> x_ticks = plot.x_ticks;
      Range x = log_range(xs), y;
      if (!x_ticks.empty())
        x = {values.low / 1.25, values.high * 1.25};
      else if (values.high < narrow * values.low)
      {
        x = {values.low / 1.5, values.high * 1.5};
        x_ticks = one_two_five(x);
      }
      if (plot.is_y_log)
        y = log_range(ys);
      else
        y = {0, 1.12 * std::max(1., *std::max_element(ys.begin(), ys.end()))};

      std::ostringstream out;
      out << "reset\n"
          << frame(plot) << "set output " << quote(plot.file) << "\n"
          << "set logscale x" << (plot.is_y_log ? "y" : "") << "\n"
          << "set border 3 lc rgb '#555555'\nset tics textcolor rgb '#222222'\n"
          << "set grid xtics ytics lt 1 lc rgb '#e4e4e4' lw .8\n"
          << "set title " << quote(plot.title) << " noenhanced\n"
          << "set xlabel " << quote(plot.x_label) << " noenhanced\n"
          << "set ylabel " << quote(plot.y_label) << " noenhanced\n"
          << axis('x', x, true, x_ticks) << axis('y', y, plot.is_y_log, {});

      if (plot.has_slopes)
      {
        std::vector<SlopeTriangle> triangles;
        for (const unsigned int slope : {2, 1})
          if (const auto triangle = place_slope(slope, plot.lines, x, y, triangles))
          {
            triangles.push_back(*triangle);
            out << slope_commands(*triangle, static_cast<unsigned int>(triangles.size()));
          }
      }
      if (plot.shows_round_off && y.low < round_off / 2)
        out << "set object 9 rectangle from graph 0, first " << exact(y.low)
            << " to graph 1, first " << exact(std::min(round_off, y.high))
            << " fillcolor rgb '#f6f6f6' fillstyle solid noborder behind\n"
            << "set label 9 'round-off' at graph .985, first " << exact(std::min(round_off, y.high))
            << " right offset 0,-.7 font ',12' textcolor rgb '#777777'\n";

      std::string separator = "plot ";
      std::ostringstream data, commands;
      unsigned int n = 0;
      const auto block = [&](const std::vector<Vertex> &points)
      {
        data << "$d" << ++n << " << EOD\n";
        for (const Vertex &v : points)
          data << two(v.x, v.y) << "\n";
        data << "EOD\n";
        commands << std::exchange(separator, ", \\\n  ") << "$d" << n << " using 1:2 with ";
      };
      if (plot.frontier.size() > 1)
      {
        block(plot.frontier);
        commands << "lines lc rgb '#dcdcdc' lw 9 title 'best of all'";
      }
      for (const Line &line : plot.lines)
      {
        if (line.points.empty() && line.label.empty())
          continue;
        // A method without a point keeps its line of the legend: gnuplot needs one value to draw
        // it.
        block(line.points.empty() ? std::vector<Vertex>{{x.low / 10, y.low / 10}} : line.points);
        const Style &style = line.style;
        commands << "linespoints lc rgb '" << style.colour << "' lw " << line.width << " pt "
                 << point_types[style.symbol][style.is_dashed ? 0 : 1] << " ps "
                 << (line.width < 1     ? .55
                     : line.width < 1.7 ? .7
                                        : .85)
                 << (style.is_dashed ? " dt (6,4)" : "")
                 << (line.label.empty() ? " notitle" : " title " + quote(line.label));
      }
      return data.str() + out.str() + commands.str() + "\n";
    }
  } // namespace

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

  std::string gnuplot_script(const std::vector<Plot> &plots)
  {
    std::string script = "# Draws the charts of this folder again: gnuplot charts.gp\n"
                         "set encoding utf8\n";
    for (const Plot &plot : plots)
      script += "\n" + plot_commands(plot);
    return script + "unset output\n";
  }

  void run_gnuplot(const std::filesystem::path &folder, const std::string &script)
  {
    const std::filesystem::path log = folder / "gnuplot.log";
    const std::string program = "gnuplot", log_name = log.string(), place = folder.string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, log_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
    posix_spawn_file_actions_addchdir_np(&actions, place.c_str());
    std::array<char *, 3> arguments = {const_cast<char *>(program.c_str()),
                                       const_cast<char *>(script.c_str()), nullptr};
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
      throw NumericalError("charts cannot be drawn, gnuplot does not start (" +
                           std::string(std::strerror(error)) +
                           "); apt-get install gnuplot-nox, then 'plumbline report' on the folder");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    std::ifstream in(log);
    const std::string message((std::istreambuf_iterator<char>(in)), {});
    in.close();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw NumericalError("charts cannot be drawn, gnuplot stopped on '" +
                           (folder / script).string() + "': " + message.substr(0, 400));
    std::filesystem::remove(log);
  }
} // namespace plumbline::report
