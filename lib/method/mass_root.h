#pragma once

#include "algebra/csr_matrix.h"
#include "base/slabs.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace plumbline::method
{
  /// The mass matrix of trilinear functions on a box of nodes: factor T⊗T⊗T for each component, T
  /// tridiagonal with 1 on the diagonal and `off` beside it.
  struct ProductMass
  {
    std::array<int, 3> n{};
    unsigned int n_components = 1;
    double factor = 1, off = 0;
  };

  /// M = S Sᵀ of a symmetric positive definite mass matrix, by a sparse Cholesky factor, the
  /// product of factors along the axes, or square roots of masses: states Sᵀ u make the tangent of
  /// a symmetric operator symmetric, S⁻¹ A S⁻ᵀ. Exact to round-off.
  class MassRoot
  {
  public:
    using State = std::vector<double>;

    /// @param masses  of each unknown, > 0
    explicit MassRoot(std::vector<double> masses);

    /// @param n_blocks  M has so many of these on its diagonal
    /// @throws NumericalError  M is not positive definite
    explicit MassRoot(const algebra::CsrMatrix &block, unsigned int n_blocks = 1);

    /// @param mass  positive definite: |off| < 1/2, factor > 0
    /// @param slabs  of the planes of mass.n[2] nodes: vectors are this rank's then, shape
    ///               (n_components, n_owned, n[1], n[0]), and functions are collective
    explicit MassRoot(const ProductMass &mass, const std::optional<base::Slabs> &slabs = {});
    MassRoot(MassRoot &&) noexcept;
    ~MassRoot();

    State to_state(const State &u) const;    ///< Sᵀ u
    State to_unknowns(const State &x) const; ///< S⁻ᵀ x
    State of_force(const State &f) const;    ///< S⁻¹ f
    bool is_one() const { return is_one_; }  ///< states are unknowns

  private:
    struct Factor;
    struct Product;
    std::vector<double> roots_;        ///< of masses
    bool is_one_ = false;              ///< all of them
    std::unique_ptr<Factor> factor_;   ///< of a matrix
    std::unique_ptr<Product> product_; ///< of factors along the axes; both empty: there are roots
  };
} // namespace plumbline::method
