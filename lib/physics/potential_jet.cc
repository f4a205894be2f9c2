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
  } // namespace

  CircleJets::CircleJets(const Kernel<2> &kernel, double lowest_rho)
      : square_(kernel.horizon() * kernel.horizon()), inverse_(1 / square_)
  {
    const RadialPotential potential(kernel, lowest_rho);
    const dealii::Quadrature<1> &rule = gauss(n_points);
    // ∫_0^ρ of what is ρ^power times a function, over ρ^(power + 1)
    const auto integral = [&](double rho, int power, const auto &function)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const double tau = rule.point(i)[0];
        sum += rule.weight(i) * std::pow(tau, power) * function(rho * tau)[0];
      }
      return sum;
    };
    const auto g = [&](double rho) { return potential.g_per_power(rho); };
    const LocalPolynomials<1> third([&](double rho)
                                    { return std::array<double, 1>{integral(rho, 5, g) / 2}; },
                                    lowest_rho, RadialPotential::highest_rho);
    const auto all = [&](double rho)
    {
      const double q = 1 - rho;
      long double f1 = 0, f2 = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const long double tau = rule.point(i)[0], s = q + rho * tau;
        const long double value =
            rule.weight(i) * kernel.radial(std::sqrt(static_cast<double>(s) * square_)) * tau;
        f1 += value * tau * reduced_log(rho * tau / q);
        f2 += value;
      }
      const long double factor = 1 / (16.L * q * q);
      return std::array<double, n_functions>{potential.f_per_power(rho)[0],
                                             static_cast<double>(f1 * factor),
                                             static_cast<double>(f2 * factor),
                                             g(rho)[0],
                                             third(rho)[0],
                                             integral(rho, 6, third) / (2 * q)};
    };
    tables_ = {all, lowest_rho, RadialPotential::highest_rho};
  }

  PowerJets::PowerJets(const Kernel<2> &kernel)
  {
    for (const PowerTerm &power : kernel.profile().powers())
    {
      const int k = power.exponent;
      Term term{k, 0, {}, {}};
      double factor = kernel.constant() * power.coefficient * std::pow(kernel.horizon(), -k) /
                      ((k + 2.) * (k + 2));
      for (unsigned int order = 0; order < 3; ++order)
      {
        const double p = k + 4. + 2 * order; // ΔΨ = r^(p-2): Ψ = r^p / p²
        factor /= p * p;
        if (order == 0)
          term.value = factor;
        term.first[order] = factor * p / 2;
        term.second[order] = factor * p / 2 * (p / 2 - 1);
      }
      terms_.push_back(term);
      degree_ = std::max(degree_, static_cast<unsigned int>(k + 8));
    }
  }
} // namespace plumbline::physics
