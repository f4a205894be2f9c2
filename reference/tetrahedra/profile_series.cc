#include "reference/tetrahedra/profile_series.h"

#include "physics/chebyshev_basis.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    namespace multiprecision = boost::multiprecision;
    /// Quotients lose a square of the degree for each power of r or 1 - r: 30 digits of 150.
    using Wide =
        multiprecision::number<multiprecision::cpp_bin_float<500, multiprecision::digit_base_2>,
                               multiprecision::et_off>;
    using Polynomial = std::vector<Wide>; ///< of T_k(2 r - 1)

    Polynomial times_r(const Polynomial &f)
    {
      Polynomial product(f.size() + 1);
      for (std::size_t k = 0; k < f.size(); ++k)
      {
        product[k] += f[k] / 2;
        product[k + 1] += f[k] / (k == 0 ? 2 : 4);
        if (k > 0)
          product[k - 1] += f[k] / 4;
      }
      return product;
    }

    /// f / r. @pre  f(0) = 0
    Polynomial over_r(const Polynomial &f)
    {
      Polynomial quotient(f.size() + 1); // two zeros more than it has terms
      for (std::size_t k = f.size() - 1; k > 0; --k)
        quotient[k - 1] = (4 * f[k] - 2 * quotient[k] - quotient[k + 1]) / (k == 1 ? 2 : 1);
      quotient.resize(f.size() - 1);
      return quotient;
    }

    /// f(1 - r).
    Polynomial reflected(Polynomial f)
    {
      for (std::size_t k = 1; k < f.size(); k += 2)
        f[k] = -f[k];
      return f;
    }

    Wide sum_of(const Polynomial &f) // at r = 1
    {
      Wide sum = 0;
      for (const Wide &c : f)
        sum += c;
      return sum;
    }

    /// ∫_0^r f.
    Polynomial integral(const Polynomial &f)
    {
      const auto at = [&f](std::size_t k) { return k < f.size() ? f[k] : Wide(0); };
      Polynomial result(f.size() + 1);
      for (std::size_t k = 1; k < result.size(); ++k)
        result[k] = (at(k - 1) * (k == 1 ? 2 : 1) - at(k + 1)) / static_cast<int>(4 * k);
      result[0] = -sum_of(reflected(result));
      return result;
    }

    /// ∫_r^1 f.
    Polynomial integral_to_1(const Polynomial &f)
    {
      return reflected(integral(reflected(f)));
    }

    Polynomial sum(const Polynomial &f, const Wide &factor, const Polynomial &g)
    {
      Polynomial result = f;
      result.resize(std::max(f.size(), g.size()));
      for (std::size_t k = 0; k < g.size(); ++k)
        result[k] += factor * g[k];
      return result;
    }

    /// t ln t by n terms: ln t = -2 ln 2 - 2 Σ (-1)^k T_k / k.
    Polynomial logarithm(std::size_t n)
    {
      Polynomial result = {-2 * log(Wide(2))};
      for (std::size_t k = 1; k <= n; ++k)
        result.push_back(Wide(k % 2 == 0 ? -2 : 2) / k);
      result = times_r(result);
      result.resize(n); // what is left out starts beyond
      // those before the last are made small, so that the end leaves no oscillation
      constexpr double strength = 36; // exp(-36) is round-off
      constexpr int steepness = 12;
      for (std::size_t k = 0; k < n; ++k)
        result[k] *= std::exp(-strength *
                              std::pow(static_cast<double>(k) / static_cast<double>(n), steepness));
      return result;
    }

    std::vector<double> to_doubles(const Polynomial &f)
    {
      std::vector<double> result;
      for (const Wide &c : f)
        result.push_back(static_cast<double>(c));
      return result;
    }

    PotentialSeries::Number rounded(Wide value)
    {
      PotentialSeries::Number parts{};
      for (double &part : parts)
      {
        part = static_cast<double>(value);
        value -= part;
      }
      return parts;
    }

    PotentialSeries::Series rounded(const Polynomial &f)
    {
      PotentialSeries::Series result;
      for (const Wide &c : f)
        result.push_back(rounded(c));
      return result;
    }
  } // namespace

  ProfileSeries::ProfileSeries(const physics::RadialProfile &profile)
  {
    constexpr unsigned int n = 128, n_control = 1021; // no control point is one of interpolation
    const auto value = [&profile](double t) { return t * profile(t); };
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      values.push_back(value(.5 * (1 + std::cos(M_PI * (i + .5) / n))));
    const std::vector<double> transform = physics::chebyshev_transform(n);
    double largest = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      double coefficient = 0;
      for (unsigned int i = 0; i < n; ++i)
        coefficient += transform[k * n + i] * values[i];
      coefficients.push_back(coefficient);
      largest = std::max(largest, std::abs(coefficient));
    }
    constexpr double rounding = 1e-16; // of the values
    while (coefficients.size() > 2 && std::abs(coefficients.back()) < rounding * largest)
      coefficients.pop_back();
    const RadialPolynomial<double> series{coefficients, true};
    double difference = 0;
    for (unsigned int i = 1; i <= n_control; ++i)
    {
      const double t = static_cast<double>(i) / n_control;
      difference = std::max(difference, std::abs(series(t) - value(t)));
    }
    error = .5 * difference / std::abs(profile.moment(2));
  }

  TensorSeries::TensorSeries(const ProfileSeries &profile)
  {
    // t γ = g = g₀ + g₁ t + t² h, t q = g₀ (1 - t) - g₁ t ln t + t ∫_t^1 h
    const auto at_0 = [](const Polynomial &f) { return sum_of(reflected(f)); };
    constexpr std::size_t n = 126;
    const Polynomial g(profile.coefficients.begin(), profile.coefficients.end());
    const Wide g0 = at_0(g);
    const Polynomial first = over_r(sum(g, -1, {g0}));
    const Wide g1 = at_0(first);
    Polynomial q = {g0};
    if (const Polynomial rest = sum(first, -1, {g1}); rest.size() > 1)
      q = sum(q, 1, times_r(integral_to_1(over_r(rest))));
    q = sum(q, -g0, times_r({1}));
    constexpr double rounding = 1e-15;
    if (abs(g1) > rounding * abs(g0))
      q = sum(q, -g1, logarithm(n));
    isotropic = to_doubles(q);
    directional = to_doubles(sum(g, -3, q));
  }

  PotentialSeries::PotentialSeries(const std::vector<double> &profile, int order)
  {
    // r f = ∫_r^1 t γ (t - r)^n / n! dt, and the same three times more is -r² H (compact)
    Polynomial f(profile.begin(), profile.end());
    for (int k = 0; k <= order; ++k)
      f = integral_to_1(f);
    Polynomial outer = f;
    for (int k = 0; k < 3; ++k)
      outer = integral_to_1(outer);
    outer = reflected(outer);
    for (int k = 0; k < order + 4; ++k)
      outer = over_r(outer);
    compact = rounded(reflected(outer));
    potential = rounded(f);
    Polynomial moment = f;
    for (std::size_t k = 0; k < moments.size(); ++k)
    {
      moments[k] = rounded(sum_of(integral(moment)));
      moment = times_r(moment);
    }
    // (r⁴ g₁)' = r³ f, (r³ g)' = r² g₁, H' = r g
    const Polynomial edges = over_r(over_r(over_r(integral(times_r(times_r(f))))));
    of_edges = rounded(edges);
    const Polynomial planes = over_r(over_r(integral(times_r(edges))));
    density = rounded(planes);
    regular = rounded(over_r(integral(planes)));
  }
} // namespace plumbline::reference
