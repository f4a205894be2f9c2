#include "algebra/linear_system.h"

#include "algebra/solve.h"
#include "base/error.h"
#include "geometry/maximal_boxes.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace plumbline::algebra
{
  const Stencil &symmetric(const Stencil &stencil)
  {
    constexpr double rounding = 1e-12;
    if (const double defect = stencil.symmetry_defect(); defect > rounding)
    {
      std::ostringstream message;
      message << "the operator is not symmetric (defect " << defect
              << "), so conjugate gradients would give a wrong solution";
      throw NumericalError(message.str());
    }
    return stencil;
  }

  namespace
  {
    SchwarzPreconditioner on_boxes(const Stencil &stencil, const geometry::BoxNodes &nodes)
    {
      std::vector<std::unique_ptr<RectangleSolver>> solvers;
      if (nodes.is_free.empty())
        solvers.push_back(make_box_sine_solver(stencil, nodes.n, {{}, nodes.n}));
      else
        for (const geometry::CubeRange &box : geometry::maximal_boxes(nodes.is_free, nodes.n))
          solvers.push_back(make_box_sine_solver(stencil, nodes.n, box));
      return SchwarzPreconditioner(std::move(solvers));
    }
  } // namespace

  StencilSystem::StencilSystem(const Stencil &stencil, const geometry::NodeSet &nodes,
                               const std::vector<geometry::CellRange> &rectangles,
                               OperatorBackend backend)
      : operator_(make_operator(symmetric(stencil), nodes, backend)),
        preconditioner_(stencil, nodes, rectangles)
  {
  }

  StencilSystem::StencilSystem(const Stencil &stencil, const geometry::BoxNodes &nodes,
                               OperatorBackend backend)
      : operator_(make_operator(symmetric(stencil), nodes, backend)),
        preconditioner_(on_boxes(stencil, nodes))
  {
  }

  LinearSolve StencilSystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    const SolveResult solved = algebra::solve(*operator_, preconditioner_, x, b, stopping.tolerance,
                                              stopping.max_iterations);
    return {solved.n_iterations, solved.relative_residual, operator_->backend(),
            operator_->n_bonds()};
  }

  SparseSystem::SparseSystem(std::shared_ptr<const CsrMatrix> rows, SparseOptions options,
                             base::Communicator communicator)
      : rows_(std::move(rows)), options_(std::move(options)), communicator_(communicator)
  {
  }

  void SparseSystem::vmult(Vector &y, const Vector &x) const
  {
    for (std::size_t i = 0; i < rows_->n_rows(); ++i)
    {
      double sum = 0;
      for (std::size_t k = rows_->start[i]; k < rows_->start[i + 1]; ++k)
        sum += rows_->value[k] * x[rows_->column[k]];
      y[i] = sum;
    }
  }

  LinearSolve SparseSystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    SparseOptions options = options_;
    options.tolerance = stopping.tolerance;
    options.max_iterations = stopping.max_iterations;
    const SparseSolution solved =
        solve_sparse(*rows_, std::vector<double>(b.begin(), b.end()), options, communicator_);
    std::copy(solved.values.begin(), solved.values.end(), x.begin());
    return {solved.n_iterations, solved.relative_residual, "sparse, " + solved.solver,
            solved.n_nonzeros};
  }
} // namespace plumbline::algebra
