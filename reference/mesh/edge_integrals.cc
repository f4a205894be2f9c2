#include "reference/mesh/edge_integrals.h"

#include "reference/mesh/line_rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    double sine(const Segment &e, const Segment &f)
    {
      return std::abs(cross(e.along, f.along)) / (e.along.norm() * f.along.norm());
    }

    template <std::size_t n>
    void add_to(std::array<double, n> &sum, double factor, const std::array<double, n> &values)
    {
      for (std::size_t i = 0; i < n; ++i)
        sum[i] += factor * values[i];
    }

    /// Below them the division by the sine in D costs too many digits: measured by linear fields,
    /// for which sides that are nearly parallel make most of the rounding. The smaller a potential
    /// is where there are many pairs, the fewer digits have to be saved.
    constexpr double least_sine = .02, least_product_sine = .03, least_whole_sine = .2;
    /// Sides that differ by no more than the rounding of their ends.
    constexpr double no_sine = 1e-12;
  } // namespace

  template <unsigned int n>
  EdgeIntegrals<n>::EdgeIntegrals(const Tables &potential, const WholePotential &whole)
      : potential_(potential), whole_(whole), square_(potential.horizon() * potential.horizon())
  {
  }

  /// Ψ/δ⁴, or what its divergence form has in place of it.
  template <unsigned int n>
  std::array<double, n> EdgeIntegrals<n>::at(const Vector2 &z, bool for_divergence) const
  {
    const double scale = 1 / square_;
    const double rho = std::min(1 - z.norm_square() * scale, Tables::highest_rho);
    const auto radial = for_divergence ? potential_.g(rho) : potential_.f(rho);
    if constexpr (n == 1)
      return radial;
    else
      return {radial[0], radial[1] * scale * .5 * (z[0] * z[0] - z[1] * z[1]),
              radial[1] * scale * z[0] * z[1]};
  }

  /// Add ∫ factor(x) Ψ(z + x along) dx over the part of [from, to] inside the circle.
  template <unsigned int n>
  template <class Factor>
  void EdgeIntegrals<n>::add_in(const Vector2 &z, const Vector2 &along, double from, double to,
                                const Factor &factor, bool for_divergence, Potentials<n> &sum) const
  {
    const SquaredDistance square(z, along);
    if (!(square.discriminant(square_) > 0))
      return;
    const auto [first, last] = square.below(square_, from, to);
    if (!(last > first))
      return;
    const double length = last - first;
    const auto &rule = line_rules().of(square(.5 * (first + last)), std::sqrt(square.a) * length);
    for (std::size_t i = 0; i < rule.size(); ++i)
    {
      const double x = first + length * rule.point(i)[0];
      add_to(sum.in, rule.weight(i) * length * factor(x), at(z + x * along, for_divergence));
    }
  }

  /// Add ∫ (a + b x) Ψ dx of the whole potential over z + x along the direction, or of what its
  /// divergence form has.
  template <unsigned int n>
  void EdgeIntegrals<n>::add_whole(const Vector2 &z, const Vector2 &direction, double from,
                                   double length, double a, double b, bool for_divergence,
                                   Potentials<n> &sum) const
  {
    const double shift = z * direction;
    const PowerPotential::Entries found = whole_.integrate(
        direction, from + shift, length, cross(direction, z), a - b * shift, b, for_divergence);
    for (unsigned int i = 0; i < n; ++i)
      sum.whole[i] += found[i];
  }

  /// Integrals over a side, z from a point to it.
  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::on_segment(const Point<2> &v, const Segment &e,
                                             const Wanted &wanted, bool for_divergence) const
  {
    const Vector2 z = e.start - v;
    Potentials<n> result;
    if (wanted.in)
      add_in(
          z, e.along, 0, 1, [](double) { return 1.; }, for_divergence, result);
    if (wanted.whole)
    {
      const double length = e.along.norm();
      add_whole(z, e.along / length, 0, length, 1 / length, 0, for_divergence, result);
    }
    return result;
  }

  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::from_point(const Point<2> &v, const Segment &e,
                                             const Wanted &wanted) const
  {
    return on_segment(v, e, wanted, true);
  }

  template <unsigned int n>
  Wanted EdgeIntegrals<n>::by_rule(const Segment &e, const Segment &f, const Wanted &wanted) const
  {
    const double product = cross(e.along, f.along);
    const double square =
        product * product / (e.along.norm_square() * f.along.norm_square()); // of the sine
    const double of_whole = whole_.is_none_inside() ? least_product_sine : least_whole_sine;
    return {wanted.in && square < least_sine * least_sine,
            wanted.whole && square < of_whole * of_whole};
  }

  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::between(const Segment &e, const Segment &f,
                                          const Potentials<n> (&from_e)[2],
                                          const Potentials<n> (&from_f)[2]) const
  {
    const Vector2 w = f.start - e.start, &a = f.along, &b = e.along;
    const double factor = 1 / cross(b, a);
    Potentials<n> result;
    result.add(factor * cross(w, a), from_e[0]);
    result.add(-factor * cross(w - b, a), from_e[1]);
    result.add(factor * cross(w, b), from_f[0]);
    result.add(-factor * cross(w + a, b), from_f[1]);
    for (double &in : result.in)
      in *= -square_ * square_; // Ψ = -div(z δ⁴ g), but +div of the whole
    return result;
  }

  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::between_parallel(const Segment &e, const Segment &f,
                                                   const Wanted &wanted) const
  {
    Potentials<n> result = sine(e, f) < no_sine ? on_one_line(e, f, wanted) : slanted(e, f, wanted);
    for (double &in : result.in)
      in *= square_ * square_;
    return result;
  }

  /// z moves on one line: z = c + τ u, τ the sum of two uniform variables, whose density is a
  /// trapezoid. Measured from the middles, so that a small angle counts in second order alone.
  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::on_one_line(const Segment &e, const Segment &f,
                                              const Wanted &wanted) const
  {
    const double length_e = e.along.norm(), length_f = f.along.norm();
    const Vector2 c = f.middle() - e.middle(), u = f.along / length_f;
    const double reach = .5 * (length_e + length_f), flat = .5 * std::abs(length_e - length_f);
    const double height = 1 / std::max(length_e, length_f);
    const std::array<double, 4> knots = {-reach, -flat, flat, reach};
    Potentials<n> result;
    for (unsigned int i = 0; i < 3; ++i)
    {
      if (!(knots[i + 1] > knots[i]))
        continue;
      const double slope = i == 1 ? 0 : (i == 0 ? height : -height) / (reach - flat),
                   start = i == 0 ? 0 : height; // density = start + slope (τ - knot)
      if (wanted.in)
        add_in(
            c, u, knots[i], knots[i + 1],
            [&](double tau) { return start + slope * (tau - knots[i]); }, false, result);
      if (wanted.whole)
        add_whole(c, u, knots[i], knots[i + 1] - knots[i], start - slope * knots[i], slope, false,
                  result);
    }
    return result;
  }

  /// An outer rule in s, cut where the circle about x(s) meets an end of f or touches its line:
  /// there, potentials change by the fourth power of the depth.
  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::slanted(const Segment &e, const Segment &f,
                                          const Wanted &wanted) const
  {
    std::array<double, 8> cuts = {0, 1}; // ascending
    std::size_t n_cuts = 2;
    const auto cut = [&](double s)
    {
      if (!(s > 0 && s < 1))
        return;
      std::size_t place = n_cuts++;
      for (; cuts[place - 1] > s; --place)
        cuts[place] = cuts[place - 1];
      cuts[place] = s;
    };
    for (const Point<2> &end : {f.start, f.end})
    {
      const Vector2 z = e.start - end;
      const double a = e.along.norm_square(), b = z * e.along, c = z.norm_square();
      const double discriminant = b * b - a * (c - square_);
      if (discriminant > 0)
        for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)})
          cut((-b + root) / a);
    }
    const double height = cross(f.along, e.start - f.start), slope = cross(f.along, e.along);
    for (const double at : {-potential_.horizon(), potential_.horizon()})
      cut((at * f.along.norm() - height) / slope);
    Potentials<n> result;
    const double apart =
        std::max(0., e.middle().distance(f.middle()) - .5 * f.along.norm()); // of f from e's middle
    const auto &rule = line_rules().of(apart * apart, e.along.norm());
    for (std::size_t k = 0; k + 1 < n_cuts; ++k)
    {
      const double length = cuts[k + 1] - cuts[k];
      for (std::size_t i = 0; i < rule.size(); ++i)
      {
        const Point<2> x = e.start + (cuts[k] + length * rule.point(i)[0]) * e.along;
        result.add(length * rule.weight(i), on_segment(x, f, wanted, false));
      }
    }
    return result;
  }

  template class EdgeIntegrals<1>;
  template class EdgeIntegrals<3>;
} // namespace plumbline::reference
