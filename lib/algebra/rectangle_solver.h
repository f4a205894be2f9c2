#pragma once

#include "algebra/operator.h"

#include <memory>

namespace plumbline::algebra
{
  /// Approximate inverse of a stencil on one rectangle of cells with zero values around it.
  class RectangleSolver
  {
  public:
    virtual ~RectangleSolver() = default;

    /// result += approximate inverse of what input holds in the rectangle.
    virtual void add_inverse(Vector &result, const Vector &input) const = 0;
  };

  /// The τ preconditioner for one node family: the sine transform diagonalises the operator but for
  /// its rows near the boundary; components are treated one by one. Eigenvalues
  /// λ_pq = Σ_k A(k) cos(k1 π p/(n1+1)) cos(k2 π q/(n2+1)).
  /// Source: Bini & Di Benedetto 1990, doi:10.1145/97444.97688.
  /// @throws NumericalError  an eigenvalue is not positive: the stencil is not coercive
  std::unique_ptr<RectangleSolver> make_sine_solver(const Stencil &stencil,
                                                    const geometry::NodeSet &nodes,
                                                    const geometry::CellRange &cells);

  /// The same idea for several node families: reflect the rectangle oddly to twice its size, where
  /// the operator is block circulant, and invert its symbol block by block.
  /// @throws NumericalError  as above
  std::unique_ptr<RectangleSolver> make_reflection_solver(const Stencil &stencil,
                                                          const geometry::NodeSet &nodes,
                                                          const geometry::CellRange &cells);
} // namespace plumbline::algebra
