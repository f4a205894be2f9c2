#pragma once

#include "report/formats.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// A number at each node, for a map.
  struct NodeField
  {
    std::string name, title; ///< the name for file columns, the title for people
    std::vector<double> values;
  };

  /// What `plumbline check` found of weights, in words and tables.
  struct CheckPage
  {
    std::string scene_name, purpose;
    std::vector<std::string> facts;      ///< short: how many nodes, which level
    std::vector<std::string> complaints; ///< what is wrong; empty: nothing
    std::vector<std::string> verdicts;   ///< everything else that is said
    std::vector<Part> parts;
    std::vector<std::array<double, 2>> nodes;
    std::vector<NodeField> defects; ///< at the nodes, each in a map on one colour scale
  };

  /// dir/report.html, and dir/maps/defects.svg with its commands for gnuplot.
  /// @throws NumericalError  gnuplot is missing or fails; the page is there and says so
  /// @throws InputError      dir cannot be written
  void write_check_page(const CheckPage &page, const std::filesystem::path &dir);
} // namespace plumbline::report
