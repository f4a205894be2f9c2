#pragma once

#include "physics/potential_jet.h"
#include "reference/mesh/edge_integrals.h"

#include <deal.II/base/quadrature.h>

#include <array>

namespace plumbline::reference
{
  /// Integrals over a pair of sides, x at s on the one and y at t on the other, of s^i t^j times
  /// potentials Ψ_2+k(y - x) and what Green's identities need of them: normal derivatives along
  /// (along_y, -along_x), lengths of the sides in them. For shape functions of degree p, i + j goes
  /// up to 2 p - 2 k with both derivatives, one less with one, two less with none.
  struct EdgeMoments
  {
    static constexpr unsigned int n_orders = 3, n = 5; ///< p = 2

    using Table = std::array<std::array<double, n>, n>;
    std::array<Table, n_orders> both{}; ///< ∬ s^i t^j ∂_nx ∂_ny Ψ_2+k
    std::array<Table, 2> of_x{};        ///< ∬ s^i t^j ∂_nx Ψ_2+k
    std::array<Table, 2> of_y{};        ///< ∬ s^i t^j ∂_ny Ψ_2+k
    Table value{};                      ///< ∬ s^i t^j Ψ₂
  };

  /// Such integrals by rules in s and t that see analytic functions alone: cut where the circle
  /// crosses the ends and the sides, and stretched where it touches one.
  /// @tparam n  entries, each with its own moments: 1 of scalar kernels; 3 of bond tensors: half
  /// the
  ///            trace, then ½(C_xx - C_yy) and C_xy
  template <unsigned int n>
  class EdgePairs
  {
  public:
    /// @param near        the kernel as powers where sides are near, for the whole
    /// @param degree      of shape functions, 0 to 2
    /// @param longest     side [length]: the number of points follows from it
    /// @param lowest_rho  1 - (the largest distance of points / δ)²
    EdgePairs(const physics::Kernel<2> &kernel, const physics::Kernel<2> &near, unsigned int degree,
              double longest, double lowest_rho);

    /// Add those of the potential that vanishes at the circle, inside and outside of it.
    /// @param in, out  shape (n), or none
    void at_circle(const Segment &e, const Segment &f, EdgeMoments *in, EdgeMoments *out) const;

    /// Add those of the potential without a horizon.
    /// @param sum  shape (n)
    void whole(const Segment &e, const Segment &f, EdgeMoments *sum) const;

  private:
    using Range = std::array<double, 2>; ///< of s or t

    template <unsigned int degree>
    void at_circle_as(const Segment &e, const Segment &f, EdgeMoments *in, EdgeMoments *out) const;
    template <unsigned int degree>
    void add_smooth(const Segment &e, const Segment &f, EdgeMoments *sum) const;
    template <unsigned int degree>
    void add_line(const Segment &e, const Segment &f, double s, double weight, EdgeMoments *in,
                  EdgeMoments *out) const;
    template <unsigned int degree>
    void add_apart(const Segment &e, const Segment &f, const Range &of_s, const Range &of_t,
                   EdgeMoments *sum) const;
    template <unsigned int degree>
    void add_corner(const Segment &e, const Segment &f, EdgeMoments *sum) const;
    template <unsigned int degree>
    void add_whole(const Segment &e, const Segment &f, EdgeMoments *sum) const;

    static constexpr unsigned int n_parts = n == 1 ? 1 : 2;

    unsigned int degree_;
    physics::CircleJets<n_parts> circle_;
    physics::PowerJets<n_parts> powers_;
    const dealii::Quadrature<1> &inner_; ///< along f
    const dealii::Quadrature<1> &outer_; ///< along e
  };

  double distance(const Segment &e, const Segment &f); ///< of sides that do not cross
  geometry::PairPosition position(const Segment &e, const Segment &f, double horizon);
} // namespace plumbline::reference
