#pragma once

#include "physics/kernel.h"
#include "reference/mesh/cell_shapes.h"
#include "reference/mesh/pair_blocks.h"

namespace plumbline::reference
{
  /// Points of a cell and, times their weights, 1, the shape functions and their products (a <= b,
  /// by rows): what double integrals over pairs of cells need where the kernel is as good as a
  /// polynomial.
  struct CellProducts
  {
    std::vector<Point<2>> points;
    std::vector<double> values; ///< shape (n_points, 1 + n + n (n + 1) / 2)

    void clear();

    /// @param phi  the shape functions there, shape (n)
    void add(const Point<2> &point, double weight, const double *phi, unsigned int n);
  };

  /// Those of the unit cell, for cells that are affine images of it.
  class UnitProducts
  {
  public:
    /// @param degree  of polynomials that points and weights are exact for
    UnitProducts(const CellShapes &shapes, unsigned int degree);

    /// @param products  overwritten
    void map(const CellMap &map, CellProducts &products) const;

  private:
    CellProducts unit_;
  };

  /// Add to the blocks of n shape functions half the kernel's trace, ½(C_xx - C_yy) and C_xy of
  /// bond tensors, or the one entry of scalar ones; of what is symmetric, the part above the
  /// diagonal.
  void add_products(const CellProducts &outer, const CellProducts &inner, unsigned int n,
                    const physics::Kernel<2> &kernel, PairBlocks &blocks);
} // namespace plumbline::reference
