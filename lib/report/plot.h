#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// How a method looks in every chart: meshfree solid with filled symbols, reference dashed with
  /// open ones.
  struct Style
  {
    std::string colour; ///< "#rrggbb"
    unsigned int symbol =
        0; ///< 0 circle, 1 square, 2 triangle, 3 diamond, 4 triangle down, 5 pentagon
    bool is_dashed = false;
  };

  /// The style of the i-th method of its family. Colours by Okabe and Ito without yellow, which
  /// is faint on white; 42 methods of a family look different.
  Style style_of(unsigned int i, bool is_reference);

  struct Vertex
  {
    double x = 0, y = 0;
  };

  struct Range
  {
    double low = 0, high = 0;
  };

  struct Line
  {
    std::string label; ///< empty: not in the legend
    Style style;
    double width = 1.8;
    std::vector<Vertex> points;       ///< positive on logarithmic axes
    unsigned int symbol_interval = 1; ///< every so many points one has a symbol
    std::vector<double> bars =
        {}; ///< how far error bars reach up and down from the points, or empty
  };

  /// Errors of fields of size one below this are drawn as round-off; a fixed value, while
  /// lib/study/trend.cc judges by the round-off estimated for each run.
  constexpr double round_off = 1e-10;

  struct Plot
  {
    std::string file; ///< name of the picture, without folder
    std::string title, x_label, y_label;
    bool is_y_log = true, is_x_log = true;
    bool has_slopes = false;      ///< triangles of slopes, if a line has two points above noise
    bool shows_round_off = false; ///< what is smaller than that goes into a strip, see Strip
    double noise = round_off;     ///< the same of fields of the size of these
    std::vector<double> x_ticks;  ///< empty: powers of ten
    std::optional<Range> y_range; ///< of a linear axis; empty: from 0
    std::vector<Vertex> frontier; ///< drawn broad and grey behind the lines
    std::string frontier_label = "best among methods that do not stall";
    std::vector<Line> lines; ///< at least one point in all
  };

  /// A strip below a logarithmic axis for errors of the size of rounding, beside others that are
  /// not. How small they are says nothing, and over the decades between the others would lie flat.
  struct Strip
  {
    std::vector<Style> rows;  ///< from above, one for each method that has such errors
    Range range;              ///< of y, high is where the axis ends
    double noise = round_off; ///< as of the plot

    /// The line with its errors below round-off moved into its row.
    std::vector<Vertex> enter(const Line &line) const;

    /// The line with its errors below round-off moved through the whole strip, straight down.
    std::vector<Vertex> cut(const std::vector<Vertex> &points) const;
  };
  Strip make_strip(const std::vector<Line> &lines, const Range &y, double noise = round_off);

  /// Of a logarithmic axis: the values with a margin, and two powers of ten at least.
  Range log_range(const std::vector<double> &values);

  /// The right-angled triangle of slope p: (x0, y0), (x1, y0), (x1, y1) with y1 = y0 (x1/x0)^p.
  struct SlopeTriangle
  {
    unsigned int slope = 0;
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  };

  /// A place that no line and none of the triangles in `taken` touches, near a line of that slope
  /// if there is one; nothing if there is no such place or the triangle would be too flat to read.
  std::optional<SlopeTriangle> place_slope(unsigned int slope, const std::vector<Line> &lines,
                                           const Range &x, const Range &y,
                                           const std::vector<SlopeTriangle> &taken);

  /// A text as gnuplot takes it, in single quotes: no command or escape inside is carried out.
  std::string quote_gnuplot(const std::string &text);

  /// Labels of the lines that hide each other: "FA = PA-AC; Q1 = DGQ1"; empty if none do. Lines of
  /// round-off alone have rows of their own.
  std::string coinciding_lines(const Plot &plot);

  /// The commands that draw all plots, each to its own file.
  std::string gnuplot_script(const std::vector<Plot> &plots);

  /// Run gnuplot once, inside the folder, on a script that lies there.
  /// @throws NumericalError  gnuplot is missing, or does not accept the script
  /// @param pictures  that it is to draw; what is not whole is taken away
  void run_gnuplot(const std::filesystem::path &folder, const std::string &script,
                   const std::vector<std::string> &pictures);
} // namespace plumbline::report
