#pragma once

#include "algebra/operator.h"
#include "geometry/cell_counts.h"

#include <memory>

namespace plumbline::algebra
{
  /// Approximate inverse of a stencil on one rectangle of cells.
  class RectangleSolver
  {
  public:
    virtual ~RectangleSolver() = default;

    /// result += approximate inverse of what input holds in the rectangle.
    virtual void add_inverse(Vector &result, const Vector &input) const = 0;
  };

  /// How values continue beyond one side of a rectangle of nodes.
  enum class Side
  {
    zero,    ///< odd about the next node outside
    mirrored ///< even about the outermost node inside, which has half a cell
  };

  using Sides = std::array<std::array<Side, 2>, 2>;

  /// Where rows between two zeros have them.
  enum class Zeros
  {
    next, ///< at the next node outside, whatever its transform costs
    fast  ///< further out, with the nodes next to the rectangle held at zero, see
          ///< constrained_nodes.h
  };

  /// The τ preconditioner for one node family: the sine transform diagonalises the operator but for
  /// its rows near the boundary; components are treated one by one. Eigenvalues
  /// λ_pq = Σ_k A(k) cos(k1 θ_p) cos(k2 θ_q), θ_p = π p/(n1+1) between two sides of zeros.
  /// At mirrored sides it inverts the rows of half cells, A times ½.
  /// @param sides  lower and upper of each axis; two mirrored ones need two nodes between them
  /// @param zeros  fast: a longer row's, whose transform is fast; conjugate gradients take 3 to 5
  ///               iterations for scalar stencils of short reach then, not 8 to 19
  /// Source: Bini & Di Benedetto 1990, doi:10.1145/97444.97688; cosines: Strang 1999,
  /// doi:10.1137/S0036144598336745.
  /// @throws NumericalError  an eigenvalue is not positive: the stencil is not coercive
  std::unique_ptr<RectangleSolver> make_sine_solver(const Stencil &stencil,
                                                    const geometry::NodeSet &nodes,
                                                    const geometry::CellRange &cells,
                                                    const Sides &sides = {},
                                                    Zeros zeros = Zeros::next);

  /// The τ preconditioner on a box of nodes in space, or on a slab of one layer and reach 0 along
  /// it.
  /// @param n    vectors have shape (n_components, n[2], n[1], n[0])
  /// @param box  of these positions
  /// @throws NumericalError  as above
  std::unique_ptr<RectangleSolver> make_box_sine_solver(const Stencil &stencil,
                                                        const std::array<int, 3> &n,
                                                        const geometry::CubeRange &box);

  /// The same idea for several node families: reflect the rectangle, and as many cells around it as
  /// make that fast, oddly to twice its size, where the operator is block circulant, and invert its
  /// symbol block by block.
  /// @throws NumericalError  as above
  std::unique_ptr<RectangleSolver> make_reflection_solver(const Stencil &stencil,
                                                          const geometry::NodeSet &nodes,
                                                          const geometry::CellRange &cells);
} // namespace plumbline::algebra
