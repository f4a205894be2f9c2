#include "algebra/sparse_system.h"

#include "base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Amesos_Mumps.h>
#include <Epetra_LinearProblem.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    using base::Team;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    constexpr double eps = std::numeric_limits<double>::epsilon();

    /// Up to here a factorisation takes .02 s or less, and it solves what iterations do not.
    constexpr std::size_t most_unknowns_for_direct = 1000;

    /// Multigrid pays if nodes outnumber the entries of a row by this. Iterations with Jacobi grow
    /// like diameter / horizon, the root of that number, and pass 120 or so here. Measured: n = 1e4
    /// to 1e5, horizon 3 h to 12 h.
    constexpr double multigrid_pays = 150;

    /// A pivot of MUMPS below this, relative to the scaled matrix, is round-off: it is 1e-13 for
    /// 1000 unknowns that are tied to nothing and grows with their number.
    constexpr double null_pivot = 1e-11;

    /// Basis vectors of GMRES before it restarts.
    constexpr unsigned int n_basis_vectors = 100;

    /// What direct solutions must fulfil, and how far round-off may excuse iterated ones.
    constexpr double largest_residual = 1e-8;

    // ---- what all ranks agree on ----------------------------------------------------------------

    constexpr int none = std::numeric_limits<int>::max();

    /// Throws on every rank if the row, of this rank or another, is not none.
    void reject(int row, const std::string &fault, unsigned int n_components, const Team &team)
    {
      row = dealii::Utilities::MPI::min(row, team.communicator);
      if (row == none)
        return;
      std::ostringstream message;
      message << "row " << row << " of the sparse system (node " << row / n_components
              << ", component " << row % n_components << ") " << fault;
      throw NumericalError(message.str());
    }

    /// Take a step that all ranks take; if it fails on one of them, it fails on all.
    template <class Step>
    void together(const Team &team, const Step &step)
    {
      std::ostringstream fault;
      try
      {
        step();
      }
      catch (const dealii::ExceptionBase &error)
      {
        fault << "the solver of the sparse system fails:";
        error.print_info(fault);
      }
      catch (const std::exception &error)
      {
        fault << error.what();
      }
      catch (int code) // as Trilinos does
      {
        fault << "the solver of the sparse system fails with Trilinos' error code " << code;
      }
      const int is_bad = fault.str().empty() ? 0 : 1;
      if (dealii::Utilities::MPI::max(is_bad, team.communicator) == 1)
        throw NumericalError(is_bad ? fault.str()
                                    : "the solver of the sparse system fails on another rank");
    }

    // ---- rows to their ranks --------------------------------------------------------------------

    /// The contiguous rows of every rank; those of one node stay together.
    struct Shares
    {
      std::vector<int> first, size;
      unsigned int rank;

      Shares(std::size_t n, unsigned int n_components, const Team &team)
          : first(team.n_ranks()), size(team.n_ranks()), rank(team.rank())
      {
        const auto [begin, end] = team.share(n / n_components);
        const int own_first = static_cast<int>(begin * n_components);
        const int own_size = static_cast<int>((end - begin) * n_components);
        MPI_Allgather(&own_first, 1, MPI_INT, first.data(), 1, MPI_INT, team.communicator);
        MPI_Allgather(&own_size, 1, MPI_INT, size.data(), 1, MPI_INT, team.communicator);
      }

      dealii::IndexSet own() const
      {
        dealii::IndexSet rows(first.back() + size.back());
        rows.add_range(first[rank], first[rank] + size[rank]);
        return rows;
      }
    };

    /// Every rank sends pieces of its data to the others.
    /// @param out, out_from  sizes and places of the pieces in data, by receiver
    /// @param in             sizes of the pieces to receive, by sender
    template <class T>
    std::vector<T> exchange(const std::vector<T> &data, const std::vector<int> &out,
                            const std::vector<int> &out_from, const std::vector<int> &in,
                            const Team &team)
    {
      const auto type = dealii::Utilities::MPI::mpi_type_id_for_type<T>;
      std::vector<int> in_from(in.size());
      std::exclusive_scan(in.begin(), in.end(), in_from.begin(), 0);
      std::vector<T> received(in_from.back() + in.back());
      MPI_Alltoallv(data.data(), out.data(), out_from.data(), type, received.data(), in.data(),
                    in_from.data(), type, team.communicator);
      return received;
    }

    /// What the other ranks give to this rank's share: shape (n_ranks × n_own) rows, by sender.
    Rows from_others(const Rows &rows, const Shares &shares, const Team &team)
    {
      const std::size_t n_ranks = shares.first.size();
      std::vector<std::size_t> length(rows.n_rows()); // of what is sent: 0 in the own share
      std::vector<int> out(n_ranks), out_from(n_ranks), in(n_ranks);
      for (std::size_t r = 0; r < n_ranks; ++r)
      {
        out_from[r] = static_cast<int>(rows.start[shares.first[r]]);
        for (int i = shares.first[r]; r != shares.rank && i < shares.first[r] + shares.size[r]; ++i)
          out[r] += static_cast<int>(length[i] = rows.start[i + 1] - rows.start[i]);
      }
      MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, team.communicator);
      Rows received;
      received.start = exchange(length, shares.size, shares.first,
                                std::vector<int>(n_ranks, shares.size[shares.rank]), team);
      received.start.insert(received.start.begin(), 0);
      std::partial_sum(received.start.begin(), received.start.end(), received.start.begin());
      received.column = exchange(rows.column, out, out_from, in, team);
      received.value = exchange(rows.value, out, out_from, in, team);
      return received;
    }

    Matrix assemble(const Rows &rows, const Shares &shares, unsigned int n_components,
                    const Team &team)
    {
      const std::size_t n_own = shares.size[shares.rank], first = shares.first[shares.rank];
      const Rows others = from_others(rows, shares, team);
      const auto visit = [&](std::size_t i, const auto &use)
      {
        use(rows, first + i);
        for (std::size_t r = 0; r < shares.size.size(); ++r)
          use(others, r * n_own + i);
      };
      int bad = none;
      std::vector<unsigned int> length(n_own + 1); // one more, deal.II looks at the first
      for (std::size_t i = 0; i < n_own; ++i)
      {
        visit(i, [&](const Rows &part, std::size_t row)
              { length[i] += part.start[row + 1] - part.start[row]; });
        if (length[i] == 0)
          bad = std::min<int>(bad, first + i);
      }
      reject(bad,
             "has no entries: nothing ties this unknown to the others; raise the horizon or leave "
             "the node out",
             n_components, team);

      // entries that are set twice before compress are kept, and added up by it
      Matrix matrix(shares.own(), team.communicator, length);
      for (std::size_t i = 0; i < n_own; ++i)
        visit(i,
              [&](const Rows &part, std::size_t row)
              {
                const std::size_t from = part.start[row];
                matrix.set(first + i, part.start[row + 1] - from, part.column.data() + from,
                           part.value.data() + from);
              });
      matrix.compress(dealii::VectorOperation::insert);
      return matrix;
    }

    // ---- solvers --------------------------------------------------------------------------------

    /// What this process has allocated [bytes].
    std::size_t heap_bytes()
    {
      const auto heap = mallinfo2();
      return heap.uordblks + heap.hblkhd;
    }

    struct Work
    {
      unsigned int n_iterations;
      std::size_t bytes; ///< of factors or preconditioner, on this rank
    };

    /// MUMPS. On several ranks it is faster than KLU, which gathers all on one.
    Work solve_directly(const Matrix &matrix, Vector &x, const Vector &b)
    {
      const std::size_t bytes_before = heap_bytes();
      Epetra_LinearProblem problem(const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()),
                                   &x.trilinos_vector(),
                                   const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
      Amesos_Mumps mumps(problem);
      mumps.SetICNTL(14, 100); // per cent of room for pivoting beyond the estimate
      mumps.SetICNTL(24, 1);   // count null pivots, also
      mumps.SetICNTL(13, 1);   // in the last front
      mumps.SetCNTL(3, null_pivot);
      const bool is_done = mumps.SymbolicFactorization() == 0 && mumps.NumericFactorization() == 0;
      const std::size_t bytes = heap_bytes() - bytes_before;
      const int *const info = mumps.GetINFOG() - 1; // as numbered in MUMPS' manual
      std::ostringstream fault;
      if (info[28] > 0)
        fault << "the sparse system is singular: " << info[28]
              << " of its unknowns are not determined; tie all nodes to the boundary data: raise "
                 "the horizon or refine";
      else if (!is_done || mumps.Solve() != 0)
        fault << "the direct solver fails with MUMPS' error " << info[1] << ", " << info[2]
              << "; take the sparse solver amg";
      if (!fault.str().empty())
        throw NumericalError(fault.str());
      return {0, bytes};
    }

    /// Couplings below this fraction of the diagonal do not join nodes into ML's aggregates. At
    /// most .02, which suits finite elements, but below the strongest coupling of all but a few
    /// rows: rows of many small entries would otherwise not be coarsened at all.
    double aggregation_threshold(const Matrix &matrix, unsigned int n_components, const Team &team)
    {
      const Epetra_CrsMatrix &entries = matrix.trilinos_matrix();
      std::vector<double> strongest(entries.NumMyRows() + 1, 1); // one more, a rank may have none
      for (int i = 0; i < entries.NumMyRows(); ++i)
      {
        int size = 0, *column = nullptr;
        double *value = nullptr, coupling = 0, diagonal = 0;
        entries.ExtractMyRowView(i, size, value, column);
        for (int e = 0; e < size; ++e)
        {
          const int row = entries.GRID(i), other = entries.GCID(column[e]);
          if (other == row)
            diagonal = std::abs(value[e]);
          else if (other / n_components != row / n_components)
            coupling = std::max(coupling, std::abs(value[e]));
        }
        strongest[i] = coupling / diagonal;
      }
      const auto low = strongest.begin() + strongest.size() / 20;
      std::nth_element(strongest.begin(), low, strongest.end());
      return std::min(.02, .7 * dealii::Utilities::MPI::min(*low, team.communicator));
    }

    void check_diagonal(const Matrix &matrix, unsigned int n_components, const Team &team)
    {
      int bad = none;
      for (auto row = matrix.local_range().second; row-- > matrix.local_range().first;)
        if (matrix.el(row, row) == 0)
          bad = static_cast<int>(row);
      reject(bad, "has no diagonal entry, which iterations need; take the sparse solver direct",
             n_components, team);
    }

    std::unique_ptr<dealii::TrilinosWrappers::PreconditionBase>
    make_preconditioner(const Matrix &matrix, SparseSolver solver, unsigned int n_components,
                        const Team &team)
    {
      check_diagonal(matrix, n_components, team);
      if (solver == SparseSolver::jacobi)
      {
        auto jacobi = std::make_unique<dealii::TrilinosWrappers::PreconditionJacobi>();
        jacobi->initialize(matrix);
        return jacobi;
      }
      using AMG = dealii::TrilinosWrappers::PreconditionAMG;
      AMG::AdditionalData data; // elliptic, also if not symmetric: measured to be the more robust
      data.aggregation_threshold = aggregation_threshold(matrix, n_components, team);
      data.constant_modes.assign(n_components, std::vector<bool>(matrix.local_size()));
      for (std::size_t i = 0; i < matrix.local_size(); ++i)
        data.constant_modes[i % n_components][i] = true; // the share begins with a node
      auto amg = std::make_unique<AMG>();
      amg->initialize(matrix, data);
      return amg;
    }

    Work iterate(const Matrix &matrix, SparseSolver solver, Vector &x, const Vector &b,
                 const SparseOptions &options, const Team &team)
    {
      const std::size_t bytes_before = heap_bytes();
      const auto preconditioner = make_preconditioner(matrix, solver, options.n_components, team);
      const std::size_t bytes = heap_bytes() - bytes_before;
      using CG = dealii::SolverCG<Vector>;
      using GMRES = dealii::SolverGMRES<Vector>;
      const double scale = b.l2_norm();
      dealii::SolverControl control(options.max_iterations, options.tolerance * scale, false,
                                    false);
      try
      {
        if (options.is_symmetric)
          CG(control).solve(matrix, x, b, *preconditioner);
        else // preconditioned from the right: the residual watched is the true one
          GMRES(control, GMRES::AdditionalData(n_basis_vectors + 2, true))
              .solve(matrix, x, b, *preconditioner);
      }
      catch (const dealii::SolverControl::NoConvergence &)
      {
        std::ostringstream message;
        message << (options.is_symmetric ? "conjugate gradients stop" : "GMRES stops") << " after "
                << control.last_step() << " iterations (allowed: " << options.max_iterations
                << ") at the relative residual " << control.last_value() / scale << ", wanted "
                << options.tolerance
                << "; the system may be singular: tie all nodes to the boundary data, or take "
                   "another sparse solver";
        throw NumericalError(message.str());
      }
      return {control.last_step(), bytes};
    }

    SparseSolver choose(std::size_t n, std::uint64_t n_nonzeros)
    {
      if (n <= most_unknowns_for_direct)
        return SparseSolver::direct;
      const double row_length = static_cast<double>(n_nonzeros) / n;
      return n / row_length > multigrid_pays ? SparseSolver::amg : SparseSolver::jacobi;
    }

    const std::map<std::string, SparseSolver> solver_names = {
        {"automatic", SparseSolver::automatic},
        {"direct", SparseSolver::direct},
        {"amg", SparseSolver::amg},
        {"jacobi", SparseSolver::jacobi}};
  } // namespace

  SparseSolver sparse_solver_from_name(const std::string &name)
  {
    const auto solver = solver_names.find(name);
    if (solver == solver_names.end())
      throw InputError("sparse solver '" + name +
                       "' is not known; allowed are automatic, direct, amg and jacobi");
    return solver->second;
  }

  SparseSolution solve_sparse(const Rows &rows, const std::vector<double> &right_hand_side,
                              const SparseOptions &options, const base::Team &team)
  {
    const std::size_t n = right_hand_side.size();
    Assert(rows.n_rows() == n && n % options.n_components == 0, dealii::ExcInternalError());
    if (n == 0)
      return {};

    int bad = none;
    for (std::size_t i = 0; i < n; ++i)
    {
      double sum = right_hand_side[i];
      for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
        sum += rows.value[e];
      if (!std::isfinite(sum))
        bad = std::min<int>(bad, i);
    }
    reject(bad,
           "holds a value, in the matrix or the right-hand side, that is not a finite number; look "
           "at the kernel and the load there",
           options.n_components, team);

    const Shares shares(n, options.n_components, team);
    const Matrix matrix = assemble(rows, shares, options.n_components, team);
    Vector b(shares.own(), team.communicator), x(b), residual(b);
    MPI_Reduce_scatter(right_hand_side.data(), b.begin(), shares.size.data(), MPI_DOUBLE, MPI_SUM,
                       team.communicator);

    SparseSolution solution{};
    solution.n_nonzeros = matrix.n_nonzero_elements();
    const SparseSolver solver =
        options.solver == SparseSolver::automatic ? choose(n, solution.n_nonzeros) : options.solver;
    for (const auto &[name, named] : solver_names)
      if (named == solver)
        solution.solver = name;
    const double norm = b.l2_norm(), scale = norm > 0 ? norm : 1;
    const bool is_direct = solver == SparseSolver::direct;
    together(team,
             [&]
             {
               const Work work = is_direct ? solve_directly(matrix, x, b)
                                           : iterate(matrix, solver, x, b, options, team);
               solution.n_iterations = work.n_iterations;
               solution.bytes = matrix.memory_consumption() + work.bytes;
             });

    // A x cannot be computed more accurately than this
    const double round_off = 10 * eps * matrix.linfty_norm() * x.l2_norm() / scale;
    const double allowed = is_direct
                               ? largest_residual
                               : 10 * options.tolerance + std::min(round_off, largest_residual);
    solution.relative_residual = matrix.residual(residual, x, b) / scale;
    if (!(solution.relative_residual <= allowed))
    {
      std::ostringstream message;
      message << "the sparse solver " << solution.solver << " leaves the relative residual "
              << solution.relative_residual << ", allowed " << allowed
              << "; the system is singular or nearly so: tie all nodes to the boundary data";
      throw NumericalError(message.str());
    }
    solution.values.resize(n);
    MPI_Allgatherv(x.begin(), shares.size[shares.rank], MPI_DOUBLE, solution.values.data(),
                   shares.size.data(), shares.first.data(), MPI_DOUBLE, team.communicator);
    return solution;
  }
} // namespace plumbline::algebra
