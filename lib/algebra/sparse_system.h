#pragma once

#include "algebra/rows.h"

#include <string>

namespace plumbline::algebra
{
  /// How a sparse system is solved.
  enum class SparseSolver
  {
    automatic, ///< direct up to 1000 unknowns; above, amg if they outnumber the entries of a row by
               ///< more than 150, else jacobi
    direct,    ///< MUMPS
    amg,       ///< conjugate gradients or GMRES, preconditioned by ML's algebraic multigrid
    jacobi     ///< the same, preconditioned by the diagonal
  };

  /// @throws InputError  not one of automatic, direct, amg, jacobi
  SparseSolver sparse_solver_from_name(const std::string &name);

  struct SparseOptions
  {
    bool is_symmetric = true; ///< and positive definite: conjugate gradients, else GMRES
    SparseSolver solver = SparseSolver::automatic;
    unsigned int n_components = 1; ///< unknowns a node, numbered node by node: AMG's constant modes
    double tolerance = 1e-12;      ///< relative residual
    unsigned int max_iterations = 1000;
  };

  struct SparseSolution
  {
    std::vector<double> values; ///< all of them, on every rank
    unsigned int n_iterations;  ///< 0 for direct
    double relative_residual;   ///< computed afterwards from the matrix itself
    std::string solver;         ///< "direct", "amg" or "jacobi"
    std::uint64_t n_nonzeros;   ///< of the whole matrix
    std::size_t bytes;          ///< of rows, and factors or preconditioner, on this rank
  };

  /// Solve A x = b where A and b are the sums over all ranks of what each one gives. Every rank
  /// gets a contiguous share of the nodes; entries of other ranks' rows are sent to them. Threads
  /// share the products A x. Only direct and amg copy the rows, into a Trilinos matrix.
  /// @param rows  this rank's part of A: any rows, shape (n, n), < 2^31 entries
  /// @param right_hand_side  this rank's part of b, shape (n), n a multiple of n_components
  /// @note Collective; errors are thrown on all ranks.
  /// @throws NumericalError  a row without entries, a singular matrix, no convergence, a value that
  /// is not finite, a residual above 1e-8 (direct) or 10 tolerances and the round-off of A x
  /// Accuracy: the same on any number of ranks to condition × tolerance (direct: × round-off).
  /// Limits: a singular system that has solutions is an error of direct; iterations may return one
  /// of them.
  SparseSolution solve_sparse(const Rows &rows, const std::vector<double> &right_hand_side,
                              const SparseOptions &options, const base::Team &team);
} // namespace plumbline::algebra
