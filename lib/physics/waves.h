#pragma once

#include "base/choice.h"
#include "physics/kernel.h"
#include "physics/state_based.h"

#include <optional>
#include <string>
#include <vector>

namespace plumbline::physics
{
  /// How a plane wave moves: as a scalar, along its direction or across it.
  enum class Polarisation
  {
    scalar,
    longitudinal,
    transverse
  };

  /// One sort of waves of a kernel.
  struct Branch
  {
    Polarisation polarisation = Polarisation::scalar;
    std::string name; ///< "", "L", "T", or in space, for the two across a direction, "T1" and "T2"
  };

  /// Those of a kernel, in the order of a symbol's waves.
  /// @param dimension  2 or 3
  std::vector<Branch> branches(Structure structure, unsigned int dimension);

  /// ω² of a wave of unit density, and its derivative.
  struct Frequency
  {
    double squared = 0; ///< [1/time^2]
    double slope = 0;   ///< dω²/dk
  };

  /// The plane waves of bonds in an unbounded body of density 1, ü = -L_δ u, the same in all
  /// directions: with z = kr, |S| r^(d-1) the size of a circle (d = 2) or sphere (d = 3), and J_n
  /// Bessel's functions, in space the spherical ones,
  ///   scalar        ω² = |S| ∫ C (1 - J0(z)) r^(d-1) dr
  ///   longitudinal  ω² = |S|/d ∫ C (1 - J0(z) + (d-1) J2(z)) r^(d-1) dr
  ///   transverse    ω² = |S|/d ∫ C (1 - J0(z) - J2(z)) r^(d-1) dr
  /// over 0 < r < δ, C = radial(r).
  /// Source: Silling 2000, doi:10.1016/S0022-5096(99)00029-0, ω² = ∫ C (1 - cos k·ξ) dξ, its angles
  /// integrated by Bessel's and Gegenbauer's integrals.
  /// A dilatation with influence function K adds (λ - μ) g² to ω² of longitudinal waves, with
  /// g = |S| ∫ K J1(z) r^d dr, which tends to k as δ → 0.
  /// @param k  > 0 [1/length], at most 1e4 / δ
  /// @param dilatation  of a homogeneous solid, or empty
  /// Accuracy: 1e-13 relative. Instantiated for dim = 2 and 3.
  /// @throws NumericalError  the quadrature does not settle to 1e-12
  template <int dim>
  Frequency exact_wave(const Kernel<dim> &kernel, const std::optional<Dilatation<dim>> &dilatation,
                       Polarisation polarisation, double k);

  /// The square of the speed of all waves of the local limit, and of long ones here: diffusion,
  /// λ + 2μ or μ.
  /// @param limit  of the bonds
  /// @param solid  the constants of a state-based solid, whose λ is another; empty: bonds only
  double squared_local_speed(const LocalLimit &limit, const std::optional<Lame> &solid,
                             Polarisation polarisation);
} // namespace plumbline::physics

namespace plumbline::base
{
  template <>
  inline constexpr auto words<physics::Polarisation> =
      std::array{"scalar", "longitudinal", "transverse"};
} // namespace plumbline::base
