#include "reference/mesh/edge_integrals.h"

#include "physics/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    double cross(const Vector2 &a, const Vector2 &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double sine(const Segment &e, const Segment &f)
    {
      return std::abs(cross(e.along, f.along)) / (e.along.norm() * f.along.norm());
    }

    /// Below it the division by the sine in D costs too many digits.
    constexpr double least_sine = .005;
    /// The same of potentials without a horizon, which are larger than what remains of them.
    constexpr double least_whole_sine = .2;
    /// Sides that differ by no more than the rounding of their ends.
    constexpr double no_sine = 1e-12;

    /// Points of a rule on a side: g is analytic up to |z| = 0, far from the circle in terms of h.
    unsigned int n_points(double longest, double horizon)
    {
      const double ratio = longest / horizon;
      return ratio < .3 ? 8 : ratio < .5 ? 12 : 24;
    }
  } // namespace

  PowerPotential::PowerPotential(const physics::Kernel<2> &kernel)
  {
    if (kernel.profile().degree() == 0 && kernel.profile().lowest_exponent() == 0)
      return;
    const double horizon = kernel.horizon();
    const auto add = [&](int p, double coefficient) // of (r/δ)^p
    {
      std::vector<double> &series = p % 2 == 0 ? even_ : odd_;
      const auto place = static_cast<std::size_t>(p / 2);
      series.resize(std::max(series.size(), place + 1));
      series[place] += coefficient * std::pow(horizon, -p);
    };
    for (const physics::PowerTerm &term : kernel.profile().powers())
    {
      const int k = term.exponent;
      add(k + 4, kernel.constant() * term.coefficient * std::pow(horizon, 4) /
                     ((k + 2.) * (k + 2) * (k + 4) * (k + 4)));
    }
  }

  double PowerPotential::integrate(double from, double to, double h, double a, double b,
                                   bool for_divergence) const
  {
    const std::array<double, 2> x = {from, to};
    double result = 0;
    for (const bool is_odd : {true, false})
    {
      const std::vector<double> &series = is_odd ? odd_ : even_;
      for (unsigned int end = 0; end < 2 && !series.empty(); ++end)
      {
        // I_p = ∫_0^x r^p = (x r^p + p h² I_(p-2)) / (p + 1), from I_0 or h² I_(-1)
        const double square = x[end] * x[end] + h * h, r = std::sqrt(square);
        double power = is_odd ? r : 1, line = x[end], sum = 0;
        if (is_odd)
          line = .5 * (x[end] * r + (h > 0 ? h * h * std::asinh(x[end] / h) : 0));
        int p = is_odd ? 1 : 0;
        for (const double coefficient : series)
        {
          const double moment = power * square / (p + 2); // ∫ x r^p
          sum += coefficient * (a * line + b * moment) / (for_divergence ? p + 2 : 1);
          p += 2;
          power *= square;
          line = (x[end] * power + p * h * h * line) / (p + 1);
        }
        result += end == 1 ? sum : -sum;
      }
    }
    return result;
  }

  EdgeIntegrals::EdgeIntegrals(const physics::RadialPotential &potential,
                               const PowerPotential &whole, double longest)
      : potential_(potential), whole_(whole), square_(potential.horizon() * potential.horizon()),
        points_(physics::gauss(n_points(longest, potential.horizon())).get_points()),
        weights_(physics::gauss(n_points(longest, potential.horizon())).get_weights())
  {
  }

  /// Add ∫ over [from, to] in parts: between the roots, and before and after them.
  template <class Integrand>
  void EdgeIntegrals::split(double from, double to, double first_root, double second_root,
                            const Integrand &integrand, Potentials &sum) const
  {
    const auto integrate = [&](double a, double b)
    {
      double part = 0;
      for (std::size_t i = 0; i < points_.size(); ++i)
        part += weights_[i] * integrand(a + (b - a) * points_[i][0]);
      return (b - a) * part;
    };
    const double enter = std::clamp(first_root, from, to),
                 leave = std::clamp(second_root, from, to);
    if (enter > from)
      sum.out += integrate(from, enter);
    if (leave > enter)
      sum.in += integrate(enter, leave);
    if (to > leave)
      sum.out += integrate(leave, to);
  }

  /// Integrals over a side of functions of ρ = 1 - |z|²/δ², z from a point to the side.
  template <class Integrand>
  Potentials EdgeIntegrals::on_segment(const Point<2> &v, const Segment &e, bool at_circle,
                                       bool for_divergence, const Integrand &integrand) const
  {
    // |z|² = c + 2 b σ + a σ²
    const Vector2 z = e.start - v;
    const double a = e.along.norm_square(), b = z * e.along, c = z.norm_square();
    Potentials result;
    if (at_circle)
    {
      const double discriminant = b * b - a * (c - square_);
      const double root = discriminant > 0 ? std::sqrt(discriminant) : 0;
      const double scale = 1 / square_;
      split(
          0, 1, (-b - root) / a, (-b + root) / a,
          [&](double sigma)
          {
            const double rho = 1 - (c + (2 * b + a * sigma) * sigma) * scale;
            return integrand(std::min(rho, physics::RadialPotential::highest_rho));
          },
          result);
    }
    if (!whole_.is_none())
    {
      const double length = std::sqrt(a), from = b / length;
      result.whole = whole_.integrate(from, from + length, std::abs(cross(z, e.along)) / length,
                                      1 / length, 0, for_divergence);
    }
    return result;
  }

  Potentials EdgeIntegrals::from_point(const Point<2> &v, const Segment &e, bool at_circle) const
  {
    return on_segment(v, e, at_circle, true, [&](double rho) { return potential_.g(rho); });
  }

  bool EdgeIntegrals::is_parallel(const Segment &e, const Segment &f)
  {
    const double product = cross(e.along, f.along);
    return product * product <
           least_sine * least_sine * e.along.norm_square() * f.along.norm_square();
  }

  Potentials EdgeIntegrals::between(const Segment &e, const Segment &f,
                                    const Potentials (&from_e)[2],
                                    const Potentials (&from_f)[2]) const
  {
    const Vector2 w = f.start - e.start, &a = f.along, &b = e.along;
    const double factor = 1 / cross(b, a);
    Potentials result;
    result.add(factor * cross(w, a), from_e[0]);
    result.add(-factor * cross(w - b, a), from_e[1]);
    result.add(factor * cross(w, b), from_f[0]);
    result.add(-factor * cross(w + a, b), from_f[1]);
    result.in *= -square_ * square_; // Ψ = -div(z δ⁴ g), but +div of the whole
    result.out *= -square_ * square_;
    if (!whole_.is_none() && sine(e, f) < least_whole_sine)
      result.whole = slanted(e, f, false).whole;
    return result;
  }

  Potentials EdgeIntegrals::between_parallel(const Segment &e, const Segment &f,
                                             bool at_circle) const
  {
    Potentials result =
        sine(e, f) < no_sine ? on_one_line(e, f, at_circle) : slanted(e, f, at_circle);
    result.in *= square_ * square_;
    result.out *= square_ * square_;
    return result;
  }

  /// z moves on one line: z = c + τ u, τ the sum of two uniform variables, whose density is a
  /// trapezoid. Measured from the middles, so that a small angle counts in second order alone.
  Potentials EdgeIntegrals::on_one_line(const Segment &e, const Segment &f, bool at_circle) const
  {
    const double length_e = e.along.norm(), length_f = f.along.norm();
    const Vector2 c = f.middle() - e.middle();
    const double along = c * f.along / length_f, distance = std::abs(cross(c, f.along)) / length_f;
    const double half = std::sqrt(std::max(0., square_ - distance * distance));
    const double reach = .5 * (length_e + length_f), flat = .5 * std::abs(length_e - length_f);
    const double height = 1 / std::max(length_e, length_f), scale = 1 / square_;
    const std::array<double, 4> knots = {-reach, -flat, flat, reach};
    Potentials result;
    for (unsigned int i = 0; i < 3; ++i)
    {
      if (!(knots[i + 1] > knots[i]))
        continue;
      const double slope = i == 1 ? 0 : (i == 0 ? height : -height) / (reach - flat),
                   start = i == 0 ? 0 : height; // density = start + slope (τ - knot)
      if (at_circle)
        split(
            knots[i], knots[i + 1], -half - along, half - along,
            [&](double tau)
            {
              const double x = along + tau;
              const double rho = 1 - (distance * distance + x * x) * scale;
              return (start + slope * (tau - knots[i])) *
                     potential_.f(std::min(rho, physics::RadialPotential::highest_rho));
            },
            result);
      if (!whole_.is_none())
        result.whole += whole_.integrate(along + knots[i], along + knots[i + 1], distance,
                                         start - slope * (along + knots[i]), slope, false);
    }
    return result;
  }

  /// An outer rule in s, cut where the circle about x(s) meets an end of f. Circles that touch f
  /// between its ends need no more: depths below it that change with s are less than .005 |e|, and
  /// f is of their fourth power.
  Potentials EdgeIntegrals::slanted(const Segment &e, const Segment &f, bool at_circle) const
  {
    std::vector<double> cuts = {0, 1};
    for (const Point<2> &end : {f.start, f.end()})
    {
      const Vector2 z = e.start - end;
      const double a = e.along.norm_square(), b = z * e.along, c = z.norm_square();
      const double discriminant = b * b - a * (c - square_);
      if (discriminant > 0)
        for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)})
          if (const double s = (-b + root) / a; s > 0 && s < 1)
            cuts.push_back(s);
    }
    std::sort(cuts.begin(), cuts.end());
    Potentials result;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      for (std::size_t i = 0; i < points_.size(); ++i)
      {
        const double length = cuts[k + 1] - cuts[k];
        const Point<2> x = e.start + (cuts[k] + length * points_[i][0]) * e.along;
        result.add(length * weights_[i], on_segment(x, f, at_circle, false,
                                                    [&](double rho) { return potential_.f(rho); }));
      }
    return result;
  }
} // namespace plumbline::reference
