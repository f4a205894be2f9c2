#pragma once

#include "algebra/rectangle_solver.h"

namespace plumbline::algebra
{
  /// Preconditioner for a stencil on a union of lattice cells: the sum of the rectangle solvers
  /// over the largest rectangles in Ω (overlapping additive Schwarz). On a rectangle this is the τ
  /// preconditioner itself, whose iteration counts do not depend on h; on a union of a few
  /// rectangles that overlap by a fixed length they stay bounded as well, and grow with the number
  /// of rectangles.
  class SchwarzPreconditioner
  {
  public:
    SchwarzPreconditioner(const Stencil &stencil, const geometry::NodeSet &nodes,
                          const std::vector<geometry::CellRange> &rectangles);

    /// The sum of any rectangle solvers.
    explicit SchwarzPreconditioner(std::vector<std::unique_ptr<RectangleSolver>> solvers)
        : solvers_(std::move(solvers))
    {
    }

    void vmult(Vector &result, const Vector &input) const;

  private:
    std::vector<std::unique_ptr<RectangleSolver>> solvers_;
  };
} // namespace plumbline::algebra
