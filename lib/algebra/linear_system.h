#pragma once

#include "algebra/operator.h"
#include "algebra/schwarz.h"
#include "algebra/sparse_system.h"

namespace plumbline::algebra
{
  /// When an iteration ends.
  struct Stopping
  {
    double tolerance = 1e-12; ///< relative residual
    unsigned int max_iterations = 1000;
  };

  /// How a linear system was solved.
  struct LinearSolve
  {
    unsigned int n_iterations = 0;
    double relative_residual = 0;
    std::string backend;       ///< "fft", "direct", "sparse" or "sparse, <solver>"
    std::uint64_t n_bonds = 0; ///< pairs that one application sums over
  };

  /// A linear operator with the solver that suits it: the derivative of a discretisation's force.
  class LinearSystem
  {
  public:
    virtual ~LinearSystem() = default;

    /// On several ranks, y and b are sums over all of what each one has.
    virtual void vmult(Vector &y, const Vector &x) const = 0;

    /// @param x  begun from; the same on every rank when solved
    /// @throws NumericalError  no solution
    virtual LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const = 0;
  };

  /// The stencil itself, which conjugate gradients need to be symmetric.
  /// @throws NumericalError  it is not, to 1e-12
  const Stencil &symmetric(const Stencil &stencil);

  /// A stencil on the free nodes of a lattice, by conjugate gradients that fast solvers on
  /// rectangles precondition.
  class StencilSystem : public LinearSystem
  {
  public:
    /// @throws NumericalError  the stencil is not symmetric, so that conjugate gradients would fail
    /// @throws InputError  a backend that cannot do it, see `make_operator`
    StencilSystem(const Stencil &stencil, const geometry::NodeSet &nodes,
                  const std::vector<geometry::CellRange> &rectangles, OperatorBackend backend);

    /// In space, of one family of nodes.
    StencilSystem(const Stencil &stencil, const geometry::BoxNodes &nodes, OperatorBackend backend);

    void vmult(Vector &y, const Vector &x) const override { operator_->vmult(y, x); }
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    std::unique_ptr<Operator> operator_;
    SchwarzPreconditioner preconditioner_;
  };

  /// Sparse rows, of which every rank has some, by `solve_sparse`.
  class SparseSystem : public LinearSystem
  {
  public:
    /// @param options  those for stopping are not looked at
    SparseSystem(std::shared_ptr<const CsrMatrix> rows, SparseOptions options,
                 base::Communicator communicator);

    void vmult(Vector &y, const Vector &x) const override;
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    std::shared_ptr<const CsrMatrix> rows_;
    SparseOptions options_;
    base::Communicator communicator_;
  };
} // namespace plumbline::algebra
