#pragma once

#include "physics/radial_profile.h"

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace plumbline::physics
{
  using dealii::Point;

  enum class Structure
  {
    scalar, ///< C(ξ) = c ρ(|ξ|/δ)
    tensor  ///< C(ξ) = c ρ(|ξ|/δ) ξ⊗ξ/|ξ|²
  };

  /// What a scene says of a profile, for the types of kernel that take it.
  struct ProfileKeys
  {
    std::vector<double> coefficients; ///< a_0, a_1, ...
    unsigned int singularity = 0;
    double width = 0;                              ///< in horizons
    std::vector<std::array<double, 2>> table = {}; ///< rows (t, ρ)
  };

  /// A row of the table of kernels that scenes choose from.
  struct KernelType
  {
    std::string name;
    Structure structure = Structure::scalar;
    RadialProfile profile; ///< empty: made of what the scene gives
    std::string formula;
    std::string source;
    std::string key =
        {}; ///< of scenes, that its profile is made of: coefficients, width, table file
    RadialProfile (*make)(const ProfileKeys &) = nullptr;
  };

  /// All kernels by name. A new one is one row, and a function for a profile that is no sum of
  /// powers.
  const std::vector<KernelType> &kernel_types();

  /// @throws InputError  unknown name; the message lists the known ones
  const KernelType &kernel_type(const std::string &name);

  /// The local operator that L_δ tends to as δ → 0:
  /// scalar -diffusion Δ; tensor -[mu Δu + (lambda + mu) ∇ div u], where lambda = mu.
  struct LocalLimit
  {
    double diffusion = 0;
    double mu = 0;
    double lambda = 0;
  };

  /// The kernel C of L u(x) = -∫_{|ξ|<δ} C(ξ) (u(x+ξ) - u(x)) dξ with a radial profile, all its
  /// moments being exact, or to round-off where the profile is a function. Instantiated for dim =
  /// 1, 2 and 3; on a line, where kernels like 1/r are common and not integrable, a finite second
  /// moment is enough, and moments of order 0 and 1 may not exist.
  template <int dim>
  class Kernel
  {
  public:
    /// @param horizon  δ > 0 [length]
    /// @param constant c [1 / length^(dim+2) times the unit of the operator]
    /// @throws InputError  horizon <= 0, an empty profile, or a profile that is not integrable
    ///                     (like t^-dim or worse at 0; for dim = 1: t^-3 or worse)
    Kernel(Structure structure, RadialProfile profile, double horizon, double constant);

    /// The kernel whose local limit is -diffusion Δ.
    static Kernel with_diffusion(RadialProfile profile, double horizon, double diffusion);

    /// The bond tensor of bulk modulus κ [force/length^2], λ = μ = 3κ/5: plane strain in 2D, ν =
    /// 1/4. With ρ = 1/t this is c ξ⊗ξ/|ξ|³, c = 72κ/(5πδ³) in 2D and 18κ/(πδ⁴) in 3D. Source:
    /// Silling & Askari 2005, doi:10.1016/j.compstruc.2004.11.026.
    static Kernel with_bulk_modulus(RadialProfile profile, double horizon, double kappa);

    Structure structure() const { return structure_; }
    double horizon() const { return horizon_; }
    double constant() const { return constant_; }
    const RadialProfile &profile() const { return profile_; }

    /// Radii in (0, δ) where the profile is not smooth.
    std::vector<double> breaks() const;

    /// Kernels of smooth profiles, each of its own horizon, that add up to this one.
    std::vector<Kernel> parts() const;

    /// 1 for scalar kernels (components decouple), dim for tensors.
    unsigned int n_components() const { return structure_ == Structure::scalar ? 1 : dim; }

    /// c ρ(r/δ) by its formula, also beyond δ, where the kernel itself is zero. r > 0.
    double radial(double r) const;

    /// Factor of entry (a,b) for direction ξ: C_ab = radial(|ξ|) direction_factor(a, b, ξ). ξ ≠ 0.
    double direction_factor(unsigned int a, unsigned int b, const Point<dim> &xi) const;

    /// ∫_{|ξ|<δ} C_ab(ξ) ξ^α dξ.
    double moment(const std::array<int, dim> &alpha, unsigned int a = 0, unsigned int b = 0) const;

    LocalLimit limit() const;

  private:
    Structure structure_;
    RadialProfile profile_;
    double horizon_;
    double constant_;
  };
} // namespace plumbline::physics
