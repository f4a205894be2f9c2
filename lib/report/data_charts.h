#pragma once

#include "report/formats.h"
#include "report/plot.h"
#include "report/selection.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// A picture NAME.svg, and its data NAME.csv beside it.
  struct DataChart
  {
    std::string name, caption;
    Plot plot;
    Table data;
  };

  /// The same style for a method in every chart.
  Style style_of(const std::vector<MethodName> &methods, const std::string &name);

  /// An empty one whose picture is NAME.svg.
  DataChart named(const std::string &name, const std::string &title,
                  const std::string &caption = {});

  /// The same on linear axes.
  DataChart linear_chart(const std::string &name, const std::string &title,
                         const std::string &x_label, const std::string &y_label,
                         const std::string &caption = {});

  /// A line of a meshfree style with few symbols.
  Line long_line(const std::string &label, unsigned int style, std::vector<Vertex> points);

  /// A thin dashed one.
  Line dashed_line(const std::string &label, unsigned int style, std::vector<Vertex> points);

  /// The y-axis from 0, or from below it, to the highest point.
  /// @pre  linear; there are points
  void fit_y(Plot &plot);

  /// Draw them into a folder, in one gnuplot process; charts.gp draws them again.
  /// @throws NumericalError  gnuplot is missing or fails; InputError  the folder cannot be written
  void write_charts(const std::vector<DataChart> &charts, const std::filesystem::path &folder);

  /// Draw pictures, then write the page that shows them. Where they cannot be drawn it is written
  /// all the same and says what is missing, and the error goes on.
  /// @param page  its text, from the pictures that are there
  void write_with_pictures(const std::filesystem::path &file, const std::function<void()> &draw,
                           const std::function<std::string()> &page);
} // namespace plumbline::report
