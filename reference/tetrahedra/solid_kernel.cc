#include "reference/tetrahedra/solid_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    /// Coefficients by exponent, which are large and cancel where functions of the dilatation end.
    using Number = long double;
    using Polynomial = std::map<int, Number>;

    /// kernel += the polynomial of r/δ up to an end.
    /// @param end  [horizons]
    /// @param reach  [horizons]
    void add(PotentialKernel &kernel, const Polynomial &polynomial, double end, double reach)
    {
      PotentialTerms part;
      part.end = end / reach;
      Number second = 0, fourth = 0;
      for (const auto &[exponent, coefficient] : polynomial)
      {
        if (coefficient == 0)
          continue;
        const Number scaled = coefficient * std::pow(Number(reach), exponent);
        const double leading = static_cast<double>(scaled);
        part.terms.push_back({leading, exponent});
        if (const double rest = static_cast<double>(scaled - leading); rest != 0)
          part.terms.push_back({rest, exponent});
        second += scaled * std::pow(Number(part.end), exponent + 3) / (exponent + 3);
        fourth += scaled * std::pow(Number(part.end), exponent + 5) / (exponent + 5);
      }
      kernel.second += static_cast<double>(second);
      kernel.fourth += static_cast<double>(fourth);
      kernel.terms.push_back(part);
    }

    /// ∫_s^1 t f dt.
    Polynomial moment_from(const Polynomial &f)
    {
      Polynomial result;
      for (const auto &[exponent, coefficient] : f)
      {
        const Number share = coefficient / (exponent + 2);
        result[0] += share;
        result[exponent + 2] -= share;
      }
      return result;
    }

    Number binomial(int n, int k)
    {
      return std::round(std::tgamma(Number(n + 1)) /
                        (std::tgamma(Number(k + 1)) * std::tgamma(Number(n - k + 1))));
    }

    /// result += factor r^power (a + b r)^n.
    void add_power(Polynomial &result, Number factor, int power, int a, int b, int n)
    {
      for (int l = 0; l <= n; ++l)
        result[power + l] +=
            factor * binomial(n, l) * std::pow(Number(a), n - l) * std::pow(Number(b), l);
    }

    /// ∫ F(|s|) F(|r - s|) ds, F a polynomial up to 1 and then 0, for r in [0, 1] and in [1, 2].
    std::array<Polynomial, 2> convolution(const Polynomial &f)
    {
      Polynomial inner, outer;
      for (const auto &[i, first] : f)
        for (const auto &[j, second] : f)
        {
          const Number product = first * second;
          // ∫_0^r s^i (r - s)^j ds + 2 ∫_0^(1-r) s^i (s + r)^j ds
          inner[i + j + 1] += product / ((i + j + 1) * binomial(i + j, i));
          for (int l = 0; l <= j; ++l)
            add_power(inner, 2 * product * binomial(j, l) / (i + l + 1), j - l, 1, -1, i + l + 1);
          // ∫_(r-1)^1 s^i (r - s)^j ds
          for (int l = 0; l <= j; ++l)
          {
            const int n = i + j - l + 1;
            const Number factor = product * binomial(j, l) * ((j - l) % 2 == 0 ? 1 : -1) / n;
            outer[l] += factor;
            add_power(outer, -factor, l, -1, 1, n);
          }
        }
      return {inner, outer};
    }

    Polynomial derivative(const Polynomial &f)
    {
      Polynomial result;
      for (const auto &[exponent, coefficient] : f)
        if (exponent != 0)
          result[exponent - 1] += exponent * coefficient;
      return result;
    }

    /// kernel += factor Δ(W*W), W = ∫_r K t dt. With the marginal 2π F of W, F = ∫_r t W dt, the
    /// convolution in space is that of marginals: r (W*W) = -2π (F*F)'.
    /// @param influence  K, lengths in horizons
    void add_dilatation(PotentialKernel &kernel, const Polynomial &influence, double factor)
    {
      const Number pi = std::acos(Number(-1));
      std::array<Polynomial, 2> laplacian;
      const auto products = convolution(moment_from(moment_from(influence)));
      for (unsigned int k = 0; k < 2; ++k)
        for (const auto &[exponent, coefficient] : derivative(derivative(derivative(products[k]))))
          laplacian[k][exponent - 1] = -2 * pi * factor * coefficient;
      constexpr double reach = 2;
      add(kernel, laplacian[1], 2, reach);
      for (const auto &[exponent, coefficient] : laplacian[1])
        laplacian[0][exponent] -= coefficient;
      add(kernel, laplacian[0], 1, reach);
    }
  } // namespace

  namespace
  {
    /// q and w as series.
    void set_series(std::vector<PotentialKernel> &parts, const physics::RadialProfile &profile)
    {
      const TensorSeries series((ProfileSeries(profile)));
      constexpr unsigned int of_logarithm = 24; // r^4 ln r by Gauss rules, to round-off
      for (unsigned int part = 0; part < 2; ++part)
      {
        PotentialTerms terms;
        terms.series = part == 0 ? series.isotropic : series.directional;
        terms.degrees = FacePotential::degrees(profile);
        for (unsigned int &degree : terms.degrees)
          degree = std::max(degree, of_logarithm);
        parts[part].terms = {terms};
      }
      // ∫ t² q = ∫ t² γ / 3, ∫ t⁴ q = ∫ t⁴ γ / 5
      parts[0].second = profile.moment(2) / 3;
      parts[0].fourth = profile.moment(4) / 5;
      parts[1].second = 0;
      parts[1].fourth = profile.moment(4) * 2 / 5;
    }
  } // namespace

  SolidKernel::SolidKernel(const physics::Kernel<3> &bonds,
                           const std::optional<physics::Dilatation<3>> &dilatation)
      : reach((dilatation ? 2 : 1) * bonds.horizon()), constant(bonds.constant()),
        m0(4 * M_PI * bonds.profile().moment(2) * std::pow(bonds.horizon() / reach, 3))
  {
    if (bonds.structure() == physics::Structure::scalar)
    {
      parts = {bonds};
      return;
    }
    parts.resize(2);
    if (!FacePotential::has_power_parts(bonds.profile()))
    {
      set_series(parts, bonds.profile());
      return;
    }
    Polynomial isotropic, directional; // q and w
    for (const auto &[coefficient, exponent] : bonds.profile().powers())
    {
      if (coefficient == 0)
        continue;
      const Number share = Number(coefficient) / exponent;
      isotropic[0] += share;
      isotropic[exponent] -= share;
      directional[exponent] += coefficient;
    }
    for (const auto &[exponent, coefficient] : isotropic)
      directional[exponent] -= 3 * coefficient;
    const double horizons = reach / bonds.horizon();
    add(parts[0], isotropic, 1, horizons);
    add(parts[1], directional, 1, horizons);
    if (!dilatation)
      return;
    const physics::Kernel<3> &influence = dilatation->influence;
    Polynomial profile;
    for (const auto &[coefficient, exponent] : influence.profile().powers())
      profile[exponent] += influence.constant() * std::pow(bonds.horizon(), 5) * coefficient;
    const physics::Lame lame = dilatation->material({});
    add_dilatation(parts[1], profile,
                   dilatation->factor(lame, lame) / (constant * std::pow(bonds.horizon(), 5)));
  }
} // namespace plumbline::reference
