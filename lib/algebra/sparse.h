#pragma once

#include "algebra/csr_matrix.h"
#include "algebra/operator.h"

#include <memory>

namespace plumbline::algebra
{
  /// Where the free unknowns stand in vectors of a NodeSet, numbered node by node: first all
  /// components of the first node.
  std::vector<std::size_t> free_positions(const geometry::NodeSet &nodes);

  /// Couplings between the free unknowns, numbered like that.
  CsrMatrix assemble(const Stencil &stencil, const geometry::NodeSet &nodes);

  /// The same operator as an assembled Trilinos matrix: a second way to every number, and the
  /// one that other solvers can take. Memory O(unknowns × bonds).
  class SparseOperator : public Operator
  {
  public:
    SparseOperator(const Stencil &stencil, const geometry::NodeSet &nodes);
    ~SparseOperator() override;

    void vmult(Vector &result, const Vector &input) const override;
    std::string backend() const override { return "sparse"; }
    std::uint64_t n_bonds() const override;

    /// Solve by Trilinos' direct solver (Amesos KLU), for small systems.
    /// @throws NumericalError  the matrix is singular
    void solve_directly(Vector &solution, const Vector &right_hand_side) const;

  private:
    struct Matrix;
    std::unique_ptr<Matrix> matrix_;
  };
} // namespace plumbline::algebra
