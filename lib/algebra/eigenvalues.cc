#include "algebra/eigenvalues.h"

#include "base/error.h"
#include "base/memory.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/identity_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace plumbline::algebra
{
  namespace
  {
    using dealii::ArpackSolver;
    using Complex = std::complex<double>;
    using Vector = dealii::Vector<double>;

    /// Residual that an eigenpair of norm 1 may have, relative to the largest row sum.
    constexpr double residual_tolerance = 1e-8;

    std::vector<Complex> dense_eigenvalues(const CsrMatrix &rows)
    {
      const auto n = static_cast<Eigen::Index>(rows.n_rows());
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          matrix(i, rows.column[k]) = rows.value[k];
      const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
      if (solver.info() != Eigen::Success)
        throw NumericalError("the eigenvalues of a matrix of " + std::to_string(n) +
                             " unknowns do not converge: look for values that are not finite");
      return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
    }

    struct Product
    {
      const CsrMatrix &rows;

      void vmult(Vector &y, const Vector &x) const
      {
        for (std::size_t i = 0; i < rows.n_rows(); ++i)
        {
          double sum = 0;
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            sum += rows.value[k] * x[rows.column[k]];
          y[i] = sum;
        }
      }
    };

    void require_numbers(const CsrMatrix &rows)
    {
      if (!std::all_of(rows.value.begin(), rows.value.end(),
                       [](double value) { return std::isfinite(value); }))
        throw NumericalError("a matrix of " + std::to_string(rows.n_rows()) +
                             " unknowns has entries that are no numbers, so that it has no "
                             "eigenvalues; look at its kernel and material");
    }

    /// Separators of a lattice of n nodes whose rows have k entries have √(n k / π) nodes, so their
    /// dense blocks sum up to n k log₂(n / k) entries; UMFPACK's peak, measured for n = 400 to
    /// 28,800 and horizons of 1.5 h to 6 h, is 7 to 18 bytes of each.
    void require_factors(const CsrMatrix &rows)
    {
      constexpr double of_entry = 13;
      const auto n = static_cast<double>(rows.n_rows());
      const auto n_entries = static_cast<double>(rows.value.size());
      const std::string fault = base::memory_fault(
          of_entry * n_entries * std::log2(2 + n * n / n_entries),
          "the eigenvalues of a matrix of " + std::to_string(rows.n_rows()) + " unknowns",
          "take a coarser level (--levels)");
      if (!fault.empty())
        throw NumericalError(fault);
    }

    /// Factors of A minus a shift.
    class Inverse
    {
    public:
      Inverse(const CsrMatrix &rows, double shift)
      {
        const auto n = static_cast<unsigned int>(rows.n_rows());
        require_numbers(rows);
        require_factors(rows);
        dealii::DynamicSparsityPattern places(n);
        for (unsigned int i = 0; i < n; ++i)
        {
          places.add_entries(i, rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i]),
                             rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i + 1]),
                             true);
          places.add(i, i);
        }
        dealii::SparsityPattern pattern;
        pattern.copy_from(places);
        dealii::SparseMatrix<double> matrix(pattern);
        for (unsigned int i = 0; i < n; ++i)
        {
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            matrix.set(i, rows.column[k], rows.value[k]);
          matrix.add(i, i, -shift);
        }
        try
        {
          factors_.initialize(matrix);
        }
        catch (const std::exception &)
        {
          throw NumericalError(
              "a matrix of " + std::to_string(n) +
              " unknowns has no sparse factors for its eigenvalues: it is singular, "
              "or memory is short; take a coarser level (--levels)");
        }
      }

      void vmult(Vector &y, const Vector &x) const { factors_.vmult(y, x); }

    private:
      dealii::SparseDirectUMFPACK factors_;
    };

    using Which = ArpackSolver::WhichEigenvalues;

    /// Eigenvalues of A, those of `action` that are outermost in the given sense.
    /// @param is_inverse  `action` is (A - shift)⁻¹, else A itself
    template <class Action>
    std::vector<Complex> arnoldi(const Product &matrix, double size, const Action &action,
                                 bool is_inverse, double shift, Which which, unsigned int n_wanted)
    {
      constexpr unsigned int n_vectors = 60, most_restarts = 1000;
      constexpr double tolerance = 1e-11; // of an eigenvalue of `action`, relative to it
      const auto n = static_cast<unsigned int>(matrix.rows.n_rows());
      dealii::SolverControl control(most_restarts, tolerance, false, false);
      ArpackSolver solver(control, ArpackSolver::AdditionalData(n_vectors, which));
      Vector start(n);
      for (unsigned int i = 0; i < n; ++i) // orthogonal to no eigenvector, most likely
        start[i] = 1 + .5 * std::sin(1. + double(i) * i);
      solver.set_initial_vector(start);
      // the solver takes its action for an inverse: of A itself it returns 1/λ
      solver.set_shift(is_inverse ? shift : 0);
      std::vector<Complex> values(n_wanted), found;
      std::vector<Vector> vectors(n_wanted + 1, start);
      solver.solve(matrix, dealii::IdentityMatrix(n), action, values, vectors, n_wanted);

      for (unsigned int i = 0; i < n_wanted; ++i)
      {
        const Complex value = is_inverse ? values[i] : 1. / values[i];
        const bool is_pair = value.imag() != 0; // the real and the imaginary part of its vector
        const Vector &x = vectors[i], &y = vectors[i + 1];
        Vector ax(n), ay(n);
        matrix.vmult(ax, x);
        ax.add(-value.real(), x);
        if (is_pair)
        {
          ax.add(value.imag(), y);
          matrix.vmult(ay, y);
          ay.add(-value.real(), y, -value.imag(), x);
        }
        const double norm = is_pair ? std::hypot(x.l2_norm(), y.l2_norm()) : x.l2_norm();
        if (std::hypot(ax.l2_norm(), ay.l2_norm()) <= residual_tolerance * size * norm)
        {
          found.push_back(value);
          if (is_pair)
            found.push_back(std::conj(value));
        }
        i += is_pair ? 1 : 0;
      }
      if (found.empty())
        throw NumericalError("Arnoldi's method does not settle for a matrix of " +
                             std::to_string(n) + " unknowns; take a coarser level (--levels)");
      return found;
    }
  } // namespace

  Eigenvalues eigenvalues(const CsrMatrix &rows)
  {
    constexpr std::size_t few = 100;        // dense is faster
    constexpr double relative_shift = 1e-8; // off zero modes, beyond rounding
    std::vector<Complex> found;
    if (rows.n_rows() <= few)
      found = dense_eigenvalues(rows);
    else
    {
      const Product matrix{rows};
      const double size = largest_row_sum(rows), shift = -relative_shift * size;
      const auto add = [&](const std::vector<Complex> &more)
      { found.insert(found.end(), more.begin(), more.end()); };
      add(arnoldi(matrix, size, Inverse(rows, shift), true, shift, ArpackSolver::largest_magnitude,
                  8));
      add(arnoldi(matrix, size, matrix, false, 0, ArpackSolver::smallest_real_part, 4));
      add(arnoldi(matrix, size, matrix, false, 0, ArpackSolver::largest_magnitude, 4));
    }
    Eigenvalues result;
    result.smallest_real = result.smallest_modulus = std::numeric_limits<double>::infinity();
    for (const Complex &value : found)
    {
      result.smallest_real = std::min(result.smallest_real, value.real());
      result.smallest_modulus = std::min(result.smallest_modulus, std::abs(value));
      result.largest_modulus = std::max(result.largest_modulus, std::abs(value));
      result.largest_imaginary = std::max(result.largest_imaginary, std::abs(value.imag()));
    }
    result.n_computed = found.size();
    return result;
  }
} // namespace plumbline::algebra
