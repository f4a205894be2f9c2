#include "reference/tetrahedra/face_potential.h"

#include "base/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    constexpr int lowest_exponent = -1;
    constexpr int highest_exponent = 50; // 64 coefficients have room; higher ones make a series

    constexpr double most_of_series = 1e-11; // its error; functions of scenes leave 1e-12 or less

    bool is_series(const physics::RadialProfile &profile)
    {
      if (profile.is_function())
        return true;
      return profile.breaks().empty() &&
             std::any_of(profile.powers().begin(), profile.powers().end(),
                         [](const physics::PowerTerm &term)
                         { return term.coefficient != 0 && term.exponent > highest_exponent; });
    }
  } // namespace

  PotentialKernel::PotentialKernel(const physics::Kernel<3> &kernel)
      : terms(FacePotential::terms(kernel)), second(kernel.profile().moment(2)),
        fourth(kernel.profile().moment(4))
  {
  }

  FacePotential::FacePotential(const PotentialKernel &kernel, Kind kind)
  {
    constexpr double share_of_second_moment = 2 * M_PI / 3;
    diffusion_ = share_of_second_moment * kernel.fourth;
    for (const PotentialTerms &part : kernel.terms)
      parts_.emplace_back(part, kind == Kind::harmonic ? 1 : 3);
  }

  std::vector<PotentialTerms> FacePotential::terms(const physics::Kernel<3> &kernel)
  {
    std::vector<PotentialTerms> result;
    if (const physics::RadialProfile &whole = kernel.profile(); is_series(whole))
    {
      PotentialTerms part;
      part.series = ProfileSeries(whole).coefficients;
      part.degrees = degrees(whole);
      return {part};
    }
    for (const auto &[end, profile] : kernel.profile().parts())
    {
      PotentialTerms part;
      part.end = end;
      for (const auto &[coefficient, exponent] : profile.powers())
        part.terms.push_back({coefficient / std::pow(end, exponent), exponent}); // of t / end
      result.push_back(part);
    }
    return result;
  }

  bool FacePotential::has_power_parts(const physics::RadialProfile &profile)
  {
    return !profile.is_function() && profile.breaks().empty() &&
           std::all_of(profile.powers().begin(), profile.powers().end(),
                       [](const physics::PowerTerm &term) {
                         return term.coefficient == 0 ||
                                (term.exponent != 0 && term.exponent <= highest_exponent);
                       });
  }

  std::vector<unsigned int> FacePotential::degrees(const physics::RadialProfile &profile)
  {
    constexpr unsigned int n_levels = 8; // of RadialProfile
    std::vector<unsigned int> result;
    for (unsigned int level = 0; level < n_levels; ++level)
      result.push_back(profile.degree(std::ldexp(1., -static_cast<int>(level))) + 1);
    return result;
  }

  void FacePotential::values(const double *squares, double *result, unsigned int n) const
  {
    std::array<double, most_points> r, value; // filled up to n
    for (unsigned int q = 0; q < n; ++q)
    {
      r[q] = std::sqrt(squares[q]);
      result[q] = 0;
    }
    for (const PotentialPart<double> &part : parts_)
    {
      part.potential().evaluate(r.data(), value.data(), n);
      for (unsigned int q = 0; q < n; ++q)
        result[q] += r[q] < part.end() ? value[q] / r[q] : 0;
    }
  }

  double FacePotential::sum(const double *squares, const double *weights, unsigned int n) const
  {
    std::array<double, most_points> value; // filled up to n
    values(squares, value.data(), n);
    double sum = 0;
    for (unsigned int q = 0; q < n; ++q)
      sum += weights[q] * value[q];
    return sum;
  }

  double FacePotential::sum_of_rays(const double *squares, const double *weights,
                                    unsigned int n) const
  {
    // up to s = min(1, end / r) this is r⁻⁴ ∫_0^R t³ f dt = R⁴ g₁(R) / r⁴, R = min(r, end)
    double sum = 0;
    std::array<double, most_points> reach, value; // filled up to n
    for (const PotentialPart<double> &part : parts_)
    {
      for (unsigned int q = 0; q < n; ++q)
        reach[q] = std::min(std::sqrt(squares[q]), part.end());
      part.of_edges().evaluate(reach.data(), value.data(), n);
      for (unsigned int q = 0; q < n; ++q)
      {
        const double cube = reach[q] * reach[q] * reach[q];
        sum += weights[q] * cube * value[q] / (squares[q] * squares[q]);
      }
    }
    return sum;
  }

  std::string FacePotential::refuse(const physics::Kernel<3> &kernel)
  {
    const std::string remedy =
        kernel.structure() == physics::Structure::scalar
            ? "; write Kernel/type = constant, linear-decay, 1/r, polynomial, "
              "gaussian, exponential or table, or take Q1 or DGQ0 on a lattice of cubes"
            : "; write a Kernel/type without table and of at most 1/r at 0, or take Q1 or DGQ0 on "
              "a lattice of cubes";
    const bool is_tensor = kernel.structure() == physics::Structure::tensor;
    if (kernel.profile().lowest_exponent() < lowest_exponent)
      return "entries on tetrahedra and hexahedra are for kernels of at most 1/r at 0" + remedy;
    if (is_tensor && !kernel.profile().breaks().empty())
      return "entries of bond tensors on tetrahedra and hexahedra are not for tables" + remedy;
    if (is_series(kernel.profile()) || (is_tensor && !has_power_parts(kernel.profile())))
      if (const double error = ProfileSeries(kernel.profile()).error; !(error < most_of_series))
        return "128 Chebyshev terms approximate the radial profile only to " +
               base::to_text(error, 1) + " of the kernel's integral; give fewer coefficients";
    return "";
  }

  std::string FacePotential::note(const physics::Kernel<3> &kernel)
  {
    const bool has_logarithms =
        kernel.structure() == physics::Structure::tensor && !has_power_parts(kernel.profile());
    if (!is_series(kernel.profile()) && !has_logarithms)
      return {};
    const ProfileSeries series(kernel.profile());
    return "; a Chebyshev series of " + std::to_string(series.coefficients.size()) +
           " terms approximates the radial profile, to " + base::to_text(series.error, 1) +
           " of the kernel's integral" +
           (has_logarithms
                ? ", and one of 126 terms approximates t ln t, to 3e-13 of its first moment"
                : "");
  }

  std::vector<double> FacePotential::ends() const
  {
    std::vector<double> ends;
    for (const PotentialPart<double> &part : parts_)
      ends.push_back(part.end());
    std::sort(ends.begin(), ends.end());
    return ends;
  }
} // namespace plumbline::reference
