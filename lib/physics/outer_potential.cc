#include "physics/outer_potential.h"

#include "physics/gauss.h"

#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    /// Coefficients of 1, q, ln q, q ln q.
    std::array<long double, 4> of_moments(long double m0, long double m1, long double l0,
                                          long double l1)
    {
      return {(2 * m1 - l1) / 16, -(2 * m0 + l0) / 16, m1 / 16, m0 / 16};
    }
  } // namespace

  OuterPotential::OuterPotential(const Kernel<2> &powers)
  {
    const bool is_tensor = powers.structure() == Structure::tensor;
    for (const PowerTerm &term : powers.profile().powers())
    {
      const long double c = static_cast<long double>(powers.constant()) * term.coefficient;
      const long double half = term.exponent / 2.L; // C = c s^half
      const auto moment = [&](int p) { return c / (half + p + 1); };
      const auto logarithm = [&](int p) { return -c / ((half + p + 1) * (half + p + 1)); };
      const auto trace = of_moments(moment(0), moment(1), logarithm(0), logarithm(1));
      // of the logarithm H r² ln(r/δ)/48, see PowerPotential: zero at the circle
      const long double finite_part = term.exponent == 0 ? 11 * c / 6 : moment(-1);
      const std::array<long double, 4> rest = {-3 * moment(0) / 96, finite_part / 96,
                                               3 * moment(1) / 96, -moment(2) / 96};
      for (unsigned int i = 0; i < 4; ++i)
      {
        trace_[i] += is_tensor ? trace[i] / 2 : trace[i];
        if (is_tensor)
          rest_[i] += rest[i];
      }
    }
  }

  OuterPotential OuterPotential::of_smooth(const Kernel<2> &kernel)
  {
    const auto &rule = gauss(100);
    long double moment[2] = {}, logarithm[2] = {};
    for (unsigned int i = 0; i < rule.size(); ++i)
    {
      // s = τ⁸, for the logarithm's sake
      const long double tau = rule.point(i)[0], s = std::pow(tau, 8);
      const long double weight =
          rule.weight(i) * 8 * std::pow(tau, 7) *
          kernel.radial(kernel.horizon() * static_cast<double>(std::sqrt(s)));
      for (unsigned int p = 0; p < 2; ++p)
      {
        moment[p] += weight * (p == 0 ? 1 : s);
        logarithm[p] += weight * (p == 0 ? 1 : s) * std::log(s);
      }
    }
    OuterPotential result;
    result.trace_ = of_moments(moment[0], moment[1], logarithm[0], logarithm[1]);
    return result;
  }

  OuterPotential::Values OuterPotential::f(long double q) const
  {
    const long double log = std::log(q);
    return {trace_[0] + trace_[1] * q + (trace_[2] + trace_[3] * q) * log,
            rest_[0] + rest_[1] * q + (rest_[2] + rest_[3] / q) / q};
  }

  OuterPotential::Values OuterPotential::antiderivative(long double q) const
  {
    const long double log = std::log(q);
    return {q * (trace_[0] - trace_[2] + trace_[2] * log) +
                q * q * (trace_[1] / 2 - trace_[3] / 4 + trace_[3] / 2 * log),
            q * (q * (rest_[0] / 2 + q * rest_[1] / 3) + rest_[2]) + rest_[3] * log};
  }

  OuterPotential::Values OuterPotential::integral(long double q) const
  {
    const Values at = antiderivative(q), at_circle = antiderivative(1);
    return {at[0] - at_circle[0], at[1] - at_circle[1]};
  }
} // namespace plumbline::physics
