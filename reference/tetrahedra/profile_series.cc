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
