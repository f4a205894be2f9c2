#include "physics/kernel.h"

#include "base/error.h"

#include <cmath>
#include <sstream>
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

    RadialProfile polynomial(const ProfileKeys &given)
    {
      std::vector<PowerTerm> terms;
      for (std::size_t i = 0; i < given.coefficients.size(); ++i)
        terms.push_back(
            {given.coefficients[i], static_cast<int>(i) - static_cast<int>(given.singularity)});
      return terms;
    }

    /// Of a profile that decays in so many horizons.
    double checked_width(double width)
    {
      constexpr double least = .05; // exp(-20) is left at the horizon
      if (!(width >= least && std::isfinite(width)))
      {
        std::ostringstream message;
        message << "Kernel/width = " << width << " horizons must be " << least
                << " or more and finite; a kernel that is narrower does without most of its ball: "
                   "take a smaller horizon";
        throw InputError(message.str());
      }
      return width;
    }

    RadialProfile gaussian(const ProfileKeys &given)
    {
      const double scale = 1 / checked_width(given.width);
      return RadialProfile::smooth([scale](double t) { return std::exp(-t * t * scale * scale); },
                                   true);
    }

    RadialProfile exponential(const ProfileKeys &given)
    {
      const double scale = 1 / checked_width(given.width);
      return RadialProfile::smooth([scale](double t) { return std::exp(-t * scale); }, false);
    }

    RadialProfile table(const ProfileKeys &given)
    {
      return RadialProfile::table(given.table);
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
    const std::string of_width = "s is the width of the scene, in horizons";
    const std::string of_table = "a file of the scene, linear between its rows";
    static const std::vector<KernelType> types = {
        {"linear-decay", Structure::scalar, {{1, 0}, {-1, 1}}, "c (1 - r/δ)", yang + ", (2.1)"},
        {"constant", Structure::scalar, {{1, 0}}, "c", scheme},
        {"conical", Structure::scalar, {{1, 0}, {-1, 1}}, "c (1 - r/δ)", variational},
        {"1/r", Structure::scalar, {{1, -1}}, "c δ/r", scheme},
        {"polynomial",
         Structure::scalar,
         {},
         "c p(r/δ) (δ/r)^a",
         "coefficients and a of the scene",
         "coefficients",
         polynomial},
        {"gaussian", Structure::scalar, {}, "c exp(-(r/(s δ))²)", of_width, "width", gaussian},
        {"exponential", Structure::scalar, {}, "c exp(-r/(s δ))", of_width, "width", exponential},
        {"table", Structure::scalar, {}, "c ρ(r/δ)", of_table, "table file", table},
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
         "coefficients and a of the scene",
         "coefficients",
         polynomial},
        {"bond-tensor gaussian",
         Structure::tensor,
         {},
         "c exp(-(r/(s δ))²) ξ⊗ξ/r²",
         of_width,
         "width",
         gaussian},
        {"bond-tensor exponential",
         Structure::tensor,
         {},
         "c exp(-r/(s δ)) ξ⊗ξ/r²",
         of_width,
         "width",
         exponential},
        {"bond-tensor table",
         Structure::tensor,
         {},
         "c ρ(r/δ) ξ⊗ξ/r²",
         of_table,
         "table file",
         table},
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
  Kernel<dim>::Kernel(Structure structure, RadialProfile profile, double horizon, double constant)
      : structure_(structure), profile_(std::move(profile)), horizon_(horizon), constant_(constant)
  {
    if (!(horizon_ > 0) || !std::isfinite(horizon_))
      throw InputError("kernel: horizon = " + std::to_string(horizon_) +
                       " is not a positive length; give a horizon > 0");
    if (profile_.is_empty())
      throw InputError("kernel: the radial profile has no term; give Kernel/coefficients");
    if (dim == 1 && profile_.lowest_exponent() <= -3)
      throw InputError("kernel: the profile term r^" + std::to_string(profile_.lowest_exponent()) +
                       " has no finite second moment in one dimension; use exponents above -3");
    if (dim > 1 && profile_.lowest_exponent() <= -dim)
      throw InputError("kernel: the profile term r^" + std::to_string(profile_.lowest_exponent()) +
                       " is not integrable in " + std::to_string(dim) + "D; use exponents above " +
                       std::to_string(-dim));
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
  Kernel<dim> Kernel<dim>::with_diffusion(RadialProfile profile, double horizon, double diffusion)
  {
    const Kernel unit(Structure::scalar, profile, horizon, 1);
    return Kernel(Structure::scalar, std::move(profile), horizon,
                  scaling(diffusion, unit.limit().diffusion));
  }

  template <int dim>
  Kernel<dim> Kernel<dim>::with_bulk_modulus(RadialProfile profile, double horizon, double kappa)
  {
    const Kernel unit(Structure::tensor, profile, horizon, 1);
    return Kernel(Structure::tensor, std::move(profile), horizon,
                  scaling(.6 * kappa, unit.limit().mu));
  }

  template <int dim>
  std::vector<double> Kernel<dim>::breaks() const
  {
    std::vector<double> radii = profile_.breaks();
    for (double &radius : radii)
      radius *= horizon_;
    return radii;
  }

  template <int dim>
  std::vector<Kernel<dim>> Kernel<dim>::parts() const
  {
    std::vector<Kernel> result;
    for (const RadialProfile::Piece &part : profile_.parts())
      result.emplace_back(structure_, part.profile, part.end * horizon_, constant_);
    return result;
  }

  template <int dim>
  double Kernel<dim>::radial(double r) const
  {
    return constant_ * profile_(r / horizon_);
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
    if (dim == 1 && order % 2 != 0)
      return 0; // as a principal value, where the profile itself has no such moment
    return constant_ * std::pow(horizon_, order + dim) * profile_.moment(order + dim - 1) *
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
      alpha[dim == 1 ? 0 : 1] = 2; // on a line, where there are no shear strains: ½ ∫ C ξ²
      limit.mu = limit.lambda = .5 * moment(alpha);
    }
    return limit;
  }

  template class Kernel<1>;
  template class Kernel<2>;
  template class Kernel<3>;
} // namespace plumbline::physics
