#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// Slivers below round-off of the cell are tangencies.
    constexpr double sliver = 1e-14;
  } // namespace

  Bond centroid_bond(const Kernel<2> &, const Candidate &candidate)
  {
    double area = 0;
    Point<2> first;
    for (const geometry::ConvexCell &piece : candidate.pieces)
    {
      const auto cut = geometry::intersect(candidate.ball, piece, candidate.backend);
      area += cut.area;
      first += cut.area * (cut.centroid - candidate.ball.centre);
    }
    if (area <= sliver * candidate.area)
      return {candidate.xi, 0, candidate.xi, 0};
    return {candidate.xi, area, first / area, area};
  }

  Bond partial_area_bond(const Kernel<2> &kernel, const Candidate &candidate)
  {
    Bond result = centroid_bond(kernel, candidate);
    result.kernel_point = candidate.xi;
    return result;
  }

  NeighbourhoodQuadrature partial_area(const Kernel<2> &)
  {
    return {partial_area_bond};
  }

  NeighbourhoodQuadrature improved_partial_area(const Kernel<2> &)
  {
    return {centroid_bond};
  }
} // namespace plumbline::meshfree
