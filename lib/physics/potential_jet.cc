#include "physics/potential_jet.h"

#include "physics/gauss.h"

#include <algorithm>
#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    constexpr unsigned int n_points = 64; ///< as for RadialPotential

    /// (x - ln(1 + x)) / x².
    long double reduced_log(long double x)
    {
      if (std::abs(x) > .4L)
        return (x - std::log1p(x)) / (x * x);
      long double sum = 0;
      constexpr int last = 50; // .4^48 / 50 < 2e-21
      for (int k = last; k >= 2; --k)
        sum = 1.L / k - x * sum;
      return sum;
    }

    /// Integrals of the kernel over the squares of radii from q = 1 - ρ to 1, over ρ, that
    /// derivatives of the potentials are made of.
    struct RadialSums
    {
      long double f1 = 0, f2 = 0, v1 = 0, v2 = 0;
    };

    RadialSums radial_sums(const Kernel<2> &kernel, double square, double rho)
    {
      const dealii::Quadrature<1> &rule = gauss(n_points);
      const double q = 1 - rho;
      RadialSums sums;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const long double tau = rule.point(i)[0], s = q + rho * tau;
        const long double value =
            rule.weight(i) * kernel.radial(std::sqrt(static_cast<double>(s) * square)) * tau;
        sums.f1 += value * tau * reduced_log(rho * tau / q);
        sums.f2 += value;
        sums.v1 += value * tau * (2 * s + q) / s;
        sums.v2 += value * s;
      }
      return sums;
    }
  } // namespace

  template <unsigned int n_parts>
  CircleJets<n_parts>::CircleJets(const Kernel<2> &kernel, double lowest_rho)
      : square_(kernel.horizon() * kernel.horizon()), inverse_(1 / square_)
  {
    const PotentialTables<n_parts> potential(kernel, lowest_rho);
    const dealii::Quadrature<1> &rule = gauss(n_points);
    // ∫_0^ρ of (1 - σ)^of_q σ^power times a function, over ρ^(power + 1)
    const auto integral = [&](double rho, int power, int of_q, const auto &function)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const double tau = rule.point(i)[0];
        sum += rule.weight(i) * std::pow(tau, power) * std::pow(1 - rho * tau, of_q) *
               function(rho * tau);
      }
      return sum;
    };
    const auto table = [&](const auto &function)
    {
      return LocalPolynomials<1>([&](double rho) { return std::array<double, 1>{function(rho)}; },
                                 lowest_rho, RadialPotential::highest_rho);
    };
    const auto at = [](const LocalPolynomials<1> &values)
    { return [&values](double rho) { return values(rho)[0]; }; };
    const auto g2 = [&](double rho) { return potential.g_per_power(rho)[0]; };
    const auto third = table([&](double rho) { return integral(rho, 5, 0, g2) / 2; });
    LocalPolynomials<1> rest_g2, rest_third, rest_g3;
    if constexpr (n_parts == 2)
    {
      const auto rest_f = [&](double rho) { return potential.f_per_power(rho)[1]; };
      const auto per_q = [](double rho) { return 1 / (4 * (1 - rho) * (1 - rho) * (1 - rho)); };
      rest_g2 = table([&](double rho) { return integral(rho, 4, 2, rest_f) * per_q(rho); });
      rest_third = table([&](double rho) { return integral(rho, 5, 0, at(rest_g2)); });
      rest_g3 = table([&](double rho) { return integral(rho, 6, 2, at(rest_third)) * per_q(rho); });
    }
    const auto all = [&](double rho)
    {
      const double q = 1 - rho;
      const auto [f1, f2, v1, v2] = radial_sums(kernel, square_, rho);
      const long double factor = 1 / (16.L * n_parts * q * q), squared = 1.L * q * q; // ½ of traces
      typename LocalPolynomials<n_functions>::Values result{};
      result[f] = potential.f_per_power(rho)[0];
      result[f_first] = static_cast<double>(f1 * factor);
      result[f_second] = static_cast<double>(f2 * factor);
      result[g] = g2(rho);
      result[f3] = third(rho)[0];
      result[g3] = integral(rho, 6, 0, at(third)) / (2 * q);
      if constexpr (n_parts == 2)
      {
        result[v] = potential.f_per_power(rho)[1];
        result[v_first] = static_cast<double>(v1 / (96 * squared * q));
        result[v_second] = static_cast<double>(v2 / (16 * squared * squared));
        result[v_g] = rest_g2(rho)[0];
        result[v3] = rest_third(rho)[0];
        result[v_g3] = rest_g3(rho)[0];
        result[v4] = integral(rho, 7, 0, at(rest_g3));
      }
      return result;
    };
    tables_ = {all, lowest_rho, RadialPotential::highest_rho};
  }

  template <unsigned int n_parts>
  PowerJets<n_parts>::PowerJets(const Kernel<2> &kernel)
      : per_square_(1 / (kernel.horizon() * kernel.horizon()))
  {
    for (const PowerTerm &power : kernel.profile().powers())
    {
      const int k = power.exponent;
      Term term;
      term.exponent = k;
      const double c = kernel.constant() * power.coefficient * std::pow(kernel.horizon(), -k);
      double factor = c / (n_parts * (k + 2.) * (k + 2)); // of bond tensors half the trace
      for (unsigned int order = 0; order < 3; ++order)
      {
        const double p = k + 4. + 2 * order; // ΔΨ = r^(p-2): Ψ = r^p / p²
        factor /= p * p;
        if (order == 0)
          term.value = factor;
        term.first[order] = factor * p / 2;
        term.second[order] = factor * p / 2 * (p / 2 - 1);
      }
      if (n_parts == 2 && k == 0)
        logarithm_ += c / 48;
      else if (n_parts == 2)
        find_rest(c, term);
      terms_.push_back(term);
      degree_ = std::max(degree_, static_cast<unsigned int>(k + 8));
    }
  }

  /// Of H c r^(k-2).
  template <unsigned int n_parts>
  void PowerJets<n_parts>::find_rest(double c, Term &term) const
  {
    const double k = term.exponent;
    double factor = c / (k * (k + 4));
    for (unsigned int order = 0; order < 3; ++order)
    {
      const double p = k + 2 + 2 * order; // Δ(H r^p) = p (p + 4) H r^(p-2)
      factor /= p * (p + 4);
      term.v[order] = factor;
      term.v_first[order] = factor * p / 2;
      term.v_second[order] = factor * p / 2 * (p / 2 - 1);
    }
  }

  template class CircleJets<1>;
  template class CircleJets<2>;
  template class PowerJets<1>;
  template class PowerJets<2>;
} // namespace plumbline::physics
