#pragma once

#include "algebra/csr_matrix.h"
#include "base/solver_choices.h"

#include <deal.II/base/point.h>

#include <string>

namespace plumbline::algebra
{
  using base::Iteration;
  using base::SparseSolver;

  struct SparseOptions
  {
    bool is_symmetric = true; ///< and positive definite
    Iteration iteration = Iteration::automatic;
    SparseSolver solver = SparseSolver::automatic;
    unsigned int n_components = 1; ///< unknowns a node, numbered node by node
    /// If not 0, unknowns from this one on are given by those before it: their rows have a 1 on the
    /// diagonal and nothing else among themselves. Only the first ones belong to nodes then, and
    /// amg is a `BlockPreconditioner`.
    std::size_t n_first = 0;
    /// Places of all nodes, for amg and two components: rotations are among its near-null modes
    /// then, besides the constants, which saves one iteration in six of elastic solids.
    std::vector<dealii::Point<2>> nodes;
    double tolerance = 1e-12; ///< relative residual
    unsigned int max_iterations = 1000;
  };

  struct SparseSolution
  {
    std::vector<double> values;    ///< all of them, on every rank
    unsigned int n_iterations = 0; ///< 0 for direct
    double relative_residual = 0;  ///< computed afterwards from the matrix itself
    std::string solver;           ///< "direct", or the iteration and its preconditioner: "cg + amg"
    std::uint64_t n_nonzeros = 0; ///< of the whole matrix
    std::size_t bytes = 0;        ///< of rows, and factors or preconditioner, on this rank
  };

  /// Solve A x = b where A and b are the sums over all ranks of what each one gives. Every rank
  /// gets a contiguous share of the nodes; entries of other ranks' rows are sent to them. Threads
  /// share the products A x. Only direct and amg copy the rows, into a Trilinos matrix.
  /// @param rows  this rank's part of A: any rows, shape (n, n), < 2^31 entries
  /// @param right_hand_side  this rank's part of b, shape (n), n a multiple of n_components
  /// @note Collective; errors are thrown on all ranks.
  /// @throws InputError  cg was asked for, but A is not symmetric
  /// @throws NumericalError  a row without entries, a singular matrix, no convergence, a value that
  /// is not finite, a residual above 1e-8 (direct) or 10 tolerances and the round-off of A x
  /// Accuracy: the same on any number of ranks to condition × tolerance (direct: × round-off).
  /// Limits: a singular system that has solutions is an error of direct; iterations may return one
  /// of them.
  SparseSolution solve_sparse(const CsrMatrix &rows, const std::vector<double> &right_hand_side,
                              const SparseOptions &options, const base::Communicator &communicator);
} // namespace plumbline::algebra
