#pragma once

#include "geometry/polygon.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// A box with periodic boundary conditions: opposite sides are identified.
  template <int dim>
  struct PeriodicBox
  {
    Point<dim> lower, upper; ///< [length]

    double side(unsigned int d) const { return upper[d] - lower[d]; }

    /// Whether the nearest image of a node lies across the sides of axis d.
    /// @param xi  from another node to it as they lie in the box [length]
    bool crosses(const Point<dim> &xi, unsigned int d) const
    {
      return 2 * std::abs(xi[d]) > side(d);
    }

    /// The shortest vector from a node to the images of another.
    /// @param xi  from the one to the other as they lie in the box [length]
    Point<dim> shortest(Point<dim> xi) const;

    /// Moves nodes on the upper sides to the lower ones, where their images are.
    /// @param name    of each node, for messages: "node 7"
    /// @param origin  of all coordinates, for messages
    /// @throws InputError  a node outside of the box, two nodes that are images of each other
    void take_in(std::vector<Point<dim>> &nodes,
                 const std::function<std::string(std::size_t)> &name,
                 const Point<dim> &origin = {}) const;

    /// No bond may reach half around the box.
    /// @throws InputError  a side no longer than 2 (horizon + h)
    void check_sides(double horizon, double h) const;
  };
} // namespace plumbline::geometry
