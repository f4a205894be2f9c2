#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// The square of half side reach about a point.
  inline geometry::Box box_around(const Point<2> &x, double reach)
  {
    const dealii::Tensor<1, 2> diagonal({reach, reach});
    return {x - diagonal, x + diagonal};
  }

  /// Of the first n cells.
  std::vector<geometry::Box> bounding_boxes(const geometry::NodeCells &cells, std::size_t n);

  /// What a meshfree rule yields on scattered nodes: L_h u_i = -Σ_k C(kernel_point_k)
  /// (u_{neighbour_k} - u_i) weight_k, made one at a time: of the free nodes and of those in the
  /// collar whose ball the cells cover. The part of the ball in the node's own cell is left out, as
  /// on a lattice. Cost of a scalar family at m = 3: 2 µs with whole cells, 7 µs with partial
  /// areas; 2, 4 and 4 µs more for the weights of IPA-AC-R2, IPA-AC-R4 and OPT.
  class Families
  {
  public:
    /// @param cells  must outlive the families
    Families(NeighbourhoodQuadrature<2> rule, const Kernel<2> &kernel,
             const geometry::NodeCells &cells, Backend backend);

    std::size_t size() const { return cells_->n_free; } ///< free nodes

    /// Thread safe.
    /// @param family  overwritten
    /// @throws NumericalError  no neighbours, or too few for the moments asked of them; names the
    /// node by the index it was given with
    void make(std::size_t node, Family<2> &family) const;

    const Kernel<2> &kernel() const { return kernel_; }
    const geometry::NodeCells &cells() const { return *cells_; }

  private:
    NeighbourhoodQuadrature<2> rule_;
    Kernel<2> kernel_;
    const geometry::NodeCells *cells_;
    Backend backend_;
    std::vector<geometry::ConvexCell> pieces_; ///< of all cells
    geometry::BoxSearch search_;               ///< over the cells' bounding boxes
    double reach_; ///< from a node to the boxes of all its neighbours' cells
  };
} // namespace plumbline::meshfree
