#pragma once

#include "geometry/cube_lattice.h"
#include "reference/shapes.h"

#include <deal.II/base/tensor.h>

namespace plumbline::reference
{
  /// A Galerkin solution on the cells of a lattice in space, with the constraint around it: a sum
  /// of tensor products of shape functions on each cell.
  class CubeField
  {
  public:
    /// @param values  of all families at positions -1 ... n of each axis: shape (n_components
    /// n_families, n[2] + 2, n[1] + 2, n[0] + 2)
    CubeField(geometry::CubeLattice lattice, AxisShapes shapes, std::vector<double> values);

    /// On either side of a face where u jumps.
    /// @throws NumericalError  a point outside Ω
    double value(const dealii::Point<3> &x, unsigned int component) const;

    /// Of a continuous field.
    /// @throws NumericalError  a point outside Ω
    dealii::Tensor<1, 3> gradient(const dealii::Point<3> &x, unsigned int component) const;

    /// Over the cells of Ω, exact: shape (n_cells, n_components).
    std::vector<double> averages() const;

  private:
    /// Factors of the local shape functions along an axis.
    using Factors = std::array<std::vector<double>, 3>;

    /// Where a point is: a cell of Ω, and the coordinates in it in cells.
    struct Place
    {
      std::array<int, 3> cell{};
      dealii::Point<3> inner;
    };
    Place place(const dealii::Point<3> &x) const;

    /// Σ over the local shape functions of a cell of their values and factors.
    double sum(const std::array<int, 3> &cell, unsigned int component,
               const Factors &factors) const;

    geometry::CubeLattice lattice_;
    AxisShapes shapes_;
    std::array<int, 3> n_; ///< extents of values
    std::vector<double> values_;
  };
} // namespace plumbline::reference
