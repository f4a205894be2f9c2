#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// Slivers below round-off of the cell are tangencies.
    constexpr double sliver = 1e-14;

    /// Length and centroid of ball ∩ piece.
    std::pair<double, Point<1>> cut(const Candidate<1> &candidate, const geometry::Interval &piece)
    {
      return geometry::intersect(candidate.ball, piece);
    }

    /// Area and centroid.
    std::pair<double, Point<2>> cut(const Candidate<2> &candidate,
                                    const geometry::ConvexCell &piece)
    {
      const auto part = geometry::intersect(candidate.ball, piece, candidate.backend);
      return {part.area, part.centroid};
    }

    /// Volume and centroid.
    std::pair<double, Point<3>> cut(const Candidate<3> &candidate,
                                    const geometry::ConvexPolyhedron &piece)
    {
      const auto part = geometry::intersect(candidate.ball, piece, 1);
      return {part.volume, part.centroid};
    }
  } // namespace

  template <int dim>
  Bond<dim> centroid_bond(const Kernel<dim> &, const Candidate<dim> &candidate)
  {
    double area = 0;
    Point<dim> first;
    for (const auto &piece : candidate.pieces)
    {
      const auto [part, centroid] = cut(candidate, piece);
      area += part;
      first += part * (centroid - candidate.ball.centre);
    }
    if (area <= sliver * candidate.area)
      return {candidate.xi, 0, candidate.xi, 0};
    return {candidate.xi, area, first / area, area};
  }

  template <int dim>
  Bond<dim> partial_area_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
  {
    Bond<dim> result = centroid_bond(kernel, candidate);
    result.kernel_point = candidate.xi;
    return result;
  }

  template <int dim>
  NeighbourhoodQuadrature<dim> partial_area(const Kernel<dim> &)
  {
    return {partial_area_bond<dim>};
  }

  template <int dim>
  NeighbourhoodQuadrature<dim> improved_partial_area(const Kernel<dim> &)
  {
    return {centroid_bond<dim>};
  }

  template Bond<1> partial_area_bond(const Kernel<1> &, const Candidate<1> &);
  template Bond<1> centroid_bond(const Kernel<1> &, const Candidate<1> &);
  template NeighbourhoodQuadrature<1> partial_area(const Kernel<1> &);
  template NeighbourhoodQuadrature<1> improved_partial_area(const Kernel<1> &);
  template Bond<2> partial_area_bond(const Kernel<2> &, const Candidate<2> &);
  template Bond<2> centroid_bond(const Kernel<2> &, const Candidate<2> &);
  template NeighbourhoodQuadrature<2> partial_area(const Kernel<2> &);
  template NeighbourhoodQuadrature<2> improved_partial_area(const Kernel<2> &);
  template Bond<3> partial_area_bond(const Kernel<3> &, const Candidate<3> &);
  template Bond<3> centroid_bond(const Kernel<3> &, const Candidate<3> &);
  template NeighbourhoodQuadrature<3> partial_area(const Kernel<3> &);
  template NeighbourhoodQuadrature<3> improved_partial_area(const Kernel<3> &);
} // namespace plumbline::meshfree
