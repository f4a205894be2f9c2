#include "physics/dilatation_in_space.h"

#include "base/error.h"
#include "physics/chebyshev_basis.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::physics
{
  namespace
  {
    using Value = DilatationInSpace::Value;

    /// Degree of the polynomial f(r) = K(r) r; f f has twice this degree in p and s together.
    unsigned int degree_of(const RadialProfile &profile)
    {
      return profile.lowest_exponent() + 1 + profile.degree();
    }

    /// C by its double integral.
    Value integral(const Kernel<3> &influence, double w)
    {
      const unsigned int degree = degree_of(influence.profile());
      const auto &sums = gauss(degree + 2), &differences = gauss(degree + 3);
      const auto f = [&](double r) { return r * influence.radial(r); };
      const double diameter = 2 * influence.horizon(), end = std::min(1., (diameter - w) / w);
      Value value;
      for (unsigned int i = 0; i < differences.size(); ++i)
      {
        const double s = end * differences.point(i)[0], to = diameter - w * s;
        for (unsigned int j = 0; j < sums.size(); ++j)
        {
          const double p = w + (to - w) * sums.point(j)[0];
          const double weight = M_PI / 4 * end * differences.weight(i) * (to - w) * sums.weight(j) *
                                f((p + w * s) / 2) * f((p - w * s) / 2);
          const double across = -weight * (p - w) * (p + w) * (1 - s) * (1 + s);
          value.across += across;
          value.excess += 2 * weight * (w - p * s) * (w + p * s) - across;
        }
      }
      return value;
    }

    /// On [from, from + δ], without terms below round-off.
    std::vector<Value> series_from(double from, const Kernel<3> &influence)
    {
      constexpr double negligible = 1e-17;
      const unsigned int n =
          24 + 2 * degree_of(influence.profile()); // C has a factor 1/w³ beyond δ
      const std::vector<double> transform = chebyshev_transform(n);
      std::vector<Value> series(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        const double s = std::cos(M_PI * (i + .5) / n);
        const Value value = integral(influence, from + .5 * influence.horizon() * (1 + s));
        for (unsigned int k = 0; k < n; ++k)
        {
          series[k].across += transform[k * n + i] * value.across;
          series[k].excess += transform[k * n + i] * value.excess;
        }
      }
      const auto size = [](const Value &term)
      { return std::abs(term.across) + std::abs(term.excess); };
      double largest = 0;
      for (const Value &term : series)
        largest = std::max(largest, size(term));
      while (series.size() > 1 && size(series.back()) <= negligible * largest)
        series.pop_back();
      return series;
    }
  } // namespace

  DilatationInSpace::DilatationInSpace(const Kernel<3> &influence) : horizon_(influence.horizon())
  {
    const RadialProfile &profile = influence.profile();
    if (!profile.breaks().empty() || profile.lowest_exponent() < -1)
      throw InputError(
          "the dilatation in three dimensions needs an influence function that is smooth inside "
          "the horizon and at most as singular as 1/r at r = 0; this one " +
          (profile.breaks().empty()
               ? "behaves like r^" + std::to_string(profile.lowest_exponent())
               : "has a table of " + std::to_string(profile.breaks().size() + 2) + " rows") +
          "; choose another Kernel/type");
    series_ = {series_from(0, influence), series_from(horizon_, influence)};
  }

  DilatationInSpace::Value DilatationInSpace::operator()(double w) const
  {
    if (!(w < 2 * horizon_))
      return {};
    const std::vector<Value> &series = series_[w < horizon_ ? 0 : 1];
    const double s = 2 * (w < horizon_ ? w : w - horizon_) / horizon_ - 1;
    return {chebyshev_sum(series, &Value::across, s), chebyshev_sum(series, &Value::excess, s)};
  }
} // namespace plumbline::physics
