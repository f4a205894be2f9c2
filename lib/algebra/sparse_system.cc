#include "algebra/sparse_system.h"

#include "algebra/block_preconditioner.h"
#include "algebra/solver_faults.h"
#include "base/error.h"
#include "base/memory.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/solver_bicgstab.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <Amesos_Mumps.h>
#include <Epetra_LinearProblem.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    using base::Communicator;
    using Vector = DistributedMatrix::Vector;

    constexpr double eps = std::numeric_limits<double>::epsilon();

    /// Up to here a factorisation takes .02 s or less, and it solves what iterations do not.
    constexpr std::size_t most_unknowns_for_direct = 1000;

    /// Multigrid pays if unknowns × n_components² outnumber the entries of a row by this.
    /// Iterations with Jacobi grow like diameter / horizon, the root of unknowns / entries; solids
    /// take more of them than scalars, and rows that reach two horizons have four times the entries
    /// for the same iterations. Where both take the same time, measured for n = 1e3 to 5e4 and
    /// horizons of 3 h and 6 h, unknowns / entries is 85 (rules) to 130 (Galerkin) for scalars, 45
    /// to 65 for bond tensors, and 10 to 30 for state-based solids; the wrong choice costs up to
    /// half as much again.
    constexpr double multigrid_pays = 100;

    /// A pivot of MUMPS below this, relative to the scaled matrix, is round-off: it is 1e-13 for
    /// 1000 unknowns that are tied to nothing and grows with their number.
    constexpr double null_pivot = 1e-11;

    /// Basis vectors of GMRES before it restarts.
    constexpr unsigned int n_basis_vectors = 100;

    /// Asymmetry that conjugate gradients are not to be asked to bear; Galerkin matrices have less.
    constexpr double largest_asymmetry = 1e-10;

    /// What direct solutions must fulfil, and how far round-off may excuse iterated ones.
    constexpr double largest_residual = 1e-8;

    // ---- what all ranks agree on ----------------------------------------------------------------

    constexpr int none = std::numeric_limits<int>::max();

    /// Throws on every rank if the row, of this rank or another, is not none.
    void reject(int row, const std::string &fault, const SparseOptions &options,
                const Communicator &communicator)
    {
      row = dealii::Utilities::MPI::min(row, communicator.mpi);
      if (row == none)
        return;
      std::ostringstream message;
      message << "row " << row << " of the sparse system (";
      if (options.n_first > 0 && row >= static_cast<int>(options.n_first))
        message << "unknown " << row - options.n_first << " of those that the first ones give";
      else
        message << "node " << row / options.n_components << ", component "
                << row % options.n_components;
      message << ") " << fault;
      throw NumericalError(message.str());
    }

    /// Take a step that all ranks take; if it fails on one of them, it fails on all.
    /// @param who  opens messages
    template <class Step>
    void together(const std::string &who, const Communicator &communicator, const Step &step)
    {
      std::string fault;
      try
      {
        step();
      }
      catch (const NumericalError &error)
      {
        fault = error.what();
      }
      catch (const std::bad_alloc &)
      {
        fault = "runs out of memory; write another Solver/linear solver (amg, jacobi), take larger "
                "h (Study/h), or a machine with more";
      }
      catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream text;
        error.print_info(text);
        fault = library_fault(text.str());
      }
      catch (const std::exception &error)
      {
        fault = library_fault(error.what());
      }
      catch (int code) // as Trilinos does
      {
        fault = library_fault("Trilinos' error code " + std::to_string(code));
      }
      const int is_bad = fault.empty() ? 0 : 1;
      if (dealii::Utilities::MPI::max(is_bad, communicator.mpi) == 1)
        throw NumericalError(who + " " +
                             (is_bad ? fault : "fails on another rank; see what that one says"));
    }

    // ---- what solvers ask of the matrix ---------------------------------------------------------

    void check_rows(const DistributedMatrix &matrix, const SparseOptions &options)
    {
      const CsrView &rows = matrix.own();
      int bad = none;
      for (std::size_t i = rows.n_rows(); i-- > 0;)
        if (rows.start[i] == rows.start[i + 1])
          bad = static_cast<int>(matrix.ranges().own_first + i);
      reject(bad,
             "has no entries: nothing ties this unknown to the others; raise the horizon or leave "
             "the node out",
             options, matrix.ranges().communicator);
    }

    /// Of this rank's rows. @throws NumericalError  an entry is missing, on all ranks
    std::vector<double> find_diagonal(const DistributedMatrix &matrix, const SparseOptions &options)
    {
      const CsrView &rows = matrix.own();
      std::vector<double> result(rows.n_rows());
      int bad = none;
      for (std::size_t i = rows.n_rows(); i-- > 0;)
      {
        const std::size_t row = matrix.ranges().own_first + i;
        for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
          if (rows.column[e] == row)
            result[i] = rows.value[e];
        if (result[i] == 0)
          bad = static_cast<int>(row);
      }
      reject(bad,
             "has no diagonal entry, which iterations need; write Solver/linear solver = direct",
             options, matrix.ranges().communicator);
      return result;
    }

    // ---- solvers --------------------------------------------------------------------------------

    /// What this process has allocated [bytes].
    std::size_t heap_bytes()
    {
      const auto heap = mallinfo2();
      return heap.uordblks + heap.hblkhd;
    }

    /// @param bytes  on the rank that takes most
    /// @throws NumericalError  on all ranks, where one of them has not as much
    void require_factors(double bytes, const DistributedMatrix &rows)
    {
      const std::string fault =
          base::memory_fault(bytes, "for its factors",
                             "write Solver/linear solver = amg or jacobi, or choose a larger h");
      if (rows.ranges().communicator.any(!fault.empty()))
        throw NumericalError(fault.empty() ? "has no memory for its factors on another rank"
                                           : fault);
    }

    /// MUMPS. On several ranks it is faster than KLU, which gathers all on one.
    /// @return  what it allocated on this rank [bytes]
    std::size_t solve_directly(const DistributedMatrix &rows, Vector &x, const Vector &b)
    {
      const std::size_t bytes_before = heap_bytes();
      const auto matrix = to_trilinos(rows.own(), rows.ranges());
      Epetra_LinearProblem problem(const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()),
                                   &x.trilinos_vector(),
                                   const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
      Amesos_Mumps mumps(problem);
      mumps.SetICNTL(14, 100); // per cent of room for pivoting beyond the estimate
      mumps.SetICNTL(24, 1);   // count null pivots, also
      mumps.SetICNTL(13, 1);   // in the last front
      mumps.SetCNTL(3, null_pivot);
      const bool is_analysed = mumps.SymbolicFactorization() == 0;
      const int *const info = mumps.GetINFOG() - 1; // as numbered in MUMPS' manual
      if (is_analysed)
        require_factors(1e6 * info[16], rows);
      const bool is_done = is_analysed && mumps.NumericFactorization() == 0;
      const std::size_t bytes = heap_bytes() - bytes_before;
      if (info[28] > 0)
        throw NumericalError("finds the system singular: " + std::to_string(info[28]) +
                             " of its unknowns are not determined; tie all nodes to the boundary "
                             "data: raise the horizon or refine");
      if (!is_done || mumps.Solve() != 0)
        throw NumericalError(mumps_fault(info[1], info[2]));
      return bytes;
    }

    /// @return  the number of iterations
    template <class Preconditioner>
    unsigned int iterate(const DistributedMatrix &matrix, const Preconditioner &preconditioner,
                         Vector &x, const Vector &b, const SparseOptions &options)
    {
      using GMRES = dealii::SolverGMRES<Vector>;
      const double scale = b.l2_norm();
      dealii::SolverControl control(options.max_iterations, options.tolerance * scale, false,
                                    false);
      try
      {
        if (options.iteration == Iteration::cg)
          dealii::SolverCG<Vector>(control).solve(matrix, x, b, preconditioner);
        else if (options.iteration == Iteration::bicgstab)
          dealii::SolverBicgstab<Vector>(control).solve(matrix, x, b, preconditioner);
        else // preconditioned from the right: the residual watched is the true one
          GMRES(control, GMRES::AdditionalData(n_basis_vectors + 2, true))
              .solve(matrix, x, b, preconditioner);
      }
      catch (const dealii::SolverControl::NoConvergence &)
      {
        throw NumericalError(iteration_fault(control.last_step(), options.max_iterations,
                                             control.last_value() / scale, options.tolerance));
      }
      return control.last_step();
    }

    /// x, and in the solution what it took.
    void solve_by(const DistributedMatrix &matrix, Vector &x, const Vector &b,
                  const SparseOptions &options, SparseSolution &solution)
    {
      if (options.solver == SparseSolver::direct)
      {
        solution.bytes += solve_directly(matrix, x, b);
        return;
      }
      const std::size_t bytes_before = heap_bytes();
      const std::vector<double> diagonal = find_diagonal(matrix, options);
      const auto precondition = [&](const auto &preconditioner)
      {
        solution.bytes += heap_bytes() - bytes_before;
        solution.n_iterations = iterate(matrix, preconditioner, x, b, options);
      };
      if (options.solver == SparseSolver::jacobi)
      {
        Vector inverse(b);
        std::transform(diagonal.begin(), diagonal.end(), inverse.begin(),
                       [](double value) { return 1 / value; });
        precondition(dealii::DiagonalMatrix<Vector>(inverse));
      }
      else if (options.n_first > 0)
      {
        const BlockPreconditioner blocks(matrix, options.n_first, options.n_components,
                                         options.nodes);
        blocks.vmult(x, b); // from here on the rows of what others give hold exactly
        precondition(blocks);
      }
      else
        precondition(Multigrid(matrix.own(), matrix.ranges(), options.n_components, options.nodes));
    }

    SparseSolver choose(std::size_t n, std::uint64_t n_nonzeros, const SparseOptions &options)
    {
      const unsigned int n_components = options.n_components;
      if (n <= most_unknowns_for_direct)
        return SparseSolver::direct;
      if (options.n_first > 0)
        return SparseSolver::amg;
      const double row_length = static_cast<double>(n_nonzeros) / n;
      return n / row_length * n_components * n_components > multigrid_pays ? SparseSolver::amg
                                                                           : SparseSolver::jacobi;
    }

    /// Options are of a system of n unknowns.
    [[maybe_unused]] bool fits(const SparseOptions &options, std::size_t n)
    {
      const std::size_t n_of_nodes = options.n_first > 0 ? options.n_first : n;
      return n_of_nodes <= n && n_of_nodes % options.n_components == 0 &&
             (options.nodes.empty() || options.nodes.size() == n_of_nodes / options.n_components);
    }

    void check_symmetry(const DistributedMatrix &matrix)
    {
      const double asymmetry = matrix.asymmetry();
      if (!(asymmetry > largest_asymmetry))
        return;
      std::ostringstream message;
      message << "the iteration cg (Solver/iteration) needs a symmetric matrix, but max |A_ij - "
                 "A_ji| is "
              << asymmetry << " max |A_ij|; write automatic, gmres or bicgstab";
      throw InputError(message.str());
    }

    /// A row of either whose sum is no finite number holds a value that is none.
    void check_values(const CsrMatrix &rows, const std::vector<double> &right_hand_side,
                      const SparseOptions &options, const Communicator &communicator)
    {
      int bad = none;
      for (std::size_t i = 0; i < right_hand_side.size(); ++i)
      {
        double sum = right_hand_side[i];
        for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
          sum += rows.value[e];
        if (!std::isfinite(sum))
          bad = std::min<int>(bad, i);
      }
      reject(bad,
             "holds a value, in the matrix or the right-hand side, that is not a finite number; "
             "look at the kernel and the load there",
             options, communicator);
    }

    /// Choose what was left to the program.
    /// @return  what the solver is called
    std::string settle(SparseOptions &options, std::size_t n, std::uint64_t n_nonzeros)
    {
      if (options.solver == SparseSolver::automatic)
        options.solver = choose(n, n_nonzeros, options);
      if (options.iteration == Iteration::automatic)
        options.iteration = options.is_symmetric ? Iteration::cg : Iteration::gmres;
      const std::string solver = base::word(options.solver);
      return options.solver == SparseSolver::direct
                 ? solver
                 : base::word(options.iteration) + " + " + solver;
    }

    /// What x leaves of b, relative.
    /// @param who  opens messages
    /// @throws NumericalError  more than the solver was to leave
    double check_residual(const DistributedMatrix &matrix, const Vector &x, const Vector &b,
                          const SparseOptions &options, const std::string &who)
    {
      Vector residual(b);
      // A x cannot be computed more accurately than this
      const double norm = b.l2_norm(), scale = norm > 0 ? norm : 1;
      const double round_off = 10 * eps * matrix.largest_row_sum() * x.l2_norm() / scale;
      const double allowed = options.solver == SparseSolver::direct
                                 ? largest_residual
                                 : 10 * options.tolerance + std::min(round_off, largest_residual);
      matrix.vmult(residual, x);
      residual -= b;
      const double relative = residual.l2_norm() / scale;
      if (!(relative <= allowed))
      {
        std::ostringstream message;
        message << who << " leaves the relative residual " << relative << ", allowed " << allowed
                << "; the system is singular or nearly so: tie all nodes to the boundary data, "
                   "raise the horizon or refine";
        throw NumericalError(message.str());
      }
      return relative;
    }
  } // namespace

  SparseSolution solve_sparse(const CsrMatrix &rows, const std::vector<double> &right_hand_side,
                              const SparseOptions &given, const base::Communicator &communicator)
  {
    SparseOptions options = given;
    const std::size_t n = right_hand_side.size();
    Assert(rows.n_rows() == n && fits(options, n), dealii::ExcInternalError());
    if (n == 0)
      return {};
    check_values(rows, right_hand_side, options, communicator);
    const OwnedRanges ranges(n, options.n_first > 0 ? 1 : options.n_components, communicator);
    const DistributedMatrix matrix(rows, ranges);
    check_rows(matrix, options);
    if (options.iteration == Iteration::cg)
      check_symmetry(matrix);
    Vector b(ranges.own(), communicator.mpi), x(b);
    MPI_Reduce_scatter(right_hand_side.data(), b.begin(), ranges.size.data(), MPI_DOUBLE, MPI_SUM,
                       communicator.mpi);

    SparseSolution solution{};
    const CsrView &own = matrix.own();
    solution.bytes = own.start.size() * sizeof(own.start[0]) +
                     own.column.size() * (sizeof(own.column[0]) + sizeof(own.value[0]));
    solution.n_nonzeros =
        dealii::Utilities::MPI::sum(static_cast<std::uint64_t>(own.value.size()), communicator.mpi);
    solution.solver = settle(options, n, solution.n_nonzeros);
    const std::string who = "the sparse solver '" + solution.solver +
                            "' (Solver/linear solver, Solver/iteration) of " + std::to_string(n) +
                            " unknowns";
    together(who, communicator, [&] { solve_by(matrix, x, b, options, solution); });
    solution.relative_residual = check_residual(matrix, x, b, options, who);
    solution.values.resize(n);
    MPI_Allgatherv(x.begin(), static_cast<int>(ranges.own_size), MPI_DOUBLE, solution.values.data(),
                   ranges.size.data(), ranges.first.data(), MPI_DOUBLE, communicator.mpi);
    return solution;
  }
} // namespace plumbline::algebra
