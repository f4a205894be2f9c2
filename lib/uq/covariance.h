#pragma once

#include "base/choice.h"

#include <array>
#include <functional>

namespace plumbline::uq
{
  /// Covariance of a stationary field at two points (dx, dy) apart [length]: even, and positive
  /// definite; its value at (0, 0) is the variance [unit of the field, squared].
  using CovarianceFunction = std::function<double(double dx, double dy)>;

  /// How a covariance falls with the distance: with r² = (dx/ℓ_x)² + (dy/ℓ_y)² and σ² the variance
  enum class CovarianceShape
  {
    exponential,           ///< σ² exp(-r)
    separable_exponential, ///< σ² exp(-|dx|/ℓ_x - |dy|/ℓ_y)
    gaussian,              ///< σ² exp(-r²/2)
    matern ///< σ² 2^(1-ν)/Γ(ν) (√(2ν) r)^ν K_ν(√(2ν) r): exponential at ν = 1/2, Gaussian for ν → ∞
  };

  /// A covariance that is given by few numbers. Fields are continuous in mean square, and have as
  /// many derivatives as the smoothness ν exceeds: none when exponential, all when Gaussian.
  /// Source: Ghanem & Spanos 1991, "Stochastic Finite Elements", doi:10.1007/978-1-4612-3094-6;
  /// Matérn 1960 as written by Stein 1999, "Interpolation of Spatial Data", sec. 2.10,
  /// doi:10.1007/978-1-4612-1494-6.
  struct Covariance
  {
    CovarianceShape shape = CovarianceShape::exponential;
    double variance = 1;                ///< σ² >= 0 [unit of the field, squared]
    std::array<double, 2> length{1, 1}; ///< ℓ_x, ℓ_y > 0 [length]
    double smoothness = .5;             ///< ν in (0, 1000], of Matérn's alone

    /// Accuracy: 1e-13 of the variance; 0 where it is below 1e-150 of it.
    /// @pre check(*this)
    double operator()(double dx, double dy) const;

    /// It is variance · factor(0, dx) · factor(1, dy).
    bool is_separable() const;

    /// One direction's part of a separable covariance, 1 at distance 0.
    double factor(unsigned int axis, double distance) const;
  };

  /// @throws InputError  a variance < 0, a correlation length <= 0, a smoothness outside (0, 1000],
  /// or one of them not finite
  void check(const Covariance &covariance);
} // namespace plumbline::uq

template <>
inline constexpr auto plumbline::base::words<plumbline::uq::CovarianceShape> =
    std::array{"exponential", "separable exponential", "Gaussian", "Matern"};
