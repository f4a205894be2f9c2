#include "study/slow_power.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    constexpr double lowest_power = .4, highest_power = .7, power_step = .05;

    /// Sum of squares of a u + b v - 1 at its minimum over a, b >= 0.
    double least_residual(const std::vector<double> &u, const std::vector<double> &v)
    {
      double uu = 0, uv = 0, vv = 0, u1 = 0, v1 = 0;
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        uu += u[i] * u[i];
        uv += u[i] * v[i];
        vv += v[i] * v[i];
        u1 += u[i];
        v1 += v[i];
      }
      const auto residual = [&](double a, double b)
      {
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          sum += std::pow(a * u[i] + b * v[i] - 1, 2);
        return sum;
      };
      constexpr double parallel = 1e-14; // of uu vv: u and v are multiples to rounding
      const double determinant = uu * vv - uv * uv;
      const double a = vv * u1 - uv * v1, b = uu * v1 - uv * u1;
      if (determinant > parallel * uu * vv && a >= 0 && b >= 0)
        return residual(a / determinant, b / determinant);
      return std::min(residual(u1 / uu, 0), residual(0, v1 / vv));
    }

    /// Of the best fit by two fields, one of which falls like x^s, in relative residuals.
    double residual_of(const std::vector<double> &x, const std::vector<double> &e, double s)
    {
      constexpr double slowest = .75, gap = .25, fastest = 8, step = .01;
      double best = 1e300;
      std::vector<double> u(x.size()), v(x.size());
      for (double p = std::max(slowest, s + gap); p <= fastest; p += step)
        for (const int square : {1, 2}) // of norms: parallel fields, orthogonal ones
        {
          for (std::size_t i = 0; i < x.size(); ++i)
          {
            const double scale = std::pow(e[i], square);
            u[i] = std::pow(x[i] / x.front(), square * s) / scale;
            v[i] = std::pow(x[i] / x.front(), square * p) / scale;
          }
          // relative residuals of squares are twice those of the errors
          best = std::min(best, least_residual(u, v) / (square * square));
        }
      return best;
    }

    /// Of two sums of squares, of n levels less three parameters each, which are equal by chance
    /// in one of 20 cases: quantiles of the F distribution.
    double critical_ratio(std::size_t n_levels)
    {
      constexpr std::array<double, 8> of_freedom = {161.4, 19.00, 9.28, 6.39,
                                                    5.05,  4.28,  3.79, 3.44};
      return of_freedom[std::min(n_levels - 4, of_freedom.size() - 1)];
    }
  } // namespace

  Approach find_approach(const std::vector<double> &x, const std::vector<double> &e)
  {
    using Kind = Approach::Kind;
    const std::size_t n = x.size();
    const double rounding = 1e-24 * static_cast<double>(n); // of squares, of numbers to 12 digits
    const double factor = critical_ratio(n);
    const double of_plateau = std::max(residual_of(x, e, 0), rounding);
    Approach approach;
    double of_power = 1e300;
    std::vector<std::array<double, 2>> powers;
    for (double s = lowest_power; s < highest_power + power_step / 2; s += power_step)
    {
      powers.push_back({s, std::max(residual_of(x, e, s), rounding)});
      if (powers.back()[1] < of_power)
      {
        of_power = powers.back()[1];
        approach.power = s;
      }
    }
    approach.low = approach.high = approach.power;
    for (const auto &[s, residual] : powers)
      if (residual <= factor * of_power)
      {
        approach.low = std::min(approach.low, s);
        approach.high = std::max(approach.high, s);
      }
    const double last_rate = std::log(e[n - 1] / e[n - 2]) / std::log(x[n - 1] / x[n - 2]);
    if (last_rate < lowest_power || of_power > factor * of_plateau)
      approach.kind = Kind::plateau;
    else if (n > 4 && of_plateau > factor * of_power)
      approach.kind = Kind::slow_power;
    return approach;
  }
} // namespace plumbline::study
