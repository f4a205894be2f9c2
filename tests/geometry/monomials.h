// Integrals of monomials over ball ∩ polygon: by a rule, and by Green's theorem.
#pragma once

#include "placements.h"

#include <deal.II/base/quadrature_lib.h>

#include <complex>

namespace plumbline::geometry
{
  using Integrals = std::vector<Real>; ///< of all monomials up to a degree, as in weighted_moments
  using Complex = std::complex<Real>;  ///< x + i y

  /// Calls f(i, x^a y^b) for all of them.
  template <class F>
  void for_monomials(unsigned int degree, const Complex &z, F f)
  {
    std::vector<Real> x(degree + 1, 1), y(degree + 1, 1); // powers
    for (unsigned int k = 0; k < degree; ++k)
    {
      x[k + 1] = x[k] * z.real();
      y[k + 1] = y[k] * z.imag();
    }
    for (unsigned int total = 0, i = 0; total <= degree; ++total)
      for (unsigned int b = 0; b <= total; ++b, ++i)
        f(i, x[total - b] * y[b]);
  }

  inline std::size_t n_monomials(unsigned int degree)
  {
    return (degree + 1) * (degree + 2) / 2;
  }

  /// Coordinates in which the region is of size 1.
  struct Frame
  {
    Point<2> origin;
    Real unit;

    Complex operator()(const Point<2> &p) const
    {
      return Complex(p[0] - Real(origin[0]), p[1] - Real(origin[1])) / unit;
    }
  };

  /// About the cell's first vertex or the ball's centre, whichever is smaller.
  inline Frame frame(const Case &c)
  {
    if (diameter(c.cell) < 2 * c.ball.radius)
      return {c.cell[0], diameter(c.cell)};
    return {c.ball.centre, c.ball.radius};
  }

  /// Moved to where the coordinates of points in the region lose no digits.
  inline Case moved(Case c)
  {
    const Point<2> origin = frame(c).origin;
    c.ball.centre = Point<2>(c.ball.centre - origin);
    for (auto &v : c.cell)
      v = Point<2>(v - origin);
    return c;
  }

  inline Integrals integrate(const CutRule &rule, const Frame &frame, unsigned int degree)
  {
    Integrals sum(n_monomials(degree), 0);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      for_monomials(degree, frame(rule.points[q]),
                    [&](unsigned int i, Real value) { sum[i] += rule.weights[q] * value; });
    return sum;
  }

  /// The largest absolute values at the points of a rule.
  inline Integrals largest_values(const CutRule &rule, const Frame &frame, unsigned int degree)
  {
    Integrals largest(n_monomials(degree), 0);
    for (const auto &point : rule.points)
      for_monomials(degree, frame(point),
                    [&](unsigned int i, Real value)
                    { largest[i] = std::max(largest[i], std::abs(value)); });
    return largest;
  }

  /// The oracle: Green's theorem on the boundary's pieces, ∫ x^a y^b = ∮ (x dy - y dx) x^a y^b /
  /// (a + b + 2).
  inline Integrals around(const Case &c, const Frame &frame, unsigned int degree)
  {
    static const dealii::QGauss<1> gauss(40);
    Integrals sum(n_monomials(degree), 0);
    const auto add = [&](const Complex &z, const Complex &dz)
    {
      for_monomials(degree, z,
                    [&](unsigned int i, Real value)
                    { sum[i] += std::imag(std::conj(z) * dz) * value; });
    };
    const Real R = c.ball.radius / frame.unit;
    const auto add_arc = [&](const Complex &from, const Complex &to) // at most a half circle
    {
      const Complex chord = to - from, along = chord / std::abs(chord),
                    out(along.imag(), -along.real());
      const Real half = std::asin(std::abs(chord) / (2 * R));
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Real t = 2 * gauss.point(q)[0] - 1, w = 2 * gauss.weight(q);
        const Real height = 2 * R * std::sin(.5L * half * (1 + t)) * std::sin(.5L * half * (1 - t));
        add(from + .5L * chord + R * std::sin(t * half) * along + height * out,
            w * half * along * std::polar(R, t * half));
      }
    };
    for (const Piece &piece : boundary(c.ball, view(c.cell)))
    {
      const Complex from = frame(piece.from), to = frame(piece.to);
      if (!piece.is_arc)
        for (unsigned int q = 0; q < gauss.size(); ++q)
          add(from + Real(gauss.point(q)[0]) * (to - from), Real(gauss.weight(q)) * (to - from));
      else if (piece.angle < 1.5 && from != to)
        add_arc(from, to);
      else
        for (int part = 0; part < 8; ++part)
        {
          const Complex centre = frame(c.ball.centre);
          const auto at = [&](int i)
          { return centre + std::polar(R, std::arg(from - centre) + i * Real(piece.angle) / 8); };
          add_arc(at(part), at(part + 1));
        }
    }
    for (unsigned int total = 0, i = 0; total <= degree; ++total)
      for (unsigned int b = 0; b <= total; ++b)
        sum[i++] *= frame.unit * frame.unit / (total + 2);
    return sum;
  }
} // namespace plumbline::geometry
