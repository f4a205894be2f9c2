#include "subcells/rule.h"

namespace subcells
{
  namespace
  {
    using namespace plumbline;
    using dealii::Point;

    /// On the right of no side.
    bool is_in(const geometry::ConvexCell &cell, const Point<2> &x)
    {
      const auto vertices = cell.vertices();
      for (std::size_t v = 0; v < vertices.size(); ++v)
      {
        const auto side = vertices[(v + 1) % vertices.size()] - vertices[v], to = x - vertices[v];
        if (side[0] * to[1] - side[1] * to[0] < 0)
          return false;
      }
      return true;
    }

    meshfree::Bond<2> bond(const physics::Kernel<2> &kernel,
                           const meshfree::Candidate<2> &candidate)
    {
      constexpr int n = 8;
      unsigned int n_all = 0, n_inside = 0;
      Point<2> sum;
      for (const geometry::ConvexCell &piece : candidate.pieces)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
          {
            const geometry::Box &box = piece.box();
            const Point<2> x(box.lower[0] + (box.upper[0] - box.lower[0]) * (i + .5) / n,
                             box.lower[1] + (box.upper[1] - box.lower[1]) * (j + .5) / n);
            if (!is_in(piece, x))
              continue;
            ++n_all;
            if (x.distance(candidate.ball.centre) > kernel.horizon())
              continue;
            ++n_inside;
            sum += x - candidate.ball.centre;
          }
      if (n_inside == 0)
        return {candidate.xi, 0, candidate.xi, 0};
      const double area = candidate.area * n_inside / n_all;
      return {candidate.xi, area, sum / n_inside, area};
    }
  } // namespace

  meshfree::NeighbourhoodQuadrature<2> rule(const physics::Kernel<2> &)
  {
    return {bond};
  }
} // namespace subcells
