#include "physics/potential_jet.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    /// Points of the rules: exact to rounding up to ρ = .96, where the logarithm is 1/24 of the
    /// interval away.
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

  template <class Function>
  CircleJets::Table CircleJets::tabulate(double from, double to, double length,
                                         const Function &function)
  {
    // Chebyshev's interpolant on each interval, x in (-1, 1), written in powers of x
    std::array<std::array<double, n_terms>, n_terms> chebyshev{}; // T_k's coefficients
    chebyshev[0][0] = chebyshev[1][1] = 1;
    for (unsigned int k = 2; k < n_terms; ++k)
      for (unsigned int p = 0; p < n_terms; ++p)
        chebyshev[k][p] = (p > 0 ? 2 * chebyshev[k - 1][p - 1] : 0) - chebyshev[k - 2][p];

    const auto n = static_cast<std::size_t>(std::ceil((to - from) / length)) + 1;
    Table table{from, 1 / length, std::vector<std::array<Values, n_terms>>(n)};
    std::array<Values, n_terms> value{};
    for (std::size_t i = 0; i < n; ++i)
    {
      for (unsigned int j = 0; j < n_terms; ++j)
        value[j] = function(from + length * (i + .5 + .5 * std::cos(M_PI * (j + .5) / n_terms)));
      for (unsigned int k = 0; k < n_terms; ++k)
        for (unsigned int function = 0; function < n_functions; ++function)
        {
          double coefficient = 0;
          for (unsigned int j = 0; j < n_terms; ++j)
            coefficient += value[j][function] * std::cos(M_PI * k * (j + .5) / n_terms);
          coefficient *= (k == 0 ? 1. : 2.) / n_terms;
          for (unsigned int p = 0; p < n_terms; ++p)
            table.intervals[i][p][function] += coefficient * chebyshev[k][p];
        }
    }
    return table;
  }

  CircleJets::CircleJets(const Kernel<2> &kernel, double lowest_rho)
      : square_(kernel.horizon() * kernel.horizon()), inverse_(1 / square_)
  {
    if (kernel.structure() != Structure::scalar || !kernel.breaks().empty())
      throw NumericalError("radial potentials are of scalar kernels without breaks");
    const dealii::Quadrature<1> &rule = gauss(n_points);
    const auto reduced_f = [&](double rho) // f/ρ⁴, f'/ρ³, f''/ρ²
    {
      const double q = 1 - rho;
      long double f = 0, f1 = 0, f2 = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const long double tau = rule.point(i)[0], s = q + rho * tau, both = s + q;
        const long double value =
            rule.weight(i) * kernel.radial(std::sqrt(static_cast<double>(s) * square_)) * tau;
        f += value * tau * tau * reduced_artanh(rho * tau / both) / (both * both);
        f1 += value * tau * reduced_log(rho * tau / q);
        f2 += value;
      }
      const long double factor = 1 / (16.L * q * q);
      return std::array<double, 3>{static_cast<double>(f / 8), static_cast<double>(f1 * factor),
                                   static_cast<double>(f2 * factor)};
    };
    const auto first_three = [&](double rho)
    {
      const auto [f, f1, f2] = reduced_f(rho);
      return Values{f, f1, f2, 0};
    };
    constexpr double far = 1. / 4, near = 1. / 128;
    const double lowest = std::min(lowest_rho, knee);
    far_ = tabulate(lowest, knee, far, first_three);
    near_ = tabulate(knee, highest_rho, near, first_three);
    const auto all = [&](double rho) // 2 q g = ∫_0^ρ f
    {
      Values values = reduced(rho);
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const double tau = rule.point(i)[0];
        values[3] += rule.weight(i) * tau * tau * tau * tau * reduced(rho * tau)[0];
      }
      values[3] /= 2 * (1 - rho);
      return values;
    };
    Table far_of_all = tabulate(lowest, knee, far, all);
    near_ = tabulate(knee, highest_rho, near, all);
    far_ = std::move(far_of_all);
  }

  PowerJets::PowerJets(const Kernel<2> &kernel)
  {
    for (const PowerTerm &term : kernel.profile().powers())
    {
      const double k = term.exponent, c = kernel.constant() * term.coefficient *
                                          std::pow(kernel.horizon(), -term.exponent);
      const double two = (k + 2) * (k + 4), three = two * (k + 6);
      // u^(p/2): derivatives p/2 u^(p/2-1), p/2 (p/2-1) u^(p/2-2)
      terms_.push_back({term.exponent, c / (two * two), c / (2 * two * (k + 2)), c / (4 * two),
                        c / (2 * two * three), c * (k + 4) / (4 * two * three)});
      degree_ = std::max(degree_, static_cast<unsigned int>(term.exponent + 6));
    }
  }

  PotentialJet PowerJets::operator()(double u) const
  {
    PotentialJet sum{};
    const double r = std::sqrt(u);
    for (const Term &term : terms_)
    {
      double power = 1;
      for (int k = 0; k < std::abs(term.exponent); ++k)
        power *= r;
      if (term.exponent < 0)
        power = 1 / power;
      sum.value += term.value * power * u * u;
      sum.first += term.first * power * u;
      sum.second += term.second * power;
      sum.next_first += term.next_first * power * u * u;
      sum.next_second += term.next_second * power * u;
    }
    return sum;
  }
} // namespace plumbline::physics
