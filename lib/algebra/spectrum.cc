#include "algebra/spectrum.h"

#include "base/error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
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

    struct Ends
    {
      double smallest, largest;
      VectorXd lowest;
    };

    /// The ends of the spectrum on what is orthogonal to the locked vectors.
    Ends lanczos(const Action &action, Index n, double largest_tolerance,
                 const std::vector<VectorXd> &locked)
    {
      constexpr double tolerance = 1e-11; // of the residual of the smallest, as of the largest
      constexpr double invariant = 1e-14; // what is left of a vector in an invariant subspace
      constexpr Index first_check = 20, least_limit = 1000, memory = 50000000;
      const Index limit =
          std::min(n - static_cast<Index>(locked.size()), std::max(least_limit, memory / n));
      Eigen::MatrixXd basis(n, std::min<Index>(limit, 4 * first_check));
      std::vector<double> alpha, beta, x(n), y(n);
      // that of the vectors before holds nothing more of the eigenspace they were found in
      VectorXd next = start_vector(n, locked.size());
      const auto orthogonalise = [&](Index n_basis)
      {
        for (int sweep = 0; sweep < 2; ++sweep) // twice is enough, once is not
        {
          for (const VectorXd &vector : locked)
            next -= vector.dot(next) * vector;
          const auto known = basis.leftCols(n_basis);
          next -= known * (known.transpose() * next).eval();
        }
      };
      orthogonalise(0);
      double norm = next.norm();
      Index next_check = first_check;
      for (Index k = 1; k <= limit; ++k)
      {
        if (k > basis.cols())
          basis.conservativeResize(Eigen::NoChange, std::min(limit, 2 * basis.cols()));
        basis.col(k - 1) = next / norm;
        VectorXd::Map(x.data(), n) = basis.col(k - 1);
        action(x, y);
        next = VectorXd::Map(y.data(), n);
        alpha.push_back(next.dot(basis.col(k - 1)));
        orthogonalise(k);
        norm = next.norm();
        const double size = std::abs(alpha[0]) + (beta.empty() ? 0 : beta[0]);
        const bool is_exhausted = k == limit || norm <= invariant * size;
        if (is_exhausted || k == next_check)
        {
          next_check += std::max(first_check, k / 4);
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
          ritz.computeFromTridiagonal(VectorXd::Map(alpha.data(), k),
                                      VectorXd::Map(beta.data(), k - 1));
          const auto &values = ritz.eigenvalues();
          const double largest = values.cwiseAbs().maxCoeff();
          const auto residual = [&](Index i)
          { return norm * std::abs(ritz.eigenvectors()(k - 1, i)) / largest; };
          const bool is_settled =
              norm <= invariant * size ||
              (residual(0) <= tolerance && residual(k - 1) <= largest_tolerance);
          if (is_settled && ritz.info() == Eigen::Success)
            return {values[0], values[k - 1], basis.leftCols(k) * ritz.eigenvectors().col(0)};
          if (is_exhausted)
            break;
        }
        beta.push_back(norm);
      }
      if (limit + static_cast<Index>(locked.size()) == n)
        throw NumericalError("Lanczos' method does not settle: the operator is not symmetric, or "
                             "yields values that are not finite");
      throw NumericalError("Lanczos' method does not settle within " + std::to_string(limit) +
                           " steps: eigenvalues lie too close for this many unknowns; take a "
                           "coarser level (--levels)");
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

    SparseMatrix to_sparse(const Rows &rows)
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
    std::size_t count_parts(const Rows &rows)
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
    std::size_t count_unreached(const Rows &columns, std::vector<char> is_reached)
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

    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }
  } // namespace

  Spectrum spectrum(const Action &symmetric, std::size_t n, double tolerance)
  {
    constexpr double zero = 1e-10; // relative to the largest eigenvalue
    const auto size = static_cast<Index>(n);
    std::vector<VectorXd> locked;
    Ends ends = lanczos(symmetric, size, tolerance, locked);
    Spectrum result{
        ends.smallest, ends.largest, {}, ends.smallest, {ends.lowest.begin(), ends.lowest.end()}};
    while (std::abs(ends.smallest) <= zero * std::abs(result.largest) &&
           locked.size() < std::min(most_zero_modes, n - 1))
    {
      locked.push_back(ends.lowest.normalized());
      result.zero_modes.emplace_back(locked.back().begin(), locked.back().end());
      ends = lanczos(symmetric, size, tolerance, locked);
      result.smallest_nonzero = ends.smallest;
    }
    return result;
  }

  SignCheck check_signs(const Rows &rows)
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
    const Rows columns = transpose(rows);
    Rows negative = columns;
    for (double &value : negative.value)
      value = -value;
    const double size = largest(rows.value);
    check.asymmetry = size > 0 ? largest(add(rows, negative).value) / size : 0;
    check.n_parts = count_parts(rows);
    check.n_loose = count_unreached(columns, is_strict);
    return check;
  }

  Action restrict(std::shared_ptr<const Operator> matrix, std::size_t n,
                  std::vector<std::size_t> positions)
  {
    return [matrix = std::move(matrix), n,
            positions = std::move(positions)](const std::vector<double> &x, std::vector<double> &y)
    {
      Vector in(n), out(n);
      for (std::size_t i = 0; i < positions.size(); ++i)
        in[positions[i]] = x[i];
      matrix->vmult(out, in);
      for (std::size_t i = 0; i < positions.size(); ++i)
        y[i] = out[positions[i]];
    };
  }

  MatrixCheck check_matrix(const Rows &rows)
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
