#include "geometry/periodic_box.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/node_cells.h"

#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    constexpr int digits = 6;

    template <int dim>
    std::string to_text(const Point<dim> &x)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d == 0 ? "(" : ", ") + base::to_text(x[d], digits);
      return text + ")";
    }
  } // namespace

  template <int dim>
  Point<dim> PeriodicBox<dim>::shortest(Point<dim> xi) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] -= side(d) * std::round(xi[d] / side(d));
    return xi;
  }

  template <int dim>
  void PeriodicBox<dim>::take_in(std::vector<Point<dim>> &nodes,
                                 const std::function<std::string(std::size_t)> &name,
                                 const Point<dim> &origin) const
  {
    const auto place = [&](const Point<dim> &x) { return to_text(Point<dim>(origin + x)); };
    constexpr double on_side = 1e-9; // of the side
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= side(d);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double tolerance = on_side * side(d);
        double &x = nodes[k][d];
        if (!(x >= lower[d] - tolerance && x <= upper[d] + tolerance))
          throw InputError(name(k) + " at " + place(nodes[k]) +
                           " lies outside of the periodic box from " + place(lower) + " to " +
                           place(upper) +
                           "; give each node once, inside of the box, and leave out ghost nodes: "
                           "bonds across the sides are bonds to the nodes themselves");
        if (x > upper[d] - tolerance)
          x -= side(d);
      }
    const double size = std::pow(volume / static_cast<double>(nodes.size()), 1. / dim);
    if (const auto twins = find_coincident_nodes(nodes, size))
      throw InputError(name(twins->second) + " is " + name(twins->first) +
                       " or its image on the opposite side of the periodic box; leave one of them "
                       "out");
  }

  template <int dim>
  void PeriodicBox<dim>::check_sides(double horizon, double h) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!(side(d) > 2 * (horizon + h)))
        throw InputError("the periodic box is " + base::to_text(side(d), digits) + " long in " +
                         std::string(1, "xyz"[d]) + ", no more than 2 (horizon + h) = " +
                         base::to_text(2 * (horizon + h), digits) +
                         ", so bonds may reach both a node and its image; give the weights of a "
                         "larger box, or another horizon");
  }

  template struct PeriodicBox<2>;
  template struct PeriodicBox<3>;
} // namespace plumbline::geometry
