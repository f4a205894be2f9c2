#pragma once

#include "algebra/csr_matrix.h"

#include <memory>
#include <optional>

namespace plumbline::algebra
{
  /// A sparse symmetric positive definite matrix A = Cᵀ diag(s) C, factored once (CHOLMOD,
  /// supernodal), and solutions with A + Uᵀ S U for few rows of U that are added one after the
  /// other, without another factorisation:
  ///   x = x₀ - Z w,  (I + S U Z) w = S (U x₀ + o),  Z = A⁻¹Uᵀ  (Woodbury).
  /// Cost: a solve for each row of U and (8/3) r³ flops for each S, then 2 n r for a solution, r
  /// rows. The same calls give the same bits. Source: Hager 1989, doi:10.1137/1031049.
  class UpdatedCholesky
  {
  public:
    /// @param terms    C, shape (n_terms, n)
    /// @param factors  s, of any sign
    /// @return         empty: A is not positive definite, to 1e-13 of its condition as its factor
    ///                 shows it
    static std::optional<UpdatedCholesky> factor(const CsrMatrix &terms,
                                                 const std::vector<double> &factors, std::size_t n);
    UpdatedCholesky(UpdatedCholesky &&) noexcept;
    UpdatedCholesky &operator=(UpdatedCholesky &&) noexcept;
    ~UpdatedCholesky();

    std::size_t n() const;

    /// A⁻¹ b
    std::vector<double> solve(const std::vector<double> &b) const;

    /// Add rows to U, and take another S.
    /// @param S  symmetric, shape (rank, rank), of all rows
    void update(const CsrMatrix &rows, const std::vector<double> &S);
    std::size_t rank() const; ///< rows of U

    /// The solution x of (A + Uᵀ S U) x = b - Uᵀ S o.
    /// @param x0  A⁻¹ b
    /// @param o   shape (rank)
    /// @return    empty: A + Uᵀ S U is singular, to 1e-13 of its condition on U
    std::optional<std::vector<double>> updated(const std::vector<double> &x0,
                                               const std::vector<double> &o) const;

    // CPU seconds that these take on one core, estimated from counts of operations with rates that
    // were measured on one machine: the same wherever it runs, so that what is decided by them is.
    double factor_seconds() const;                   ///< the constructor
    double append_seconds() const;                   ///< a row of an update
    double update_seconds(std::size_t rank) const;   ///< the rest of it
    double solution_seconds(std::size_t rank) const; ///< what its rows add to a solution

  private:
    struct Factor;
    explicit UpdatedCholesky(std::unique_ptr<Factor> factor);
    std::unique_ptr<Factor> factor_;
  };

  /// A vector of norm 1 that a positive semidefinite A = Cᵀ diag(s) C takes to zero, to 1e-8 of the
  /// largest factor, by inverse iteration; empty where there is none.
  std::optional<std::vector<double>> zero_mode(const CsrMatrix &terms,
                                               const std::vector<double> &factors, std::size_t n);
} // namespace plumbline::algebra
