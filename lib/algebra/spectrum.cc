#include "algebra/spectrum.h"

#include "algebra/asymmetry.h"
#include "base/error.h"
#include "base/symmetric_eigen.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/identity_matrix.h>
#include <deal.II/lac/vector.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numeric>

namespace plumbline::algebra
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;

    /// Orthogonal to no eigenvector, most likely; independent of those of other numbers.
    VectorXd start_vector(Index n, std::size_t number = 0)
    {
      VectorXd x(n);
      for (Index i = 0; i < n; ++i)
        x[i] = 1 + .5 * std::sin((1. + static_cast<double>(number)) *
                                 (1. + static_cast<double>(i) * static_cast<double>(i)));
      return x;
    }

    using DealVector = dealii::Vector<double>;

    struct Eigenpair
    {
      double value = 0;
      VectorXd vector; ///< of norm 1
    };

    /// For few unknowns.
    Eigenpair largest_of_dense(const Action &action, Index n)
    {
      Eigen::MatrixXd matrix(n, n);
      std::vector<double> x(n), y(n);
      for (Index i = 0; i < n; ++i)
      {
        x[i] = 1;
        action(x, y);
        matrix.col(i) = VectorXd::Map(y.data(), n);
        x[i] = 0;
      }
      const auto eigen = base::symmetric_eigen(matrix);
      return {eigen.values[n - 1], eigen.vectors.col(n - 1)};
    }

    struct Product
    {
      const Action &action;

      void vmult(DealVector &y, const DealVector &x) const
      {
        std::vector<double> in(x.begin(), x.end()), out(in.size());
        action(in, out);
        std::copy(out.begin(), out.end(), y.begin());
      }
    };

    Eigenpair largest_by_arpack(const Action &action, Index n, double tolerance, std::size_t number)
    {
      constexpr unsigned int n_vectors = 40, most_restarts = 1000;
      const auto size = static_cast<unsigned int>(n);
      dealii::SolverControl control(most_restarts, tolerance, false, false);
      dealii::ArpackSolver solver(
          control, dealii::ArpackSolver::AdditionalData(
                       n_vectors, dealii::ArpackSolver::algebraically_largest, true));
      const VectorXd start = start_vector(n, number);
      solver.set_initial_vector(DealVector(start.begin(), start.end()));
      solver.set_shift(0); // the solver takes the operator for an inverse and returns 1/λ
      std::vector<std::complex<double>> values(1);
      std::vector<DealVector> vectors(1, DealVector(size));
      const Product product{action};
      solver.solve(product, dealii::IdentityMatrix(size), product, values, vectors, 1);
      return {1 / values[0].real(), VectorXd::Map(vectors[0].begin(), n).normalized()};
    }

    /// @param tolerance  of the residual, relative to the eigenvalue
    /// @param number     that of the vectors found before holds nothing more of their eigenspace
    Eigenpair largest_eigenpair(const Action &action, Index n, double tolerance,
                                std::size_t number = 0)
    {
      constexpr Index few = 100;    // dense is faster
      constexpr double slack = 100; // of the residual as it is against ARPACK's estimate of it
      const Eigenpair pair =
          n <= few ? largest_of_dense(action, n) : largest_by_arpack(action, n, tolerance, number);
      std::vector<double> x(pair.vector.begin(), pair.vector.end()), y(x.size());
      action(x, y);
      const double residual = (VectorXd::Map(y.data(), n) - pair.value * pair.vector).norm();
      if (!(residual <= slack * tolerance * std::abs(pair.value))) // not a number, too
        throw NumericalError("the ends of the spectrum of " + std::to_string(n) +
                             " unknowns do not settle: the operator is not symmetric, yields "
                             "values that are not finite, or its eigenvalues lie too close; take a "
                             "coarser level (--levels)");
      return pair;
    }

    /// Triangular factors of a symmetric matrix minus a shift.
    struct Factors
    {
      Eigen::SimplicialLDLT<SparseMatrix> ldlt;

      Factors(const SparseMatrix &matrix, double shift)
      {
        ldlt.setShift(-shift);
        ldlt.compute(matrix);
        if (ldlt.info() != Eigen::Success)
          throw NumericalError("the symmetric part of the matrix has no factors L D L^T; look for "
                               "nodes whose weights are all zero");
      }

      /// Eigenvalues below the shift, by Sylvester's law of inertia.
      std::size_t n_below() const
      {
        return static_cast<std::size_t>((ldlt.vectorD().array() < 0).count());
      }

      /// The eigenvalue nearest to the shift.
      double nearest_eigenvalue(const SparseMatrix &matrix) const
      {
        constexpr int most_iterations = 2000;
        constexpr double tolerance = 1e-12; // of the change in one iteration
        VectorXd x = start_vector(matrix.rows());
        double value = std::numeric_limits<double>::infinity();
        for (int iteration = 0; iteration < most_iterations; ++iteration)
        {
          x = ldlt.solve(x).eval();
          x.normalize();
          const double before = value;
          value = x.dot(matrix * x);
          if (std::abs(value - before) <= tolerance * std::abs(value))
            break;
        }
        return value;
      }
    };

    SparseMatrix to_sparse(const CsrMatrix &rows)
    {
      const auto n = static_cast<Index>(rows.n_rows());
      std::vector<Eigen::Triplet<double>> entries;
      for (unsigned int i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          entries.emplace_back(i, rows.column[k], rows.value[k]);
      SparseMatrix matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    /// How many connected parts the graph of the matrix has, by merging them edge by edge.
    std::size_t count_parts(const CsrMatrix &rows)
    {
      std::vector<unsigned int> parent(rows.n_rows());
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&](unsigned int i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      };
      std::size_t n_parts = rows.n_rows();
      for (unsigned int i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          if (rows.value[k] != 0)
            if (const unsigned int a = root(i), b = root(rows.column[k]); a != b)
            {
              parent[a] = b;
              --n_parts;
            }
      return n_parts;
    }

    /// Rows from which no chain of entries leads to one that is marked.
    /// @param columns  the transposed matrix
    std::size_t count_unreached(const CsrMatrix &columns, std::vector<char> is_reached)
    {
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < is_reached.size(); ++i)
        if (is_reached[i] != 0)
          open.push_back(i);
      std::size_t n_reached = open.size();
      while (!open.empty())
      {
        const std::size_t j = open.back();
        open.pop_back();
        for (std::size_t k = columns.start[j]; k < columns.start[j + 1]; ++k)
          if (const unsigned int i = columns.column[k]; columns.value[k] != 0 && is_reached[i] == 0)
          {
            is_reached[i] = 1;
            open.push_back(i);
            ++n_reached;
          }
      }
      return is_reached.size() - n_reached;
    }
  } // namespace

  Spectrum spectrum(const Action &symmetric, std::size_t n, double tolerance)
  {
    constexpr double zero = 1e-10;             // relative to the largest eigenvalue
    constexpr double lowest_tolerance = 1e-11; // the same
    const auto size = static_cast<Index>(n);
    const double largest = largest_eigenpair(symmetric, size, tolerance).value;
    std::vector<VectorXd> locked;
    // largest - A, less what is known: its largest eigenvalue is the smallest of the others
    const Action turned = [&](const std::vector<double> &x, std::vector<double> &y)
    {
      symmetric(x, y);
      auto out = VectorXd::Map(y.data(), size);
      const auto in = VectorXd::Map(x.data(), size);
      out = largest * in - out;
      for (const VectorXd &mode : locked)
        out -= largest * mode.dot(in) * mode;
    };
    const auto lowest = [&]
    {
      Eigenpair pair = largest_eigenpair(turned, size, lowest_tolerance, locked.size());
      pair.value = largest - pair.value;
      return pair;
    };
    Eigenpair pair = lowest();
    Spectrum result{pair.value, largest, {}, pair.value, {pair.vector.begin(), pair.vector.end()}};
    while (std::abs(pair.value) <= zero * std::abs(largest) &&
           locked.size() < std::min(most_zero_modes, n - 1))
    {
      locked.push_back(pair.vector);
      result.zero_modes.emplace_back(pair.vector.begin(), pair.vector.end());
      pair = lowest();
      result.smallest_nonzero = pair.value;
    }
    return result;
  }

  SignCheck check_signs(const CsrMatrix &rows)
  {
    constexpr double rounding = 1e-12; // of a row's sum
    SignCheck check;
    std::vector<char> is_strict(rows.n_rows());
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
    {
      double diagonal = 0, others = 0, largest_other = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const double value = rows.value[k];
        if (rows.column[k] == i)
          diagonal = value;
        else
        {
          others += std::abs(value);
          largest_other = std::max(largest_other, value);
        }
      }
      const double sum = std::abs(diagonal) + others;
      check.n_positive += largest_other > rounding * sum ? 1 : 0;
      check.n_weak += diagonal < others - rounding * sum ? 1 : 0;
      is_strict[i] = static_cast<char>(diagonal > others + rounding * sum);
    }
    const CsrMatrix columns = transpose(rows);
    check.asymmetry = asymmetry(rows);
    check.n_parts = count_parts(rows);
    check.n_loose = count_unreached(columns, is_strict);
    return check;
  }

  Action restrict(std::shared_ptr<const Operator> matrix, std::size_t n,
                  std::vector<std::size_t> positions)
  {
    struct Work
    {
      std::shared_ptr<const Operator> matrix;
      Vector in, out; ///< made once: memory that is given back costs more than sums
    };
    const auto work = std::make_shared<Work>(Work{std::move(matrix), Vector(n), Vector(n)});
    if (positions.size() == n && std::is_sorted(positions.begin(), positions.end())) // all
      return [work](const std::vector<double> &x, std::vector<double> &y)
      {
        std::copy(x.begin(), x.end(), work->in.begin());
        work->matrix->vmult(work->out, work->in);
        std::copy(work->out.begin(), work->out.end(), y.begin());
      };
    return [work, positions = std::move(positions)](const std::vector<double> &x,
                                                    std::vector<double> &y)
    {
      for (std::size_t i = 0; i < positions.size(); ++i)
        work->in[positions[i]] = x[i];
      work->matrix->vmult(work->out, work->in);
      for (std::size_t i = 0; i < positions.size(); ++i)
        y[i] = work->out[positions[i]];
    };
  }

  MatrixCheck check_matrix(const CsrMatrix &rows)
  {
    MatrixCheck check{check_signs(rows)};
    SparseMatrix matrix = to_sparse(rows);
    matrix = (.5 * (matrix + SparseMatrix(matrix.transpose()))).eval();
    const double largest_sum = largest_row_sum(rows);

    // the smallest eigenvalue is the one nearest to a shift that none is below
    auto factors = std::make_unique<Factors>(matrix, 1e-14 * largest_sum);
    check.n_negative_eigenvalues = factors->n_below();
    for (double shift = -1e-6 * largest_sum; factors->n_below() > 0; shift *= 4)
      factors = std::make_unique<Factors>(matrix, shift);
    check.smallest_eigenvalue = factors->nearest_eigenvalue(matrix);
    return check;
  }
} // namespace plumbline::algebra
