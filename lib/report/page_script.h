#pragma once

#include "report/plot.h"

#include <filesystem>
#include <string>
#include <vector>

// Charts of a page that show values under the pointer and can be zoomed, by dygraphs (MIT licence).
// The static pictures stay: they are what a page shows at first, and what is printed.
namespace plumbline::report
{
  /// Write NAME.json beside the picture NAME.svg of each plot: what the page's script draws.
  void write_chart_data(const std::vector<Plot> &plots, const std::filesystem::path &folder);

  /// The element of a figure for the script; empty if the picture has no such file.
  std::string chart_data(const std::filesystem::path &picture);

  /// The coinciding_lines of a picture, by that file.
  std::string coinciding_lines(const std::filesystem::path &picture);

  /// The page with the script, if any figure has chart_data.
  std::string with_script(std::string page);
} // namespace plumbline::report
