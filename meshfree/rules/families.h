#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// The square or cube of half side reach about a point.
  template <int dim>
  typename geometry::BoxSearch<dim>::Box box_around(const Point<dim> &x, double reach)
  {
    dealii::Tensor<1, dim> diagonal;
    for (unsigned int d = 0; d < dim; ++d)
      diagonal[d] = reach;
    return {x - diagonal, x + diagonal};
  }

  /// Of the first n cells.
  template <int dim>
  std::vector<typename geometry::BoxSearch<dim>::Box>
  bounding_boxes(const geometry::NodeCells<dim> &cells, std::size_t n);

  /// What a meshfree rule yields on scattered nodes: L_h u_i = -Σ_k C(kernel_point_k)
  /// (u_{neighbour_k} - u_i) weight_k, made one at a time: of the free nodes and of those in the
  /// collar whose ball the cells cover. The part of the ball in the node's own cell is left out, as
  /// on a lattice. Cost of a scalar family in the plane at m = 3: 2 µs with whole cells, 7 µs with
  /// partial areas; 2, 4 and 4 µs more for the weights of IPA-AC-R2, IPA-AC-R4 and OPT.
  template <int dim>
  class Families
  {
  public:
    /// @param cells  must outlive the families
    Families(NeighbourhoodQuadrature<dim> rule, const Kernel<dim> &kernel,
             const geometry::NodeCells<dim> &cells, Backend backend);

    std::size_t size() const { return cells_->n_free; } ///< free nodes

    /// Thread safe.
    /// @param family  overwritten
    /// @throws NumericalError  no neighbours, or too few for the moments asked of them; names the
    /// node by the index it was given with
    void make(std::size_t node, Family<dim> &family) const;

    const Kernel<dim> &kernel() const { return kernel_; }
    const geometry::NodeCells<dim> &cells() const { return *cells_; }

  private:
    NeighbourhoodQuadrature<dim> rule_;
    Kernel<dim> kernel_;
    const geometry::NodeCells<dim> *cells_;
    Backend backend_;
    std::vector<geometry::ConvexCell> pieces_; ///< of all cells; in space they are there already
    geometry::BoxSearch<dim> search_;          ///< over the cells' bounding boxes
    double reach_; ///< from a node to the boxes of all its neighbours' cells
  };
} // namespace plumbline::meshfree
