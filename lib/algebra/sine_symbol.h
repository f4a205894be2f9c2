#pragma once

#include "algebra/stencil.h"

#include <array>
#include <utility>
#include <vector>

namespace plumbline::algebra
{
  /// The symbol of a component's diagonal block at the modes of sine transforms on a box of nodes:
  /// λ(p) = Σ_k A_cc(k) Π_d cos(k_d θ_d), θ_d = π (p_d + 1) / (n_d + 1).
  /// @param n     nodes along each axis
  /// @param rows  modes [first, second) along the second axis; all along the others
  /// @return      shape (n[2], n_rows, n[0])
  std::vector<double> sine_symbol(const Stencil &stencil, unsigned int component,
                                  const std::array<int, 3> &n, const std::pair<int, int> &rows);

  /// @param least, largest  of a symbol
  /// @throws NumericalError  the least is not positive: the stencil is not coercive
  void check_positive(double least, double largest);
} // namespace plumbline::algebra
