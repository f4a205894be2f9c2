#pragma once

#include "physics/kernel.h"
#include "reference/tetrahedra/plane_functions.h"

#include <string>
#include <vector>

namespace plumbline::reference
{
  /// A radial profile that FacePotential turns into a potential. Lengths are in units of the reach,
  /// beyond which the profile is 0.
  struct PotentialKernel
  {
    PotentialKernel() = default;
    /// That of a scalar kernel, whose reach is its horizon. @pre  FacePotential::refuse() is empty
    PotentialKernel(const physics::Kernel<3> &kernel); // NOLINT: a kernel is one

    std::vector<PotentialTerms> terms; ///< they add up
    double second = 0, fourth = 0;     ///< ∫ t² γ dt and ∫ t⁴ γ dt
  };

  /// The radial functions that turn double integrals of a scalar kernel over tetrahedra into double
  /// integrals over their faces. Lengths are in horizons, and γ = ρ(r) for r < 1 and 0 beyond. With
  ///   r Λ = ∫_r^1 t γ (t - r) dt,      ΔΛ = γ - m₀ δ,
  ///   r Ψ = ∫_r^1 t γ (t - r)³/6 dt,   ΔΔΨ = γ - m₀ δ - κ Δδ,
  /// where m₀ = 4π ∫ t² γ dt, κ = (2π/3) ∫ t⁴ γ dt is the diffusion constant of the local limit,
  /// and δ is Dirac's distribution: (r f)'' = r Δf for radial f, and Λ and Ψ are like m₀/(4π r) and
  /// κ/(4π r) at 0. Both vanish for r >= 1: Λ like (1 - r)², Ψ like (1 - r)⁴, where γ does not.
  ///
  /// For constants φ_i on cells, ∇φ_i is a layer -n on their faces, and for continuous linear φ_i,
  /// Δφ_i is a layer with the jump of the normal derivative. So, for bounded supports,
  ///   ½∬γ (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) = Σ_F Σ_G n_i(F)·n_j(G) ∬_{F×G} Λ(|x - y|)
  ///                                          = κ ∫∇φ_i·∇φ_j - Σ_F Σ_G J_i(F) J_j(G) ∬_{F×G} Ψ.
  class FacePotential
  {
  public:
    enum class Kind
    {
      harmonic,   ///< Λ
      biharmonic, ///< Ψ
    };

    FacePotential(const PotentialKernel &kernel, Kind kind);

    /// Whether the parts of a bond tensor with this profile are sums of powers, see SolidKernel.
    static bool has_power_parts(const physics::RadialProfile &profile);

    /// Degrees of polynomials equal to series, see PotentialTerms.
    static std::vector<unsigned int> degrees(const physics::RadialProfile &profile);

    /// Why there is no such function of a kernel, and the remedy; empty: there is.
    static std::string refuse(const physics::Kernel<3> &kernel);

    /// How a series stands for the kernel, for reports; empty: none does.
    static std::string note(const physics::Kernel<3> &kernel);

    /// The profile by its terms; several parts of a table, which add up; a ProfileSeries of what is
    /// no sum of powers, or of high ones. [horizons]
    /// @pre  refuse() is empty
    static std::vector<PotentialTerms> terms(const physics::Kernel<3> &kernel);

    /// At most as many points as one call of values(), sum() or sum_of_rays() takes.
    static constexpr unsigned int most_points = 64;

    /// f(r) at n points. [1]
    /// @param squares  r² > 0
    void values(const double *squares, double *result, unsigned int n) const;

    /// Σ weights f(r) at n points. [1]
    /// @param squares  r² > 0
    double sum(const double *squares, const double *weights, unsigned int n) const;

    /// Σ weights ∫_0^1 s³ f(s r) ds at n points, exact along s. [1]
    double sum_of_rays(const double *squares, const double *weights, unsigned int n) const;

    /// Where it is not smooth, in horizons; ascending, the last is 1.
    std::vector<double> ends() const;

    double diffusion() const { return diffusion_; } ///< κ, in units of the horizon [1]

  private:
    std::vector<PotentialPart<double>> parts_;
    double diffusion_ = 0;
  };
} // namespace plumbline::reference
