#include "geometry/local_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::geometry
{
  Point<2> local_origin(const Box &box)
  {
    constexpr double near = 8; // three binary digits are lost
    double side = 0, farthest = 0;
    for (unsigned int d = 0; d < 2; ++d)
    {
      side = std::max(side, box.upper[d] - box.lower[d]);
      farthest = std::max({farthest, std::abs(box.lower[d]), std::abs(box.upper[d])});
    }
    return std::isfinite(farthest) && farthest > near * side ? box.lower : Point<2>();
  }

  double local_coordinate(double x, double origin)
  {
    if (origin == 0)
      return x;
    // both are rounded by half a unit in the last place at most
    const double unit =
        std::numeric_limits<double>::epsilon() * std::max(std::abs(x), std::abs(origin));
    const double n_decimals = -std::ceil(std::log10(2 * unit));
    // a power of ten that is exact, so that the quotient is the decimal's nearest number
    const double power = std::pow(10., std::abs(n_decimals));
    return n_decimals > 0 ? std::round((x - origin) * power) / power
                          : std::round((x - origin) / power) * power;
  }

  Point<2> local_point(const Point<2> &x, const Point<2> &origin)
  {
    return {local_coordinate(x[0], origin[0]), local_coordinate(x[1], origin[1])};
  }

  void move_to(const Point<2> &origin, std::vector<Point<2>> &points)
  {
    for (Point<2> &x : points)
      x = local_point(x, origin);
  }

  void move_to(const Point<2> &origin, std::vector<Box> &boxes)
  {
    for (Box &box : boxes)
      box = {local_point(box.lower, origin), local_point(box.upper, origin)};
  }
} // namespace plumbline::geometry
