#pragma once

#include "physics/double_well.h"

#include <array>

namespace plumbline::physics
{
  /// A symmetric matrix of dim × dim entries; in 1D all but the first are 0.
  struct SymmetricMatrix
  {
    double xx = 0, xy = 0, yy = 0;
    /// Eigenvalues, ascending; in 1D take xx.
    std::array<double, 2> eigenvalues() const;
  };

  /// Small waves e^(ik·x) on a uniform strain E: ρ ẅ = -Λ(k) w, growth where Λ has a negative
  /// eigenvalue. In 1D
  ///   Λ(k) = (4/ε²) ∫_0^ε J T(zE²) (1 - cos kz)/z dz,  T(s) = f'(s) + 2s f''(s).
  /// By Gauss points in the radius and equidistant angles, more for short waves. Accuracy: 1e-12 of
  /// the largest eigenvalue, for β ε |E|² up to 30.
  /// @param k  wave vector [1/length]; in 1D its first component
  /// @pre law.dim() is 1 or 2
  SymmetricMatrix wave_symbol(const DoubleWell &law, const SymmetricMatrix &strain,
                              const std::array<double, 2> &k);

  /// The same of long waves: lim Λ(s n)/s² as s → 0, the acoustic tensor of the strained bonds. The
  /// local limit is elliptic while it is positive definite in all directions n.
  SymmetricMatrix acoustic_tensor(const DoubleWell &law, const SymmetricMatrix &strain,
                                  const std::array<double, 2> &n);

  /// What Jha & Lipton 2018, doi:10.1137/17M1112236, test by (64), with the bond energy itself: an
  /// eigenvalue below 0 means growth of their radial perturbation. Their A is -4/ε times this:
  /// ∫ J T(ε r S²) e⊗e over the unit ball / ω_dim.
  SymmetricMatrix local_stability(const DoubleWell &law, const SymmetricMatrix &strain);

  /// The amplitude X = β ε g², β = f'(0)/f_∞, at which strains g × direction lose ellipticity, or
  /// fail (64).
  struct Thresholds
  {
    double ellipticity = 0, local = 0;
  };
  /// To 1e-10. In 2D directions n are sampled by degrees and refined.
  /// @throws NumericalError  none up to X = 20
  Thresholds stability_thresholds(const DoubleWell &law, const SymmetricMatrix &direction);
} // namespace plumbline::physics
