#pragma once

#include "physics/radial_potential.h"
#include "reference/mesh/whole_potential.h"

#include <type_traits>

namespace plumbline::reference
{
  /// Which of them are asked for.
  struct Wanted
  {
    bool in = false, whole = false;

    bool is_none() const { return !in && !whole; }
    Wanted without(const Wanted &other) const { return {in && !other.in, whole && !other.whole}; }
    void add(const Wanted &other)
    {
      in = in || other.in;
      whole = whole || other.whole;
    }
  };

  /// The same integral with two potentials.
  /// @tparam n  entries: 1 of scalar kernels; 3 of bond tensors: half the trace, then
  ///            ½(C_xx - C_yy) and C_xy
  template <unsigned int n>
  struct Potentials
  {
    std::array<double, n> in{}, ///< zero beyond the circle, singular at 0
        whole{};                ///< smooth at 0, see WholePotential

    void add(double factor, const Potentials &other)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        in[i] += factor * other.in[i];
        whole[i] += factor * other.whole[i];
      }
    }

    void take(const Wanted &some, const Potentials &other)
    {
      if (some.in)
        in = other.in;
      if (some.whole)
        whole = other.whole;
    }
  };

  /// Integrals of a kernel's radial potentials over pairs of sides,
  ///   D(e, e') = ∫_0^1 ∫_0^1 Ψ(y(t) - x(s)) ds dt, x on e and y on e'.
  /// Ψ = -div(z δ⁴ g) makes them integrals Q(v, e) = ∫_0^1 g(x(s) - v) ds of ends of the one and
  /// all of the other: they are cut where the circle crosses the side, and between analytic, so
  /// that circles that touch a side are no special case. Accuracy: 1e-14 of the largest Ψ on the
  /// two sides; inside, where points come nearer than .2 δ, the value has no meaning.
  template <unsigned int n>
  class EdgeIntegrals
  {
  public:
    using Tables =
        std::conditional_t<n == 1, physics::PotentialTables<1>, physics::PotentialTables<2>>;

    EdgeIntegrals(const Tables &potential, const WholePotential &whole);

    /// Q.
    Potentials<n> from_point(const Point<2> &v, const Segment &e, const Wanted &wanted) const;

    /// D by the integrals from both ends of each to the other.
    /// @param from_e  Q(start of e, f) and Q(end of e, f)
    /// @param from_f  Q(start of f, e) and Q(end of f, e)
    Potentials<n> between(const Segment &e, const Segment &f, const Potentials<n> (&from_e)[2],
                          const Potentials<n> (&from_f)[2]) const;

    /// What of it is to be had by between_parallel, as the sides are nearly so.
    Wanted by_rule(const Segment &e, const Segment &f, const Wanted &wanted) const;
    Potentials<n> between_parallel(const Segment &e, const Segment &f,
                                   const Wanted &wanted) const; ///< D

  private:
    std::array<double, n> at(const Vector2 &z, bool for_divergence) const;
    template <class Factor>
    void add_in(const Vector2 &z, const Vector2 &along, double from, double to,
                const Factor &factor, bool for_divergence, Potentials<n> &sum) const;
    void add_whole(const Vector2 &z, const Vector2 &direction, double from, double length, double a,
                   double b, bool for_divergence, Potentials<n> &sum) const;
    Potentials<n> on_one_line(const Segment &e, const Segment &f, const Wanted &wanted) const;
    Potentials<n> slanted(const Segment &e, const Segment &f, const Wanted &wanted) const;
    Potentials<n> on_segment(const Point<2> &v, const Segment &e, const Wanted &wanted,
                             bool for_divergence) const;

    const Tables &potential_;
    const WholePotential &whole_;
    double square_; ///< δ²
  };
} // namespace plumbline::reference
