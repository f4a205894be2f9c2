#pragma once

#include "geometry/ball_polyhedron.h"
#include "geometry/interval.h"
#include "geometry/node_cells.h"
#include "meshfree/rules/bonds.h"

#include <functional>
#include <type_traits>

namespace plumbline::meshfree
{
  /// What a rule sees of a node near the ball: enough to make a bond to it, on lattices and on
  /// scattered nodes alike.
  template <int dim>
  struct Candidate
  {
    template <class OnLine, class InPlane, class InSpace>
    using Of = std::conditional_t<dim == 1, OnLine, std::conditional_t<dim == 2, InPlane, InSpace>>;
    using Cell = Of<geometry::Interval, geometry::ConvexCell, geometry::ConvexPolyhedron>;

    Of<geometry::LineBall, geometry::Ball, geometry::SolidBall> ball; ///< about the node
    Backend backend = Backend::fast;                                  ///< in the plane
    Point<dim> xi;                             ///< from the family's node to this one [length]
    double area = 0;                           ///< of this node's cell [length^dim]
    dealii::ArrayView<const Cell> pieces = {}; ///< of this node's cell
  };

  /// The bonds of one node.
  template <int dim>
  struct Family
  {
    std::vector<unsigned int> neighbours; ///< indices of nodes, ascending; empty on a lattice
    std::vector<Bond<dim>> bonds;
    Fit fit;
    double own_area = 0;     ///< of the cell of the node itself [length^dim]
    bool is_clipped = false; ///< a negative kernel beyond the horizon counted as 0
  };

  /// All that makes a rule.
  template <int dim>
  struct NeighbourhoodQuadrature
  {
    /// The bond to a candidate; weight 0: none.
    std::function<Bond<dim>(const Kernel<dim> &, const Candidate<dim> &)> bond;
    /// Changes the weights of a whole family; empty: they stay.
    std::function<void(Family<dim> &)> adjust = {};
  };

  // Bonds that several rules start from.

  /// The cell's area if its node is in the ball, kernel at the node.
  template <int dim>
  Bond<dim> full_area_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate);

  /// The area of ball ∩ cell, kernel at the node.
  template <int dim>
  Bond<dim> partial_area_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate);

  /// The area of ball ∩ cell, kernel at its centroid.
  template <int dim>
  Bond<dim> centroid_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate);

  /// 1 inside r = δ - √A/2, then linear through 1/2 at r = δ, negative beyond r = δ + √A/2; in
  /// space with the cube root of the volume, on a line with the length.
  template <int dim>
  double ramp(const Kernel<dim> &kernel, const Candidate<dim> &candidate);

  /// Add the bond to a candidate, if there is one.
  template <int dim>
  bool add_bond(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                const Candidate<dim> &candidate, Family<dim> &family);

  /// Adjust the weights of a family that has all its bonds.
  /// @param where  of the node, for the message
  /// @throws NumericalError  no neighbours, or too few for the moments asked of them
  template <int dim>
  void finish(const NeighbourhoodQuadrature<dim> &rule, Family<dim> &family,
              const std::function<std::string()> &where);

  /// The family that all nodes of a lattice share.
  /// @throws NumericalError  as above
  template <int dim>
  Bonds<dim> lattice_bonds(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                           double h, Backend backend);
} // namespace plumbline::meshfree
