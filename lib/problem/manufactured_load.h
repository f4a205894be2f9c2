#pragma once

#include "problem/problem.h"

namespace plumbline::problem
{
  /// Where Ω is: its bounding box, whether it fills it, and some points of it.
  struct Extent
  {
    geometry::Box box;
    bool is_rectangle = false;
    double h = 0; ///< of the level: fields are looked at once a cell [length]
    std::vector<dealii::Point<2>> samples;
  };

  Extent extent(const Problem<2> &problem);

  /// The series of a field that is smooth on a box. It is held against the field at one point in
  /// each h of both axes, 100 to 2000 of them along an axis: what is wider than 2 h and 2 % of the
  /// box (of boxes with more than 2000 h: .1 %) along both axes is seen.
  /// @param most  terms along an axis
  std::optional<physics::ChebyshevField> series_of(const physics::ChebyshevField::Function &value,
                                                   unsigned int n_components,
                                                   const geometry::Box &box, const Extent &extent,
                                                   double noise, unsigned int most = 129);

  /// The load of the problem's solution, -F(u) or L u; by series where it is smooth, on panels if
  /// need be (physics::Panels).
  /// @pre  problem.solution
  Field<2> manufactured_load(const Problem<2> &problem, const Extent &extent);

  /// The same without any series, for a few places.
  /// @throws NumericalError  when called, as physics::ManufacturedLoad
  physics::ChebyshevField::Function plain_load(const Problem<2> &problem);
} // namespace plumbline::problem
