#include "reference/tetrahedra/face_potential.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    constexpr int lowest_exponent = -1;
    constexpr int highest_exponent = 50; // 64 coefficients of antiderivatives have room

    /// ∫_0^end t^n γ dt, of γ = a t^k. @pre n + k > -1
    double moment(const PotentialTerms::Term &term, int n, double end)
    {
      const int p = term.exponent + n + 1;
      return term.coefficient * std::pow(end, p) / p;
    }

    void add_power(std::vector<double> &powers, int exponent, double coefficient)
    {
      const auto place = static_cast<std::size_t>(exponent);
      if (powers.size() <= place)
        powers.resize(place + 1);
      powers[place] += coefficient;
    }
  } // namespace

  FacePotential::FacePotential(const physics::Kernel<3> &kernel, Kind kind)
  {
    // ∫_r^end t γ (t - r)^n / n! dt is the same from 0, a sum of moments, and, n being odd, besides
    // ∫_0^r t γ (r - t)^n / n! dt = a r^(k+n+2) / ((k+2) ... (k+n+2)) for γ = a t^k.
    const int n = kind == Kind::harmonic ? 1 : 3;
    constexpr double share_of_second_moment = 2 * M_PI / 3;
    for (const auto &[end, powers] : terms(kernel))
    {
      Part part;
      part.end = end;
      for (const PotentialTerms::Term &term : powers)
      {
        double binomial = 1; // 1 / (j! (n - j)!)
        for (int j = 2; j <= n; ++j)
          binomial /= j;
        for (int j = 0; j <= n; ++j)
        {
          const double of_power = (j % 2 == 0 ? 1 : -1) * binomial * moment(term, n + 1 - j, end);
          if (j == 0)
            part.inverse += of_power;
          else
            add_power(part.powers, j - 1, of_power);
          binomial *= static_cast<double>(n - j) / (j + 1);
        }
        double inner = term.coefficient;
        for (int j = 2; j <= n + 2; ++j)
          inner /= term.exponent + j;
        add_power(part.powers, term.exponent + n + 1, inner);
        diffusion_ += share_of_second_moment * moment(term, 4, end);
      }
      parts_.push_back(std::move(part));
    }
  }

  std::vector<PotentialTerms> FacePotential::terms(const physics::Kernel<3> &kernel)
  {
    std::vector<PotentialTerms> result;
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

  void FacePotential::values(const double *squares, double *result, unsigned int n) const
  {
    std::array<double, most_points> r, value; // filled up to n
    for (unsigned int q = 0; q < n; ++q)
    {
      r[q] = std::sqrt(squares[q]);
      result[q] = 0;
    }
    for (const Part &part : parts_)
    {
      for (unsigned int q = 0; q < n; ++q)
        value[q] = 0;
      for (std::size_t k = part.powers.size(); k-- > 0;)
        for (unsigned int q = 0; q < n; ++q)
          value[q] = value[q] * r[q] + part.powers[k];
      for (unsigned int q = 0; q < n; ++q)
        result[q] += r[q] < part.end ? value[q] + part.inverse / r[q] : 0;
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
    // ∫ s³ (s r)^k ds up to s = min(1, end / r) is R^(k+4) / ((k+4) r⁴), R = min(r, end)
    double sum = 0;
    std::array<double, most_points> reach, value; // filled up to n
    for (const Part &part : parts_)
    {
      for (unsigned int q = 0; q < n; ++q)
      {
        reach[q] = std::min(std::sqrt(squares[q]), part.end);
        value[q] = 0;
      }
      for (std::size_t k = part.powers.size(); k-- > 0;)
      {
        const double power = part.powers[k] / static_cast<double>(k + 4);
        for (unsigned int q = 0; q < n; ++q)
          value[q] = value[q] * reach[q] + power;
      }
      for (unsigned int q = 0; q < n; ++q)
      {
        const double cube = reach[q] * reach[q] * reach[q];
        sum += weights[q] * cube * (value[q] * reach[q] + part.inverse / 3) /
               (squares[q] * squares[q]);
      }
    }
    return sum;
  }

  std::string FacePotential::refuse(const physics::Kernel<3> &kernel)
  {
    const std::string remedy = "; write Kernel/type = constant, linear-decay, 1/r, polynomial or "
                               "table, or take Q1 or DGQ0 on a lattice of cubes";
    if (kernel.structure() != physics::Structure::scalar)
      return "entries on tetrahedra and hexahedra are for scalar kernels, not for bond tensors" + remedy;
    if (kernel.profile().is_function())
      return "entries on tetrahedra and hexahedra are for kernels that are sums of powers" + remedy;
    if (kernel.profile().lowest_exponent() < lowest_exponent)
      return "entries on tetrahedra and hexahedra are for kernels like 1/r or less at 0" + remedy;
    for (const PotentialTerms &part : terms(kernel))
      for (const auto &[coefficient, exponent] : part.terms)
        if (exponent > highest_exponent)
          return "entries on tetrahedra and hexahedra support powers up to r^" +
                 std::to_string(highest_exponent) + ", not r^" + std::to_string(exponent) +
                 "; give fewer coefficients";
    return "";
  }

  std::vector<double> FacePotential::ends() const
  {
    std::vector<double> ends;
    for (const Part &part : parts_)
      ends.push_back(part.end);
    std::sort(ends.begin(), ends.end());
    return ends;
  }
} // namespace plumbline::reference
