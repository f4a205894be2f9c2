#include "physics/radial_potential.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <array>
#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    /// Points of the rules for f and g: exact to rounding up to ρ = .96, where the logarithm is
    /// 1/24 of the interval away.
    constexpr unsigned int n_points = 64;

    /// (artanh z - z) / z³.
    long double reduced_artanh(long double z)
    {
      if (std::abs(z) > .5L)
        return (std::atanh(z) - z) / (z * z * z);
      long double sum = 0;
      constexpr int last = 65; // z^62 / 65 < 4e-21
      for (int k = last; k >= 3; k -= 2)
        sum = sum * z * z + 1.L / k;
      return sum;
    }

    /// f/ρ⁴: Green's function is 4 (s + q) (artanh z - z) / 2, z = (s - q)/(s + q), s = q + ρτ.
    double reduced_f(const Kernel<2> &kernel, double rho)
    {
      const dealii::Quadrature<1> &rule = gauss(n_points);
      const double q = 1 - rho;
      long double sum = 0;
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const long double tau = rule.point(i)[0], s = q + rho * tau, both = s + q;
        const double value = kernel.radial(kernel.horizon() * std::sqrt(static_cast<double>(s)));
        sum += rule.weight(i) * value * tau * tau * tau * reduced_artanh(rho * tau / both) /
               (both * both);
      }
      return static_cast<double>(sum / 8);
    }
  } // namespace

  template <class Function>
  RadialPotential::Tables RadialPotential::tabulate(const Function &function) const
  {
    // Chebyshev's interpolant on each interval, x in (-1, 1), written in powers of x
    std::array<std::array<double, n_terms>, n_terms> chebyshev{}; // T_k's coefficients
    chebyshev[0][0] = chebyshev[1][1] = 1;
    for (unsigned int k = 2; k < n_terms; ++k)
      for (unsigned int p = 0; p < n_terms; ++p)
        chebyshev[k][p] = (p > 0 ? 2 * chebyshev[k - 1][p - 1] : 0) - chebyshev[k - 2][p];

    const auto make = [&](double from, double to, double length)
    {
      const auto n = static_cast<std::size_t>(std::ceil((to - from) / length)) + 1;
      Table table{from, length, std::vector<double>(n * n_terms)};
      std::array<double, n_terms> value{};
      for (std::size_t i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n_terms; ++j)
          value[j] = function(from + length * (i + .5 + .5 * std::cos(M_PI * (j + .5) / n_terms)));
        for (unsigned int k = 0; k < n_terms; ++k)
        {
          double coefficient = 0;
          for (unsigned int j = 0; j < n_terms; ++j)
            coefficient += value[j] * std::cos(M_PI * k * (j + .5) / n_terms);
          coefficient *= (k == 0 ? 1. : 2.) / n_terms;
          for (unsigned int p = 0; p < n_terms; ++p)
            table.coefficients[i * n_terms + p] += coefficient * chebyshev[k][p];
        }
      }
      return table;
    };
    constexpr double knee = -.5, far = 1. / 16, near = 1. / 128;
    return {make(std::min(lowest_, knee), knee, far), make(knee, highest_rho, near)};
  }

  RadialPotential::RadialPotential(const Kernel<2> &kernel, double lowest_rho)
      : horizon_(kernel.horizon()), lowest_(lowest_rho)
  {
    if (kernel.structure() != Structure::scalar || !kernel.breaks().empty())
      throw NumericalError("radial potentials are of scalar kernels without breaks");
    f_ = tabulate([&](double rho) { return reduced_f(kernel, rho); });
    g_ = tabulate(
        [&](double rho)
        {
          const dealii::Quadrature<1> &rule = gauss(n_points);
          double sum = 0;
          for (unsigned int i = 0; i < rule.size(); ++i)
          {
            const double tau = rule.point(i)[0];
            sum += rule.weight(i) * tau * tau * tau * tau * f_(rho * tau);
          }
          return sum / (2 * (1 - rho));
        });
  }
} // namespace plumbline::physics
