#include "physics/one_step_bound.h"

#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::physics
{
  double lipschitz_constant(const DoubleWell &law)
  {
    return 6 * law.c_bar() / (law.horizon() * law.horizon());
  }

  double c_t(const SolutionNorms &norms)
  {
    return .5 * (norms.second + norms.third);
  }

  double c_t_of_trapezoidal(const SolutionNorms &norms)
  {
    return (norms.third + norms.fourth) / 12;
  }

  double c_s(const DoubleWell &law, const SolutionNorms &norms, double exponent, double measure)
  {
    const double square = law.horizon() * law.horizon();
    return std::pow(law.dim(), .5 * exponent) * std::sqrt(measure) *
           (square * norms.holder_second + 4 * law.c_bar() * norms.holder);
  }

  double growth_factor(double lipschitz, double final_time)
  {
    return final_time * std::exp(final_time * (1 + lipschitz));
  }

  double section_six_factor(double c_bar, double horizon, double final_time)
  {
    const double root = std::sqrt(3.) * c_bar, square = horizon * horizon;
    return growth_factor(6 * c_bar / square, final_time) *
           (1 + root * (1 + 1 / horizon) + 4 * root / square);
  }

  double one_step_bound(double lipschitz, double theta, double step, std::uint64_t n_steps,
                        double truncation)
  {
    const double rate = step * std::max(1., lipschitz), left = 1 - theta * rate;
    if (!(left > 0))
      return std::numeric_limits<double>::infinity();
    // a - 1 = ΔtL / (1 - θΔtL) and 2 b τ Δt (a^n - 1) / (a - 1) = 2 τ (a^n - 1) / L
    const double growth = std::expm1(static_cast<double>(n_steps) * std::log1p(rate / left));
    return 2 * truncation * growth / std::max(1., lipschitz);
  }

  double printed_step_limit(const DoubleWell &law)
  {
    return law.horizon() * law.horizon() / law.c_bar();
  }

  double step_limit(const DoubleWell &law, double theta)
  {
    return 1 / (theta * std::max(1., lipschitz_constant(law)));
  }

  double energy_constant(const DoubleWell &law, double measure)
  {
    // dim ∫ t^(dim - 3/2) J dt with t = s²; powers of s are exact
    constexpr unsigned int n_points = 24;
    const auto &rule = gauss(n_points);
    double mean = 0;
    for (unsigned int q = 0; q < n_points; ++q)
    {
      const double s = rule.point(q)[0];
      mean += 2 * rule.weight(q) * law.dim() * std::pow(s, 2 * law.dim() - 2) *
              law.influence(s * s * law.horizon());
    }
    return 4 * law.c1() * mean * std::sqrt(measure);
  }

  double energy_bound(const DoubleWell &law, double measure, double energy, double final_time,
                      double impulse)
  {
    const double root = std::sqrt(energy) +
                        final_time * energy_constant(law, measure) / std::pow(law.horizon(), 1.5) +
                        impulse;
    return root * root;
  }
} // namespace plumbline::physics
