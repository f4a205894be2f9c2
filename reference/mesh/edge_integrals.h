#pragma once

#include "physics/radial_potential.h"

namespace plumbline::reference
{
  using dealii::Point;
  using Vector2 = dealii::Tensor<1, 2>;

  /// A side of cells: start + σ along, 0 <= σ <= 1.
  struct Segment
  {
    Point<2> start;
    Vector2 along;

    Point<2> end() const { return start + along; }
    Point<2> middle() const { return start + .5 * along; }
  };

  /// The same integral with three potentials.
  struct Potentials
  {
    double in = 0, ///< Ψ cut off at the circle: the pairs of points nearer than the horizon
        out = 0,   ///< what it would be outside
        whole = 0; ///< of the kernel without a horizon; 0 for the constant kernel

    void add(double factor, const Potentials &other)
    {
      in += factor * other.in;
      out += factor * other.out;
      whole += factor * other.whole;
    }
  };

  /// The potential of a sum of powers without a horizon: Δ²Ψ = C for all ξ ≠ 0,
  /// c |ξ|^k → c |ξ|^(k+4) / ((k+2)² (k+4)²), whose integrals over lines are elementary.
  class PowerPotential
  {
  public:
    /// @param kernel  scalar, of powers; the constant one has none (its integrals are products)
    explicit PowerPotential(const physics::Kernel<2> &kernel);

    bool is_none() const { return odd_.empty() && even_.empty(); }

    /// ∫ (a + b x) Ψ(√(x² + h²)) dx over [from, to], for divergence: each power p over p + 2.
    double integrate(double from, double to, double h, double a, double b,
                     bool for_divergence) const;

  private:
    /// Coefficients of r, r^3, ... and of 1, r^2, ...
    std::vector<double> odd_, even_;
  };

  /// Integrals of a kernel's radial potentials over pairs of sides,
  ///   D(e, e') = ∫_0^1 ∫_0^1 Ψ(y(t) - x(s)) ds dt, x on e and y on e'.
  /// Ψ = -div(z δ⁴ g) makes them integrals Q(v, e) = ∫_0^1 g(x(s) - v) ds of ends of the one and
  /// all of the other: they are cut where the circle crosses the side, and between analytic, so
  /// that circles that touch a side are no special case. Accuracy: 1e-14 of the largest Ψ on the
  /// two sides; inside, where points come nearer than .2 δ, the value has no meaning.
  class EdgeIntegrals
  {
  public:
    /// @param longest  side [length]: the number of points follows from it
    EdgeIntegrals(const physics::RadialPotential &potential, const PowerPotential &whole,
                  double longest);

    /// Q. @param at_circle  wanted: in and out
    Potentials from_point(const Point<2> &v, const Segment &e, bool at_circle) const;

    /// D by the integrals from both ends of each to the other.
    /// @param from_e  Q(start of e, f) and Q(end of e, f)
    /// @param from_f  Q(start of f, e) and Q(end of f, e)
    Potentials between(const Segment &e, const Segment &f, const Potentials (&from_e)[2],
                       const Potentials (&from_f)[2]) const;

    /// Sides that are as good as parallel: there, other integrals are taken.
    static bool is_parallel(const Segment &e, const Segment &f);
    Potentials between_parallel(const Segment &e, const Segment &f, bool at_circle) const; ///< D

  private:
    template <class Integrand>
    void split(double from, double to, double first_root, double second_root,
               const Integrand &integrand, Potentials &sum) const;
    Potentials on_one_line(const Segment &e, const Segment &f, bool at_circle) const;
    Potentials slanted(const Segment &e, const Segment &f, bool at_circle) const;
    template <class Integrand>
    Potentials on_segment(const Point<2> &v, const Segment &e, bool at_circle, bool for_divergence,
                          const Integrand &integrand) const;

    const physics::RadialPotential &potential_;
    const PowerPotential &whole_;
    double square_; ///< δ²
    const std::vector<Point<1>> &points_;
    const std::vector<double> &weights_;
  };
} // namespace plumbline::reference
