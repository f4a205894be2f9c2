#include "meshfree/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// One bond for each cell of the lattice, the node's own excepted, that meets the ball.
    template <class KernelPoint>
    Bonds from_intersections(const Kernel<2> &kernel, double h, Backend backend,
                             const KernelPoint &kernel_point)
    {
      const geometry::Ball ball{Point<2>(), kernel.horizon()};
      Bonds bonds;
      for_each_offset(kernel.horizon(), h,
                      [&](int k1, int k2)
                      {
                        const auto cell =
                            geometry::square(Point<2>((k1 - .5) * h, (k2 - .5) * h), h);
                        const auto cut = geometry::intersect(ball, geometry::view(cell), backend);
                        // slivers below round-off of the cell are tangencies
                        if (cut.area > 1e-14 * h * h)
                          bonds.family.push_back(
                              {k1, k2, cut.area,
                               kernel_point(Point<2>(k1 * h, k2 * h), cut.centroid), cut.area});
                      });
      return bonds;
    }
  } // namespace

  Bonds partial_area(const Kernel<2> &kernel, double h, Backend backend)
  {
    Bonds bonds = from_intersections(kernel, h, backend,
                                     [](const Point<2> &node, const Point<2> &) { return node; });
    bool is_clipped = false;
    for (const Bond &bond : bonds.family)
      is_clipped = is_clipped || (bond.kernel_point.norm() > kernel.horizon() &&
                                  kernel.radial(bond.kernel_point.norm()) < 0);
    if (is_clipped)
      bonds.notes.push_back("kernel negative at nodes beyond the horizon, clipped at 0");
    return bonds;
  }

  Bonds improved_partial_area(const Kernel<2> &kernel, double h, Backend backend)
  {
    return from_intersections(kernel, h, backend,
                              [](const Point<2> &, const Point<2> &centroid) { return centroid; });
  }
} // namespace plumbline::meshfree
