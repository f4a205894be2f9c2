#pragma once

#include "physics/outer_potential.h"
#include "physics/radial_potential.h"
#include "physics/regular_potential.h"
#include "reference/mesh/power_potential.h"

#include <optional>
#include <string>

namespace plumbline::reference
{
  /// A potential of a kernel that is smooth at 0, too, Δ²Ψ = C within the horizon and 0 beyond: of
  /// powers in closed form inside, of functions of |ξ|² by a table, of others as powers; outside by
  /// a table. As the pair form of a + b |ξ|² is zero (and of ξ⊗ξ - ½|ξ|² 1 times it), one is taken
  /// off that makes Ψ small where it is asked for: with terms ten times smaller their sum is so
  /// much nearer. Of a constant kernel the whole potential is left out, its integrals being
  /// products: what stays is zero inside.
  class WholePotential
  {
  public:
    /// @param farthest  points from each other [length]
    /// @param longest   line [length]
    /// @pre refuse is empty
    WholePotential(const physics::Kernel<2> &kernel, double farthest, double longest);

    /// Why a kernel's is not known; empty: it is.
    static std::string refuse(const physics::Kernel<2> &kernel);

    /// A kernel without breaks as powers, functions to rounding up to a distance; nothing where
    /// that takes too many or they cancel each other.
    static std::optional<physics::Kernel<2>> as_powers(const physics::Kernel<2> &kernel,
                                                       double farthest);

    /// A kernel whose whole potential is left out.
    static bool is_product(const physics::Kernel<2> &kernel);

    bool is_none_inside() const { return product_.has_value(); }

    /// The constant that was left out.
    double constant() const { return constant_; }

    /// See PowerPotential.
    PowerPotential::Entries integrate(const Vector2 &e, double from, double length, double h,
                                      double a, double b, bool for_divergence) const;

  private:
    using Pair = std::array<double, 2>;

    /// Of 1 - q, in the circle from .2 δ on.
    template <unsigned int n>
    struct Tables
    {
      physics::LocalPolynomials<n> f, g;
    };

    template <unsigned int n>
    Tables<n> make_tables(const physics::Kernel<2> &kernel, const physics::OuterPotential &outside,
                          double farthest);
    bool is_far(double from, double length, double h) const;
    template <unsigned int n, class Table>
    void add_by_rule(const Table &table, const Vector2 &e, double from, double length, double h,
                     double a, double b, PowerPotential::Entries &sum) const;
    PowerPotential::Entries inside(const Vector2 &e, double from, double length, double h, double a,
                                   double b, bool for_divergence) const;
    void add_by_table(const Vector2 &e, double from, double length, double h, double a, double b,
                      bool for_divergence, PowerPotential::Entries &sum) const;

    double horizon_, constant_ = 0;
    std::optional<physics::PotentialTables<1>> product_; ///< what the cut takes from the whole
    std::optional<PowerPotential> powers_;
    std::optional<physics::RegularPotential> regular_;
    Tables<1> scalar_;                  ///< of scalar kernels
    Tables<2> tensor_;                  ///< of bond tensors
    Pair shift_trace_{}, shift_rest_{}; ///< taken off: of 1, q
    unsigned int n_points_ = 0;         ///< of a rule on a line
    bool is_tensor_;
  };
} // namespace plumbline::reference
