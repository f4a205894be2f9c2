#pragma once

#include "algebra/linear_system.h"

#include <vector>

namespace plumbline::algebra
{
  /// A stencil along one axis on several families of nodes, factored once: A = L Lᵀ of the free
  /// unknowns, numbered cell by cell, whose band is (reach + 1) n_blocks wide. Products are direct
  /// sums. Cost: n band² flops for the factor, 4 n band for a solution.
  class BandedSystem : public LinearSystem
  {
  public:
    /// @param n        positions of each family; vectors have shape (n_blocks, n)
    /// @param is_free  of the same shape
    /// @pre  the reaches along the second and third axis are 0
    /// @throws NumericalError  the stencil is not symmetric or not positive definite
    BandedSystem(const Stencil &stencil, int n, const std::vector<char> &is_free);

    void vmult(Vector &y, const Vector &x) const override;
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    void factor();
    double *row(std::size_t i) { return factor_.data() + i * (band_ + 1); }
    const double *row(std::size_t i) const { return factor_.data() + i * (band_ + 1); }

    Stencil stencil_;
    int n_;
    std::vector<char> is_free_;
    std::vector<std::size_t> place_; ///< of each unknown in vectors
    std::size_t band_ = 0;           ///< entries of a row of L left of the diagonal
    std::vector<double> factor_;     ///< rows of L from column i - band on, shape (n, band + 1)
  };

  /// Σ_k A(k) g(i + k) at the free nodes of a line.
  /// @param data  shape (n_blocks, n + 2 reach)
  Vector line_action(const Stencil &stencil, int n, const std::vector<char> &is_free,
                     const std::vector<double> &data);
} // namespace plumbline::algebra
