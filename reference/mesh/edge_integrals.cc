#include "reference/mesh/edge_integrals.h"

#include "physics/gauss.h"

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

    /// Below it the division by the sine in D costs too many digits.
    constexpr double least_sine = .01;
    /// The same of potentials without a horizon, which grow with the distance of the sides.
    constexpr double least_whole_sine = .2;
    /// Sides that differ by no more than the rounding of their ends.
    constexpr double no_sine = 1e-12;

    /// Rules on a part of a side. The integrand is analytic but at z = 0, so that n points err by
    /// B^(-2n), B = x + √(x² - 1) of Bernstein's ellipse, x the distance from 0 to the part's
    /// middle in halves of its length.
    class Rules
    {
    public:
      Rules()
      {
        for (const unsigned int n_points : {8, 12, 16, 24, 32, 50})
        {
          constexpr double error = 1e-18;
          const double ellipse = std::pow(error, -.5 / n_points),
                       distance = .25 * (ellipse + 1 / ellipse); // in lengths
          rules_.push_back({distance * distance, &physics::gauss(n_points)});
        }
      }

      /// @param square  of the distance [length^2]
      const dealii::Quadrature<1> &of(double square, double length) const
      {
        for (const Rule &rule : rules_)
          if (square > rule.least_square * (length * length))
            return *rule.points;
        return *rules_.back().points;
      }

    private:
      struct Rule
      {
        double least_square;
        const dealii::Quadrature<1> *points;
      };
      std::vector<Rule> rules_;
    };

    const Rules &rules()
    {
      static const Rules all;
      return all;
    }
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

  /// Add ∫ factor(x) Ψ(z + x along) dx over [from, to] in parts: inside the circle, before and
  /// after.
  template <unsigned int n>
  template <class Factor>
  void EdgeIntegrals<n>::split(const Vector2 &z, const Vector2 &along, double from, double to,
                               const Factor &factor, bool for_divergence, Potentials<n> &sum) const
  {
    // |z + x along|² = c + 2 b x + a x²
    const double a = along.norm_square(), b = z * along, c = z.norm_square();
    const auto integrate = [&](double first, double last, std::array<double, n> &part)
    {
      const double middle = .5 * (first + last), length = last - first;
      const auto &rule = rules().of(c + (2 * b + a * middle) * middle, std::sqrt(a) * length);
      for (std::size_t i = 0; i < rule.size(); ++i)
      {
        const double x = first + length * rule.point(i)[0];
        add_to(part, rule.weight(i) * length * factor(x), at(z + x * along, for_divergence));
      }
    };
    const double discriminant = b * b - a * (c - square_);
    const double root = discriminant > 0 ? std::sqrt(discriminant) : 0;
    const double enter = std::clamp((-b - root) / a, from, to),
                 leave = std::clamp((-b + root) / a, from, to);
    if (!(leave > enter))
      return integrate(from, to, sum.out);
    integrate(enter, leave, sum.in);
    if (enter > from)
      integrate(from, enter, sum.out);
    if (to > leave)
      integrate(leave, to, sum.out);
  }

  /// Add ∫ (a + b x) Ψ dx of the whole potential over z + x along the direction, or of what its
  /// divergence form has.
  template <unsigned int n>
  void EdgeIntegrals<n>::add_whole(const Vector2 &z, const Vector2 &direction, double from,
                                   double to, double a, double b, bool for_divergence,
                                   Potentials<n> &sum) const
  {
    const double shift = z * direction;
    const PowerPotential::Entries found = whole_.integrate(
        direction, from + shift, to + shift, cross(direction, z), a - b * shift, b, for_divergence);
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
    if (wanted.circle)
      split(
          z, e.along, 0, 1, [](double) { return 1.; }, for_divergence, result);
    if (wanted.whole && !whole_.is_none())
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
  bool EdgeIntegrals<n>::is_parallel(const Segment &e, const Segment &f)
  {
    const double product = cross(e.along, f.along);
    return product * product <
           least_sine * least_sine * e.along.norm_square() * f.along.norm_square();
  }

  template <unsigned int n>
  Potentials<n>
  EdgeIntegrals<n>::between(const Segment &e, const Segment &f, const Potentials<n> (&from_e)[2],
                            const Potentials<n> (&from_f)[2], const Wanted &wanted) const
  {
    const Vector2 w = f.start - e.start, &a = f.along, &b = e.along;
    const double factor = 1 / cross(b, a);
    Potentials<n> result;
    result.add(factor * cross(w, a), from_e[0]);
    result.add(-factor * cross(w - b, a), from_e[1]);
    result.add(factor * cross(w, b), from_f[0]);
    result.add(-factor * cross(w + a, b), from_f[1]);
    for (unsigned int i = 0; i < n; ++i)
    {
      result.in[i] *= -square_ * square_; // Ψ = -div(z δ⁴ g), but +div of the whole
      result.out[i] *= -square_ * square_;
    }
    const double near = e.along.norm() + f.along.norm(); // where the rule would meet r = 0, too
    if (wanted.whole && sine(e, f) < least_whole_sine && e.middle().distance(f.middle()) > near)
      result.whole = slanted(e, f, {false, true}).whole;
    return result;
  }

  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::between_parallel(const Segment &e, const Segment &f,
                                                   const Wanted &wanted) const
  {
    Potentials<n> result = sine(e, f) < no_sine ? on_one_line(e, f, wanted) : slanted(e, f, wanted);
    for (unsigned int i = 0; i < n; ++i)
    {
      result.in[i] *= square_ * square_;
      result.out[i] *= square_ * square_;
    }
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
      if (wanted.circle)
        split(
            c, u, knots[i], knots[i + 1],
            [&](double tau) { return start + slope * (tau - knots[i]); }, false, result);
      if (wanted.whole && !whole_.is_none())
        add_whole(c, u, knots[i], knots[i + 1], start - slope * knots[i], slope, false, result);
    }
    return result;
  }

  /// An outer rule in s, cut where the circle about x(s) meets an end of f. Circles that touch f
  /// between its ends need no more: depths below it that change with s are less than .005 |e|, and
  /// f is of their fourth power.
  template <unsigned int n>
  Potentials<n> EdgeIntegrals<n>::slanted(const Segment &e, const Segment &f,
                                          const Wanted &wanted) const
  {
    std::vector<double> cuts = {0, 1};
    for (const Point<2> &end : {f.start, f.end})
    {
      const Vector2 z = e.start - end;
      const double a = e.along.norm_square(), b = z * e.along, c = z.norm_square();
      const double discriminant = b * b - a * (c - square_);
      if (discriminant > 0 && wanted.circle)
        for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)})
          if (const double s = (-b + root) / a; s > 0 && s < 1)
            cuts.push_back(s);
    }
    std::sort(cuts.begin(), cuts.end());
    Potentials<n> result;
    const double apart =
        std::max(0., e.middle().distance(f.middle()) - .5 * f.along.norm()); // of f from e's middle
    const auto &rule = rules().of(apart * apart, e.along.norm());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
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
