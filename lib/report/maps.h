#pragma once

#include "report/formats.h"
#include "report/selection.h"
#include "study/results.h"

#include <string>
#include <vector>

namespace plumbline::report
{
  /// Errors of solutions of size one below this are drawn like it: they are rounded to as much.
  constexpr double smallest_drawn_error = 1e-16;

  /// Of a problem on intervals: values along x.
  bool is_curve(const study::ErrorMap &map);

  /// Those with the same axes, which are drawn together; in the order of the first of each.
  std::vector<std::vector<study::ErrorMap>> maps_by_axes(const std::vector<study::ErrorMap> &maps);

  /// Of the colours of all maps together: from the smallest positive value, though not below
  /// round-off if anything is above that, to the largest; at least one decade, and whole ones if
  /// there are few. What lies below, zero too, has the colour of the lower end.
  struct ColourScale
  {
    double low = smallest_drawn_error, high = 10 * smallest_drawn_error;
  };
  ColourScale colour_scale(const std::vector<study::ErrorMap> &maps);

  /// "case1, m = 3, h = 0.05: ..."; without h if the maps differ in it.
  std::string map_title(const std::vector<study::ErrorMap> &maps);

  /// The commands that draw maps with the same axes into one picture, side by side on one colour
  /// scale; errors along a line as curves.
  /// @param methods  with their families, for the styles of curves
  /// @pre  at least one map
  std::string map_script(const std::vector<study::ErrorMap> &maps, const std::string &file,
                         const std::vector<MethodName> &methods = {});

  /// The solution of a map: of the first Galerkin method that has one, or else of the method with
  /// the smallest error; nullptr if none has one.
  /// @param methods  with their families
  const study::ErrorMap *solution_map(const std::vector<study::ErrorMap> &maps,
                                      const std::vector<MethodName> &methods);

  /// "case1, m = 3, h = 0.05: solution computed with Q1".
  std::string solution_title(const study::ErrorMap &map);

  /// The commands that draw the solution of a map on a linear scale of colours, or as a curve.
  /// @param methods  as of map_script()
  /// @pre  it has a solution
  std::string solution_script(const study::ErrorMap &map, const std::string &file,
                              const std::vector<MethodName> &methods = {});

  /// One row for each block inside the domain, at its centre: the solution there.
  Table solution_table(const study::ErrorMap &map);

  /// One row for each block inside the domain, at its centre.
  Table map_table(const std::vector<study::ErrorMap> &maps);

  /// The blocks of a heat map with sharp edges: a viewer that smooths would show errors where there
  /// are none, and hide the edge of the domain.
  std::string with_sharp_blocks(std::string svg);
} // namespace plumbline::report
