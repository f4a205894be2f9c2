#pragma once

#include "geometry/cracks.h"
#include "geometry/search.h"

#include <functional>
#include <optional>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Point;
  using dealii::Tensor;

  /// A straight part of a crack or of a free surface.
  struct Face
  {
    Point<2> first, last; ///< not in one place [length]
  };

  /// The segments of polylines.
  std::vector<Face> faces_of(const std::vector<geometry::Polyline> &lines);

  /// The line where a function changes its sign in a box, by linear interpolation on squares: exact
  /// where the function is linear. A value of 0 counts as negative;
  /// squares with a NaN at a corner have no part of it.
  /// @param step  side of the squares; features that are smaller are lost [length]
  std::vector<Face> zero_line(const std::function<double(const Point<2> &)> &function,
                              const geometry::Box &box, double step);

  /// The faces of a body, and where pair terms can be consistent at them: a face must be straight
  /// over a horizon to both sides.
  class Faces
  {
  public:
    /// @param ends  of cracks in the body
    Faces(std::vector<Face> faces, std::vector<Point<2>> ends, double horizon);

    /// The point of all faces that is nearest to a node.
    struct Foot
    {
      Point<2> place;
      Tensor<1, 2> normal; ///< of its face, of length 1, away from the node
      /// It is closer than the horizon to an end of a crack, or to a face that has turned by more
      /// than 15 degrees: the forces of missing bonds do not balance over the layer there.
      bool is_near_end = false;
    };

    /// @param reach  within which faces are sought
    /// @return       empty: there is none
    std::optional<Foot> foot(const Point<2> &x, double reach) const;

    const std::vector<Point<2>> &ends() const { return ends_; }

  private:
    bool is_near_end(const Point<2> &place, const Tensor<1, 2> &direction) const;

    std::vector<Face> faces_;
    std::vector<Point<2>> ends_;
    double horizon_;
    geometry::BoxSearch<2> search_; ///< over the faces
  };

  /// Ends of open polylines at which no face goes on: the tips.
  /// @param gap  up to which a face in the same direction is its continuation; 0: it must touch
  /// @param is_in_body  of a point
  std::vector<Point<2>> tips_of(const std::vector<geometry::Polyline> &lines,
                                const std::vector<Face> &faces, double horizon, double gap,
                                const std::function<bool(const Point<2> &)> &is_in_body);
} // namespace plumbline::meshfree
