#include "physics/radial_potential.h"

#include "base/error.h"
#include "physics/gauss.h"

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

    /// f/ρ⁴, s = q + ρτ: Green's function is 4 (s + q) (artanh z - z) / 2, z = (s - q)/(s + q).
    template <unsigned int n_parts>
    std::array<double, n_parts> reduced_f(const Kernel<2> &kernel, double rho)
    {
      const dealii::Quadrature<1> &rule = gauss(n_points);
      const double q = 1 - rho;
      std::array<long double, n_parts> sum{};
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const long double tau = rule.point(i)[0], s = q + rho * tau, both = s + q;
        const long double weight =
            rule.weight(i) * tau * tau * tau *
            kernel.radial(kernel.horizon() * std::sqrt(static_cast<double>(s)));
        sum[0] += weight * reduced_artanh(rho * tau / both) / (both * both);
        if constexpr (n_parts == 2)
          sum[1] += weight / s;
      }
      std::array<double, n_parts> result{};
      if constexpr (n_parts == 1)
        result[0] = static_cast<double>(sum[0] / 8);
      else // of half the trace
        result = {static_cast<double>(sum[0] / 16), static_cast<double>(sum[1] / (96 * q * q))};
      return result;
    }
  } // namespace

  template <unsigned int n_parts>
  PotentialTables<n_parts>::PotentialTables(const Kernel<2> &kernel, double lowest_rho)
      : horizon_(kernel.horizon()), lowest_(lowest_rho)
  {
    if ((kernel.structure() == Structure::tensor) != (n_parts == 2) || !kernel.breaks().empty())
      throw NumericalError("a radial potential is asked for with another kind of kernel");
    f_ = {[&](double rho) { return reduced_f<n_parts>(kernel, rho); }, lowest_, highest_rho};
    const auto reduced_g = [&](double rho)
    {
      const dealii::Quadrature<1> &rule = gauss(n_points);
      Values sum{};
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double tau = rule.point(i)[0], weight = rule.weight(i) * std::pow(tau, 4);
        const Values value = f_(rho * tau);
        for (unsigned int part = 0; part < n_parts; ++part)
          sum[part] += weight * value[part] * (part == 1 ? 1 - rho * tau : 1);
      }
      for (unsigned int part = 0; part < n_parts; ++part)
        sum[part] /= 2 * std::pow(1 - rho, part + 1.);
      return sum;
    };
    g_ = {reduced_g, lowest_, highest_rho};
  }

  template class PotentialTables<1>;
  template class PotentialTables<2>;
} // namespace plumbline::physics
