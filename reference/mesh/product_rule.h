#pragma once

#include "physics/kernel.h"
#include "reference/mesh/cell_shapes.h"
#include "reference/mesh/pair_blocks.h"

namespace plumbline::reference
{
  /// Points of the unit triangle and, times their weights, 1, the shape functions and their
  /// products (a <= b, by rows): what double integrals over pairs of triangles need where the
  /// kernel is as good as a polynomial.
  class ProductRule
  {
  public:
    /// @param degree  of polynomials that it is exact for
    ProductRule(const CellShapes &shapes, unsigned int degree);

    /// Add to the blocks half the kernel's trace, ½(C_xx - C_yy) and C_xy of bond tensors, or the
    /// one entry of scalar ones; of what is symmetric, the part above the diagonal.
    void add(const CellMap &outer, const CellMap &inner, const physics::Kernel<2> &kernel,
             PairBlocks &blocks) const;

  private:
    unsigned int n_; ///< shape functions
    std::vector<Point<2>> unit_;
    std::size_t n_functions_;
    std::vector<double> value_; ///< shape (n_points, n_functions_)
  };
} // namespace plumbline::reference
