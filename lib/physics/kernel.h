#pragma once

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

  /// One term a t^p of a radial profile ρ(t), t = |ξ|/δ.
  struct PowerTerm
  {
    double coefficient = 0;
    int exponent = 0;
  };

  /// A row of the table of kernels that scenes choose from.
  struct KernelType
  {
    std::string name;
    Structure structure = Structure::scalar;
    std::vector<PowerTerm> profile; ///< empty: the scene gives it
    std::string formula;
    std::string source;
  };

  /// All kernels by name: linear-decay, constant, conical, 1/r, polynomial and their bond tensors.
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

  /// The kernel C of L u(x) = -∫_{|ξ|<δ} C(ξ) (u(x+ξ) - u(x)) dξ with a radial profile that is a
  /// sum of powers, so that all its moments are exact. Instantiated for dim = 2 and 3.
  template <int dim>
  class Kernel
  {
  public:
    /// @param horizon  δ > 0 [length]
    /// @param constant c [1 / length^(dim+2) times the unit of the operator]
    /// @throws InputError  horizon <= 0, an empty profile, or a profile that is not integrable
    ///                     (exponent <= -dim)
    Kernel(Structure structure, std::vector<PowerTerm> profile, double horizon, double constant);

    /// The kernel whose local limit is -diffusion Δ.
    static Kernel with_diffusion(std::vector<PowerTerm> profile, double horizon, double diffusion);

    /// The bond tensor of bulk modulus κ [force/length^2], λ = μ = 3κ/5: plane strain in 2D, ν =
    /// 1/4. With ρ = 1/t this is c ξ⊗ξ/|ξ|³, c = 72κ/(5πδ³) in 2D and 18κ/(πδ⁴) in 3D. Source:
    /// Silling & Askari 2005, doi:10.1016/j.compstruc.2004.11.026.
    static Kernel with_bulk_modulus(std::vector<PowerTerm> profile, double horizon, double kappa);

    Structure structure() const { return structure_; }
    double horizon() const { return horizon_; }
    double constant() const { return constant_; }
    const std::vector<PowerTerm> &profile() const { return profile_; }

    /// 1 for scalar kernels (components decouple), dim for tensors.
    unsigned int n_components() const { return structure_ == Structure::scalar ? 1 : dim; }

    /// c ρ(r/δ) by its formula, also beyond δ, where the kernel itself is zero. r > 0.
    double radial(double r) const;

    /// Factor of entry (a,b) for direction ξ: C_ab = radial(|ξ|) direction_factor(a, b, ξ). ξ ≠ 0.
    double direction_factor(unsigned int a, unsigned int b, const Point<dim> &xi) const;

    /// ∫_{|ξ|<δ} C_ab(ξ) ξ^α dξ, exact.
    double moment(const std::array<int, dim> &alpha, unsigned int a = 0, unsigned int b = 0) const;

    LocalLimit limit() const;

  private:
    Structure structure_;
    std::vector<PowerTerm> profile_;
    double horizon_;
    double constant_;
  };
} // namespace plumbline::physics
