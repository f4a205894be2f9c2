#include "physics/kernel.h"

#include "base/error.h"

#include <cmath>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    /// ∫ n^α over the unit sphere of R^dim: 0 unless all exponents are even, then
    /// 2 Π Γ((α_i + 1)/2) / Γ((|α| + dim)/2).
    template <int dim>
    double sphere_moment(const std::array<int, dim> &alpha)
    {
      double product = 2;
      int order = dim;
      for (const int a : alpha)
      {
        if (a % 2 != 0)
          return 0;
        product *= std::tgamma(.5 * (a + 1));
        order += a;
      }
      return product / std::tgamma(.5 * order);
    }

    std::string known_names()
    {
      std::string names;
      for (const KernelType &type : kernel_types())
        names += (names.empty() ? "" : ", ") + type.name;
      return names;
    }
  } // namespace

  const std::vector<KernelType> &kernel_types()
  {
    const std::string yang = "Yang & Yin, Analysis of convergence for the IPA-AC method";
    const std::string scheme = "Silling 2000, doi:10.1016/S0022-5096(99)00029-0";
    const std::string variational = "conical influence function of state-based models";
    static const std::vector<KernelType> types = {
        {"linear-decay", Structure::scalar, {{1, 0}, {-1, 1}}, "c (1 - r/δ)", yang + ", (2.1)"},
        {"constant", Structure::scalar, {{1, 0}}, "c", scheme},
        {"conical", Structure::scalar, {{1, 0}, {-1, 1}}, "c (1 - r/δ)", variational},
        {"1/r", Structure::scalar, {{1, -1}}, "c δ/r", scheme},
        {"polynomial",
         Structure::scalar,
         {},
         "c p(r/δ) (δ/r)^a",
         "coefficients and a of the scene"},
        {"bond-tensor", Structure::tensor, {{1, -1}}, "c δ ξ⊗ξ/r³", yang + ", (2.2)"},
        {"bond-tensor constant", Structure::tensor, {{1, 0}}, "c ξ⊗ξ/r²", scheme},
        {"bond-tensor conical",
         Structure::tensor,
         {{1, 0}, {-1, 1}},
         "c (1 - r/δ) ξ⊗ξ/r²",
         variational},
        {"bond-tensor polynomial",
         Structure::tensor,
         {},
         "c p(r/δ) (δ/r)^a ξ⊗ξ/r²",
         "coefficients and a of the scene"},
    };
    return types;
  }

  const KernelType &kernel_type(const std::string &name)
  {
    for (const KernelType &type : kernel_types())
      if (type.name == name)
        return type;
    throw InputError("Kernel/type = '" + name + "' is not known; choose one of: " + known_names());
  }

  template <int dim>
  Kernel<dim>::Kernel(Structure structure, std::vector<PowerTerm> profile, double horizon,
                      double constant)
      : structure_(structure), profile_(std::move(profile)), horizon_(horizon), constant_(constant)
  {
    if (!(horizon_ > 0) || !std::isfinite(horizon_))
      throw InputError("kernel: horizon = " + std::to_string(horizon_) +
                       " is not a positive length; give a horizon > 0");
    if (profile_.empty())
      throw InputError("kernel: the radial profile has no term; give Kernel/coefficients");
    for (const PowerTerm &term : profile_)
      if (term.exponent <= -dim)
        throw InputError("kernel: the profile term r^" + std::to_string(term.exponent) +
                         " is not integrable in " + std::to_string(dim) +
                         "D; use exponents above " + std::to_string(-dim));
  }

  namespace
  {
    /// What a unit kernel's limit must be scaled by.
    double scaling(double wanted, double of_unit_kernel)
    {
      if (!(std::abs(of_unit_kernel) > 1e-300))
        throw InputError(
            "Kernel/coefficients: the kernel's second moment is 0, so it has no local "
            "limit to be scaled to; change the coefficients, or write Kernel/limit = none");
      return wanted / of_unit_kernel;
    }
  } // namespace

  template <int dim>
  Kernel<dim> Kernel<dim>::with_diffusion(std::vector<PowerTerm> profile, double horizon,
                                          double diffusion)
  {
    const Kernel unit(Structure::scalar, profile, horizon, 1);
    return Kernel(Structure::scalar, std::move(profile), horizon,
                  scaling(diffusion, unit.limit().diffusion));
  }

  template <int dim>
  Kernel<dim> Kernel<dim>::with_bulk_modulus(std::vector<PowerTerm> profile, double horizon,
                                             double kappa)
  {
    const Kernel unit(Structure::tensor, profile, horizon, 1);
    return Kernel(Structure::tensor, std::move(profile), horizon,
                  scaling(.6 * kappa, unit.limit().mu));
  }

  template <int dim>
  double Kernel<dim>::radial(double r) const
  {
    const double t = r / horizon_;
    double sum = 0;
    for (const PowerTerm &term : profile_)
      switch (term.exponent)
      {
      case -1:
        sum += term.coefficient / t;
        break;
      case 0:
        sum += term.coefficient;
        break;
      case 1:
        sum += term.coefficient * t;
        break;
      default:
        sum += term.coefficient * std::pow(t, term.exponent);
      }
    return constant_ * sum;
  }

  template <int dim>
  double Kernel<dim>::direction_factor(unsigned int a, unsigned int b, const Point<dim> &xi) const
  {
    if (structure_ == Structure::scalar)
      return a == b ? 1 : 0;
    return xi[a] * xi[b] / xi.square();
  }

  template <int dim>
  double Kernel<dim>::moment(const std::array<int, dim> &alpha, unsigned int a,
                             unsigned int b) const
  {
    std::array<int, dim> direction = alpha;
    int order = 0;
    for (const int exponent : alpha)
      order += exponent;
    if (structure_ == Structure::tensor)
    {
      ++direction[a];
      ++direction[b];
    }
    else if (a != b)
      return 0;
    double radial_integral = 0;
    for (const PowerTerm &term : profile_)
      radial_integral += term.coefficient / (term.exponent + order + dim);
    return constant_ * std::pow(horizon_, order + dim) * radial_integral *
           sphere_moment<dim>(direction);
  }

  template <int dim>
  LocalLimit Kernel<dim>::limit() const
  {
    std::array<int, dim> alpha{};
    LocalLimit limit;
    if (structure_ == Structure::scalar)
    {
      alpha[0] = 2;
      limit.diffusion = .5 * moment(alpha);
    }
    else
    {
      // ½ ∫ C_11 ξ_2² = μ, and ½ ∫ C_11 ξ_1² = λ + 2μ = 3μ
      alpha[1] = 2;
      limit.mu = limit.lambda = .5 * moment(alpha);
    }
    return limit;
  }

  template class Kernel<2>;
  template class Kernel<3>;
} // namespace plumbline::physics
