#pragma once

#include "algebra/csr_matrix.h"

#include <memory>
#include <vector>

namespace plumbline::method
{
  /// M = S Sᵀ of a symmetric positive definite mass matrix, by a sparse Cholesky factor, or square
  /// roots of masses: states Sᵀ u make the tangent of a symmetric operator symmetric, S⁻¹ A S⁻ᵀ.
  /// Exact to round-off.
  class MassRoot
  {
  public:
    using State = std::vector<double>;

    /// @param masses  of each unknown, > 0
    explicit MassRoot(std::vector<double> masses);

    /// @throws NumericalError  M is not positive definite
    explicit MassRoot(const algebra::CsrMatrix &matrix);
    MassRoot(MassRoot &&) noexcept;
    ~MassRoot();

    State to_state(const State &u) const;    ///< Sᵀ u
    State to_unknowns(const State &x) const; ///< S⁻ᵀ x
    State of_force(const State &f) const;    ///< S⁻¹ f
    bool is_one() const { return is_one_; }  ///< states are unknowns

  private:
    struct Factor;
    std::vector<double> roots_;      ///< of masses
    bool is_one_ = false;            ///< all of them
    std::unique_ptr<Factor> factor_; ///< of a matrix; empty: there are roots
  };
} // namespace plumbline::method
