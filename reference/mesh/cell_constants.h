#pragma once

#include "reference/mesh/space.h"

#include <deal.II/base/quadrature_lib.h>

namespace plumbline::reference
{
  /// A function in each cell, if it has one value there as far as many points tell; else empty.
  template <class Function>
  auto constants_in_cells(const MeshSpace &space, const Function &at)
  {
    const bool is_triangle = space.shapes().n_vertices() == 3;
    std::vector<Point<2>> points = is_triangle ? dealii::QWitherdenVincentSimplex<2>(6).get_points()
                                               : dealii::QGauss<2>(6).get_points();
    const double third = is_triangle ? 1. / 3 : .5;
    const Point<2> middle(third, third);
    constexpr double inwards = 1e-3; // a jump may run along sides
    const CellShapes linear(space.shapes().n_vertices(), 1);
    for (const Point<2> &corner : linear.support())
      points.push_back(corner + inwards * (middle - corner));
    std::vector<decltype(at(middle))> values;
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
    {
      values.push_back(at(space.map(cell).point(middle)));
      for (const Point<2> &unit : points)
        if (!(at(space.map(cell).point(unit)) == values.back()))
          return std::vector<decltype(at(middle))>();
    }
    return values;
  }
} // namespace plumbline::reference
