#pragma once

#include "reference/mesh/cell_rules.h"

#include <deal.II/base/quadrature_lib.h>

namespace plumbline::reference
{
  /// A function in each cell, if it has one value there as far as many points tell; else empty.
  template <class Function>
  auto constants_in_cells(const MeshSpace &space, const MeshCells &cells, const Function &at)
  {
    const bool is_triangle = space.shapes().n_vertices() == 3;
    const double third = is_triangle ? 1. / 3 : .5;
    const Point<2> middle(third, third);
    const std::vector<Point<2>> gauss = is_triangle
                                            ? dealii::QWitherdenVincentSimplex<2>(6).get_points()
                                            : dealii::QGauss<2>(6).get_points();
    std::vector<Point<2>> points = {middle};
    points.insert(points.end(), gauss.begin(), gauss.end());
    constexpr double inwards = 1e-3; // a jump may run along sides
    const CellShapes linear(space.shapes().n_vertices(), 1);
    for (const Point<2> &corner : linear.support())
      points.push_back(corner + inwards * (middle - corner));
    std::vector<decltype(at(middle))> values;
    CellRule rule;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      rule.points.clear();
      if (cells.is_curved(cell))
        rule_by_parts(space, cells, cell, 6, rule);
      else
        for (const Point<2> &unit : points)
          rule.points.push_back(space.map(cell).point(unit));
      values.push_back(at(rule.points.front()));
      for (const Point<2> &x : rule.points)
        if (!(at(x) == values.back()))
          return std::vector<decltype(at(middle))>();
    }
    return values;
  }
} // namespace plumbline::reference
