#pragma once

#include "algebra/stencil.h"

#include <array>
#include <cmath>
#include <vector>

namespace plumbline::algebra
{
  /// A vector of length 1, or a place [cells]; in the plane its third coordinate is 0.
  using Vector3 = std::array<double, 3>;

  /// The direction in the plane at an angle from the first axis [radian].
  inline Vector3 in_plane(double angle)
  {
    return {std::cos(angle), std::sin(angle), 0};
  }

  /// M ü = -A u on an unbounded lattice, A and M translation-invariant and symmetric.
  struct WaveOperator
  {
    double h = 0;      ///< of the lattice [length]
    Stencil stiffness; ///< A; its blocks are component · n_families + family
    Stencil mass;      ///< M, the same blocks, positive definite
    unsigned int n_components = 1;
    std::vector<Vector3> places; ///< of each family in its cell [cells]

    unsigned int n_families() const { return static_cast<unsigned int>(places.size()); }
  };

  /// A plane wave a e^{i(k·x - ωt)} at the nodes.
  struct PlaneWave
  {
    double squared = 0; ///< ω² [1/time^2]; negative: it grows
    double slope = 0;   ///< dω²/d|k| along the wave's direction; 2 ω times the group speed in it
  };

  /// The ends of ω² over all waves that a lattice can carry.
  struct SymbolRange
  {
    double least = 0;   ///< of a grid: 0 to round-off, or negative where some wave grows
    double largest = 0; ///< to 1e-12
  };

  /// The symbol of a wave operator: the Hermitian matrices Σ_j A_st(j) e^{ik·(j + x_t - x_s)h}, x
  /// the families' places, and those of M; ω² are their generalised eigenvalues, and dω²/dk =
  /// v*(A' - ω²M')v for an eigenvector v*Mv = 1 (Hellmann & Feynman). With several families on a
  /// cell there are as many waves at each k; those given are the acoustic ones: the eigenvectors
  /// nearest, in M, to a plane wave's values at the nodes.
  class Symbol
  {
  public:
    /// @throws NumericalError  A or M is not symmetric to 1e-10
    explicit Symbol(WaveOperator waves);

    /// One wave for each component, by polarisation: n first, then perpendicular to n; in three
    /// dimensions e_3 × n (e_1 if n is parallel to e_3), then n × this vector.
    /// @param k  wave number > 0 [1/length]
    /// @throws NumericalError  M is not positive definite
    std::vector<PlaneWave> waves(double k, const Vector3 &n) const;

    /// ω²/k² as k → 0, squares of the speeds of long waves, in the same order: second moments where
    /// there is one family, and by second-order perturbation of A(0)'s constants with several.
    /// Accuracy: 1e-13 of the largest.
    std::vector<double> long_waves(const Vector3 &n) const;

    /// Over the Brillouin zone |k_d| <= π/h: on a grid with eight points or more on the
    /// shortest oscillation of the symbol, whose degree is the stencil's reach, and by Newton's
    /// method in a trust region from each local maximum of the grid that may lead to the largest.
    /// Never larger than the true one.
    SymbolRange range() const;

  private:
    WaveOperator waves_;
  };

  /// The mass matrix lumped to its diagonal, scaled for the area of each cell to stay.
  /// Source: Hinton, Rock & Zienkiewicz 1976, doi:10.1002/eqe.4290040305.
  Stencil lump(const Stencil &mass, unsigned int n_families);

  /// Entries beyond one cell: waves cost a solve with M at each step.
  bool couples_cells(const Stencil &mass);
} // namespace plumbline::algebra
