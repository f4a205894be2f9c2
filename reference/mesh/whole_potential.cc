#include "reference/mesh/whole_potential.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    /// A profile as powers up to some t, by Chebyshev's interpolant; nothing where that takes too
    /// many or they cancel each other.
    std::optional<physics::RadialProfile::Powers> fit(const physics::RadialProfile &profile,
                                                      double farthest)
    {
      constexpr unsigned int n = 40;
      const int lowest = profile.lowest_exponent();
      std::vector<long double> coefficient(n), before(n), now(n), sum(n); // by powers of x = t/T
      double largest = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        const double t = farthest * (.5 + .5 * std::cos(M_PI * (j + .5) / n));
        const double value = profile(t) * std::pow(t, -lowest);
        largest = std::max(largest, std::abs(value));
        for (unsigned int k = 0; k < n; ++k)
          coefficient[k] += (k == 0 ? 1.L : 2.L) / n * value *
                            std::cos(static_cast<long double>(M_PI * k * (j + .5) / n));
      }
      constexpr double noise = 4e-15, most_cancelled = 1e4; // the latter leaves twelve digits
      while (!coefficient.empty() && std::abs(coefficient.back()) < noise * largest)
        coefficient.pop_back();
      if (coefficient.size() > n - 10)
        return {};
      now[0] = 1;
      for (std::size_t k = 0; k < coefficient.size(); ++k) // T_k of 2 x - 1
      {
        std::vector<long double> next(n);
        for (unsigned int p = 0; p < n; ++p)
        {
          sum[p] += coefficient[k] * now[p];
          const long double shifted = (p > 0 ? 2 * now[p - 1] : 0) - now[p];
          next[p] = k == 0 ? shifted : 2 * shifted - before[p];
        }
        before = std::exchange(now, next);
      }
      physics::RadialProfile::Powers powers;
      double size = 0;
      for (unsigned int p = 0; p < coefficient.size(); ++p)
      {
        size += static_cast<double>(std::abs(sum[p]));
        powers.push_back({static_cast<double>(sum[p]) * std::pow(farthest, -static_cast<double>(p)),
                          static_cast<int>(p) + lowest});
      }
      if (size > most_cancelled * largest)
        return {};
      return powers;
    }
  } // namespace

  std::string WholePotential::refuse(const physics::Kernel<2> &kernel, double farthest)
  {
    const double t = farthest / kernel.horizon();
    if (physics::RegularPotential::can_have(kernel, t) || as_powers(kernel, farthest))
      return "";
    return "the kernel varies fast in relation to the horizon or the triangles";
  }

  std::optional<physics::Kernel<2>> WholePotential::as_powers(const physics::Kernel<2> &kernel,
                                                              double farthest)
  {
    if (!kernel.profile().is_function())
      return kernel;
    const auto powers = fit(kernel.profile(), farthest / kernel.horizon());
    if (!powers)
      return {};
    return physics::Kernel<2>(kernel.structure(), *powers, kernel.horizon(), kernel.constant());
  }

  WholePotential::WholePotential(const physics::Kernel<2> &kernel, double farthest, double longest)
      : horizon_(kernel.horizon())
  {
    const double t = farthest / horizon_;
    if (kernel.profile().is_function() && physics::RegularPotential::can_have(kernel, t))
    {
      regular_.emplace(kernel, t);
      // as many as resolve the kernel along a line, and the powers that its potential adds
      constexpr unsigned int of_potential = 8;
      n_points_ =
          (kernel.profile().degree(std::min(1., 2 * longest / horizon_)) + of_potential) / 2 + 1;
    }
    else if (const auto powers = as_powers(kernel, farthest))
      powers_.emplace(*powers);
    else
      throw NumericalError("a potential is asked for with a kernel that varies too fast");
  }

  PowerPotential::Entries WholePotential::integrate(const Vector2 &e, double from, double to,
                                                    double h, double a, double b,
                                                    bool for_divergence) const
  {
    if (powers_)
      return powers_->integrate(e, from, to, h, a, b, for_divergence);
    const auto &rule = physics::gauss(n_points_);
    const double scale = 1 / (horizon_ * horizon_);
    double sum = 0;
    for (std::size_t i = 0; i < rule.size(); ++i)
    {
      const double x = from + (to - from) * rule.point(i)[0], q = (x * x + h * h) * scale;
      sum += rule.weight(i) * (a + b * x) * (for_divergence ? regular_->g(q) : regular_->f(q));
    }
    return {(to - from) * sum / (scale * scale), 0, 0};
  }
} // namespace plumbline::reference
