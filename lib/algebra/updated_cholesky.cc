#include "algebra/updated_cholesky.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    using Sparse = Eigen::SparseMatrix<double>;
    using Dense = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    /// Of a factor, and of I + S U Z: below that what is left of it is rounding.
    constexpr double least_condition = 1e-13;

    /// Columns of Z in a product: of more, Eigen reads a few rows at a time, 3 times slower.
    constexpr Eigen::Index n_together = 8;

    class Cholesky : public Eigen::CholmodSupernodalLLT<Sparse>
    {
    public:
      /// (least / largest of its diagonal)², an upper bound of its reciprocal condition.
      double condition() { return cholmod_rcond(m_cholmodFactor, &cholmod()); }
    };

    Sparse to_sparse(const CsrMatrix &rows, std::size_t n)
    {
      std::vector<Eigen::Triplet<double>> entries;
      entries.reserve(rows.value.size());
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(rows.column[k]),
                               rows.value[k]);
      Sparse matrix(static_cast<int>(rows.n_rows()), static_cast<int>(n));
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    Eigen::Map<const Vector> view(const std::vector<double> &x)
    {
      return {x.data(), static_cast<Eigen::Index>(x.size())};
    }

    std::vector<double> to_vector(const Vector &x)
    {
      return {x.data(), x.data() + x.size()};
    }
  } // namespace

  struct UpdatedCholesky::Factor
  {
    mutable Cholesky cholesky; // a solution uses its workspace
    Eigen::Index n = 0, rank = 0;
    Dense Z, C; ///< the first `rank` columns count
    Dense S;
    std::optional<Eigen::PartialPivLU<Dense>> small; ///< I + S U Z, unless it is singular
    std::vector<Vector> rows;                        ///< values of the rows of U
    std::vector<std::vector<int>> columns;

    double dot(std::size_t row, const double *x) const
    {
      double sum = 0;
      for (std::size_t k = 0; k < columns[row].size(); ++k)
        sum += rows[row][static_cast<Eigen::Index>(k)] * x[columns[row][k]];
      return sum;
    }

    void reserve(Eigen::Index wanted)
    {
      if (wanted <= Z.cols())
        return;
      const Eigen::Index room = std::max<Eigen::Index>(2 * Z.cols(), wanted + 16);
      Z.conservativeResize(n, room);
      C.conservativeResize(room, room);
    }
  };

  std::optional<UpdatedCholesky>
  UpdatedCholesky::factor(const CsrMatrix &terms, const std::vector<double> &factors, std::size_t n)
  {
    const Sparse C = to_sparse(terms, n);
    const Sparse scaled = view(factors).asDiagonal() * C;
    const Sparse matrix = Sparse(C.transpose()) * scaled;
    auto result = std::make_unique<Factor>();
    result->n = static_cast<Eigen::Index>(n);
    result->cholesky.cholmod().print = 0; // it has its say by its status
    result->cholesky.compute(matrix);
    if (result->cholesky.info() != Eigen::Success ||
        !(result->cholesky.condition() > least_condition))
      return {};
    return UpdatedCholesky(std::move(result));
  }

  UpdatedCholesky::UpdatedCholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
  UpdatedCholesky::UpdatedCholesky(UpdatedCholesky &&) noexcept = default;
  UpdatedCholesky &UpdatedCholesky::operator=(UpdatedCholesky &&) noexcept = default;
  UpdatedCholesky::~UpdatedCholesky() = default;

  std::size_t UpdatedCholesky::n() const
  {
    return static_cast<std::size_t>(factor_->n);
  }

  std::size_t UpdatedCholesky::rank() const
  {
    return static_cast<std::size_t>(factor_->rank);
  }

  std::vector<double> UpdatedCholesky::solve(const std::vector<double> &b) const
  {
    return to_vector(factor_->cholesky.solve(view(b)));
  }

  void UpdatedCholesky::update(const CsrMatrix &rows, const std::vector<double> &S)
  {
    Factor &f = *factor_;
    const auto n_new = static_cast<Eigen::Index>(rows.n_rows());
    const Eigen::Index all = f.rank + n_new;
    if (all == 0)
      return;
    f.reserve(all);
    if (n_new > 0)
      f.Z.middleCols(f.rank, n_new) = f.cholesky.solve(Dense(to_sparse(rows, n()).transpose()));
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      const auto begin = static_cast<std::ptrdiff_t>(rows.start[i]),
                 end = static_cast<std::ptrdiff_t>(rows.start[i + 1]);
      f.columns.emplace_back(rows.column.begin() + begin, rows.column.begin() + end);
      f.rows.emplace_back(Eigen::Map<const Vector>(rows.value.data() + begin, end - begin));
    }
    for (Eigen::Index j = f.rank; j < all; ++j)
      for (Eigen::Index i = 0; i <= j; ++i)
        f.C(i, j) = f.C(j, i) = f.dot(static_cast<std::size_t>(i), f.Z.col(j).data());
    f.rank = all;
    f.S = Eigen::Map<const Dense>(S.data(), all, all);
    const Dense matrix = Dense::Identity(all, all) + f.S * f.C.topLeftCorner(all, all);
    f.small.emplace(matrix);
    // of what it was as well, which is I: a matrix of one entry is never far from singular by
    // itself
    const double norm = matrix.cwiseAbs().colwise().sum().maxCoeff();
    if (!(f.small->rcond() * std::min(1., norm) > least_condition))
      f.small.reset();
  }

  std::optional<std::vector<double>> UpdatedCholesky::updated(const std::vector<double> &x0,
                                                              const std::vector<double> &o) const
  {
    const Factor &f = *factor_;
    const Eigen::Index r = f.rank;
    if (r == 0)
      return x0;
    if (!f.small)
      return {};
    Vector known(r);
    for (Eigen::Index i = 0; i < r; ++i)
      known[i] = f.dot(static_cast<std::size_t>(i), x0.data()) + o[static_cast<std::size_t>(i)];
    const Vector w = f.small->solve(f.S * known);
    Vector x = view(x0);
    for (Eigen::Index j = 0; j < r; j += n_together) // each column is read from end to end
    {
      const Eigen::Index n = std::min(n_together, r - j);
      x.noalias() -= f.Z.middleCols(j, n) * w.segment(j, n);
    }
    return to_vector(x);
  }

  double UpdatedCholesky::factor_seconds() const
  {
    constexpr double seconds_per_flop = 1 / 4e9;
    return seconds_per_flop * factor_->cholesky.cholmod().fl;
  }

  double UpdatedCholesky::append_seconds() const
  {
    constexpr double seconds_per_entry = 2e-9; // of the factor, forwards and back
    return seconds_per_entry * factor_->cholesky.cholmod().lnz;
  }

  double UpdatedCholesky::update_seconds(std::size_t rank) const
  {
    constexpr double seconds_per_flop = 1 / 5e9;
    const auto r = static_cast<double>(rank);
    return seconds_per_flop * (2 + 2. / 3) * r * r * r;
  }

  double UpdatedCholesky::solution_seconds(std::size_t rank) const
  {
    constexpr double seconds_per_product = 1 / 2.5e9;
    const auto r = static_cast<double>(rank);
    return seconds_per_product * (static_cast<double>(factor_->n) * r + 2 * r * r);
  }

  std::optional<std::vector<double>> zero_mode(const CsrMatrix &terms,
                                               const std::vector<double> &factors, std::size_t n)
  {
    // shifted by so much, the mode grows by 1e4 a step and more against one of 1e-5 of the scale
    constexpr double shift = 1e-9, tolerance = 1e-8;
    constexpr unsigned int n_steps = 4;
    double scale = 0;
    for (const double factor : factors)
      scale = std::max(scale, std::abs(factor));
    CsrMatrix shifted = terms;
    std::vector<double> all = factors;
    for (std::size_t i = 0; i < n; ++i)
    {
      shifted.column.push_back(static_cast<unsigned int>(i));
      shifted.value.push_back(1);
      shifted.start.push_back(shifted.column.size());
      all.push_back(shift * scale);
    }
    const auto inverse = UpdatedCholesky::factor(shifted, all, n);
    if (!inverse)
      return {};
    Vector x(static_cast<Eigen::Index>(n)); // without any pattern that a mode could be normal to
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] = 1 + std::sin(static_cast<double>(i * i % 1009));
    for (unsigned int step = 0; step < n_steps; ++step)
      x = view(inverse->solve(to_vector(x / x.norm())));
    x /= x.norm();
    const Vector strained = to_sparse(terms, n) * x;
    if (!(strained.cwiseProduct(view(factors)).norm() <= tolerance * scale))
      return {};
    return to_vector(x);
  }
} // namespace plumbline::algebra
