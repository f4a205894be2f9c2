#pragma once

#include "algebra/stencil.h"

#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Tensor;

  /// A neighbour of every node of a lattice, if it is in the body.
  struct Neighbour
  {
    std::array<int, 2> k; ///< lattice steps to it
    Tensor<1, 2> d;       ///< the way to it [length]
    double weight = 0;    ///< w ρ
  };

  int reach(const std::vector<Neighbour> &family);

  /// Σ_j weight(j - i) field_j, an even weight.
  /// @param field  shape (n[1], n[0])
  std::vector<double> correlate(const std::vector<Neighbour> &family, std::array<int, 2> n,
                                const std::vector<double> &field,
                                const std::function<double(const Neighbour &)> &weight);

  /// All sums of a state-based solid: of a displacement v and a dilatation s,
  ///   Σ_j w ρ (d⊗d/r² v_j - d s_j)  and  Σ_j w ρ d·v_j.
  algebra::Stencil state_stencil(const std::vector<Neighbour> &family);

  /// Applies a stencil of three blocks in which two, a displacement, are even among each other and
  /// odd against the third, a dilatation, which does not act on itself. By opposite pairs of bonds,
  /// each loaded once for a register's worth of nodes. Wins over transforms when the reach is
  /// small.
  class DirectSums
  {
  public:
    /// @pre A_ab(-k) = A_ab(k) = A_ba(k), A_2a(-k) = -A_2a(k) = A_a2(k), A_22 = 0, A(0) = 0
    DirectSums(const algebra::Stencil &stencil, std::array<int, 2> n);

    /// @param input, output  shape (3, n[1], n[0]); input counts as 0 outside
    void apply(const double *input, double *output) const;

    /// Estimated seconds an apply takes on one core, to choose a backend (measured on one machine).
    static double estimated_seconds(const algebra::Stencil &stencil, std::array<int, 2> n);

  private:
    struct Pair
    {
      std::ptrdiff_t shift;       ///< from a node to its neighbour in the padded fields
      std::array<double, 3> even; ///< A_00, A_01, A_11
      std::array<double, 2> odd;  ///< A_20, A_21
    };

    std::array<int, 2> n_;
    int reach_;
    std::size_t width_, block_size_; ///< of the padded fields
    std::vector<Pair> pairs_;
    mutable std::vector<double> padded_; ///< shape (3, n[1] + 2 reach, width)
  };
} // namespace plumbline::meshfree
