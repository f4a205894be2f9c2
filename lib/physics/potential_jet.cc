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

  /// Functions first ... last - 1 of both tables.
  template <class Function>
  void CircleJets::tabulate(unsigned int first, unsigned int last, const Function &function)
  {
    // Chebyshev's interpolant on each interval, x in (-1, 1), written in powers of x
    std::array<std::array<double, n_terms>, n_terms> chebyshev{}; // T_k's coefficients
    chebyshev[0][0] = chebyshev[1][1] = 1;
    for (unsigned int k = 2; k < n_terms; ++k)
      for (unsigned int p = 0; p < n_terms; ++p)
        chebyshev[k][p] = (p > 0 ? 2 * chebyshev[k - 1][p - 1] : 0) - chebyshev[k - 2][p];
    std::array<Values, n_terms> value{};
    for (Table *const table : {&far_, &near_})
      for (std::size_t i = 0; i < table->intervals.size(); ++i)
      {
        for (unsigned int j = 0; j < n_terms; ++j)
          value[j] = function(table->start + (i + .5 + .5 * std::cos(M_PI * (j + .5) / n_terms)) /
                                                 table->per_length);
        for (unsigned int k = 0; k < n_terms; ++k)
          for (unsigned int f = first; f < last; ++f)
          {
            double coefficient = 0;
            for (unsigned int j = 0; j < n_terms; ++j)
              coefficient += value[j][f] * std::cos(M_PI * k * (j + .5) / n_terms);
            coefficient *= (k == 0 ? 1. : 2.) / n_terms;
            for (unsigned int p = 0; p < n_terms; ++p)
              table->intervals[i][p][f] += coefficient * chebyshev[k][p];
          }
      }
  }

  CircleJets::CircleJets(const Kernel<2> &kernel, double lowest_rho)
      : square_(kernel.horizon() * kernel.horizon()), inverse_(1 / square_)
  {
    if (kernel.structure() != Structure::scalar || !kernel.breaks().empty())
      throw NumericalError("radial potentials are of scalar kernels without breaks");
    const auto make = [](double from, double to, double length)
    {
      const auto n = static_cast<std::size_t>(std::ceil((to - from) / length)) + 1;
      return Table{from, 1 / length, std::vector<std::array<Values, n_terms>>(n)};
    };
    far_ = make(std::min(lowest_rho, knee), knee, 1. / 4);
    near_ = make(knee, highest_rho, 1. / 128);

    const dealii::Quadrature<1> &rule = gauss(n_points);
    tabulate(0, 3,
             [&](double rho)
             {
               const double q = 1 - rho;
               long double f = 0, f1 = 0, f2 = 0;
               for (unsigned int i = 0; i < n_points; ++i)
               {
                 const long double tau = rule.point(i)[0], s = q + rho * tau, both = s + q;
                 const long double value =
                     rule.weight(i) * kernel.radial(std::sqrt(static_cast<double>(s) * square_)) *
                     tau;
                 f += value * tau * tau * reduced_artanh(rho * tau / both) / (both * both);
                 f1 += value * tau * reduced_log(rho * tau / q);
                 f2 += value;
               }
               const long double factor = 1 / (16.L * q * q);
               return Values{static_cast<double>(f / 8), static_cast<double>(f1 * factor),
                             static_cast<double>(f2 * factor)};
             });
    // ∫_0^ρ of what is ρ^power times a function in the tables, over ρ^(power + 1)
    const auto integral = [&](double rho, unsigned int function, int power)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const double tau = rule.point(i)[0];
        sum += rule.weight(i) * std::pow(tau, power) * evaluate<n_functions>(rho * tau)[function];
      }
      return sum;
    };
    tabulate(3, 4,
             [&](double rho) {
               return Values{0, 0, 0, integral(rho, 0, 4) / (2 * (1 - rho))};
             });
    tabulate(4, 5, [&](double rho) { return Values{0, 0, 0, 0, integral(rho, 3, 5) / 2}; });
    tabulate(5, 6,
             [&](double rho)
             { return Values{0, 0, 0, 0, 0, integral(rho, 4, 6) / (2 * (1 - rho))}; });
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
