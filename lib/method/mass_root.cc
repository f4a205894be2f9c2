#include "method/mass_root.h"

#include "base/error.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using State = MassRoot::State;

    Eigen::Map<const Eigen::VectorXd> view(const State &x)
    {
      return {x.data(), static_cast<Eigen::Index>(x.size())};
    }

    State values(const Eigen::VectorXd &x)
    {
      return {x.data(), x.data() + x.size()};
    }

    Eigen::SparseMatrix<double> to_matrix(const algebra::CsrMatrix &rows)
    {
      const auto n = static_cast<Eigen::Index>(rows.n_rows());
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(rows.column[k]),
                               rows.value[k]);
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }
  } // namespace

  struct MassRoot::Factor
  {
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> permuted;
    Eigen::SparseMatrix<double> lower;
  };

  MassRoot::MassRoot(std::vector<double> masses) : roots_(std::move(masses))
  {
    for (double &root : roots_)
      root = std::sqrt(root);
    is_one_ = std::all_of(roots_.begin(), roots_.end(), [](double root) { return root == 1; });
  }

  MassRoot::MassRoot(const algebra::CsrMatrix &matrix) : factor_(std::make_unique<Factor>())
  {
    factor_->permuted.compute(to_matrix(matrix));
    if (factor_->permuted.info() != Eigen::Success)
      throw NumericalError("the mass matrix is not positive definite");
    factor_->lower = factor_->permuted.matrixL();
  }

  MassRoot::MassRoot(MassRoot &&) noexcept = default;
  MassRoot::~MassRoot() = default;

  State MassRoot::to_state(const State &u) const
  {
    if (factor_)
      return values(factor_->lower.transpose() * (factor_->permuted.permutationP() * view(u)));
    State x = u;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] *= roots_[i];
    return x;
  }

  State MassRoot::to_unknowns(const State &x) const
  {
    if (factor_)
      return values(factor_->permuted.permutationPinv() *
                    factor_->lower.transpose().triangularView<Eigen::Upper>().solve(view(x)));
    return of_force(x);
  }

  State MassRoot::of_force(const State &f) const
  {
    if (factor_)
      return values(factor_->lower.triangularView<Eigen::Lower>().solve(
          factor_->permuted.permutationP() * view(f)));
    State x = f;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] /= roots_[i];
    return x;
  }
} // namespace plumbline::method
