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

  /// Those of a kernel, in the order of a symbol's waves.
  std::vector<Polarisation> polarisations(Structure structure);

  std::string name(Polarisation polarisation); ///< "", "L" or "T"

  /// ω² of a wave of unit density, and its derivative.
  struct Frequency
  {
    double squared = 0; ///< [1/time^2]
    double slope = 0;   ///< dω²/dk
  };

  /// The nonlocal operator's own plane waves in an unbounded body of density 1, ü = -L_δ u, the
  /// same in all directions: with z = kr
  ///   scalar        ω² = 2π ∫ C (1 - J0(z)) r dr
  ///   longitudinal  ω² = π ∫ C (1 - J0(z) + J2(z)) r dr + (λ - μ) g²
  ///   transverse    ω² = π ∫ C (1 - J0(z) - J2(z)) r dr
  /// over 0 < r < δ, C = radial(r); of the dilatation's influence K, g = 2π ∫ K J1(z) r² dr → k.
  /// Source: Silling 2000, doi:10.1016/S0022-5096(99)00029-0, ω² = ∫ C (1 - cos k·ξ) dξ, its angle
  /// integrated by Bessel's integrals.
  /// @param dilatation  of a homogeneous solid, or empty
  /// @param k           > 0 [1/length], at most 1e4 / δ
  /// Accuracy: 1e-13 relative.
  /// @throws NumericalError  the quadrature does not settle to 1e-12
  Frequency exact_wave(const Kernel<2> &kernel, const std::optional<Dilatation> &dilatation,
                       Polarisation polarisation, double k);

  /// The square of the speed of all waves of the local limit, and of long ones here: diffusion,
  /// λ + 2μ or μ.
  double squared_local_speed(const Kernel<2> &kernel, const std::optional<Dilatation> &dilatation,
                             Polarisation polarisation);
} // namespace plumbline::physics

namespace plumbline::base
{
  template <>
  inline constexpr auto words<physics::Polarisation> =
      std::array{"scalar", "longitudinal", "transverse"};
} // namespace plumbline::base
