#pragma once

#include "physics/potential_jet.h"
#include "reference/mesh/edge_integrals.h"

#include <array>

namespace plumbline::reference
{
  /// Integrals over a pair of sides, x at s on the one and y at t on the other, of a potential
  /// Ψ(y - x) and what Green's identities need of it: normal derivatives along (along_y, -along_x),
  /// lengths of the sides in them.
  struct EdgeMoments
  {
    std::array<double, 6> both{}; ///< ∬ m ∂_nx ∂_ny Ψ, m = 1, s, t, st, s², t²
    std::array<double, 3> of_x{}; ///< ∬ m ∂_nx Ψ, m = 1, s, t
    std::array<double, 3> of_y{}; ///< ∬ m ∂_ny Ψ
    double value = 0;             ///< ∬ Ψ
    double next = 0;              ///< ∬ ∂_nx ∂_ny Ψ₃, ΔΨ₃ = Ψ
  };

  /// Such integrals by rules in s and t that see analytic functions alone: cut where the circle
  /// crosses the ends and the sides, and stretched where it touches one.
  class EdgePairs
  {
  public:
    /// @param longest     side [length]: the number of points follows from it
    /// @param lowest_rho  1 - (the largest distance of points / δ)²
    EdgePairs(const physics::Kernel<2> &kernel, double longest, double lowest_rho);

    /// The potential that vanishes at the circle, inside and outside of it.
    void at_circle(const Segment &e, const Segment &f, EdgeMoments *in, EdgeMoments *out) const;

    /// The potential without a horizon.
    EdgeMoments whole(const Segment &e, const Segment &f) const;

  private:
    void add_smooth(const Segment &e, const Segment &f, EdgeMoments &sum) const;
    void add_line(const Segment &e, const Segment &f, double s, double weight, EdgeMoments *in,
                  EdgeMoments *out) const;
    using Range = std::array<double, 2>; ///< of s or t
    void add_apart(const Segment &e, const Segment &f, const Range &of_s, const Range &of_t,
                   EdgeMoments &sum) const;
    EdgeMoments from_corner(const Segment &e, const Segment &f) const;

    physics::CircleJets circle_;
    physics::PowerJets powers_;
    const dealii::Quadrature<1> &inner_; ///< along f
    const dealii::Quadrature<1> &outer_; ///< along e
  };

  double distance(const Segment &e, const Segment &f); ///< of sides that do not cross
} // namespace plumbline::reference
