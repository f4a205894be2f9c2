#pragma once

#include <cmath>

namespace plumbline::meshfree
{
  /// Area of a disc, volume of a ball [length^dim].
  template <int dim>
  double ball_volume(double radius)
  {
    return dim == 2 ? M_PI * radius * radius : 4. / 3 * M_PI * radius * radius * radius;
  }

  /// The side of a square or cube of that area or volume [length].
  template <int dim>
  double cell_size(double volume)
  {
    return dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
  }

  /// The word for the measure of a cell.
  template <int dim>
  constexpr const char *measure()
  {
    return dim == 2 ? "area" : "volume";
  }
} // namespace plumbline::meshfree
