#pragma once

#include "meshfree/rules/double_well_bonds.h"

#include <vector>

namespace plumbline::meshfree
{
  /// One column of a strip far from any crack tip: rows of a lattice that is pulled apart along y
  /// by grips which hold u_y = g y in all nodes within a horizon beyond the free height. All
  /// columns are alike and u_x = 0, so rows interact with the sums of their bonds. A crack through
  /// the strip releases, per length, what the intact column holds more than two halves, and grows
  /// from rest where that is more than the lattice's toughness.
  class CrackColumn
  {
  public:
    /// @param bonds   of every node, with all their mirror images
    /// @param n_free  rows between the grips; the crack plane lies between the middle two
    /// @param shape   φ of the bonds
    /// @throws InputError  h <= 0, n_free odd or too few to hold the bonds of either half apart
    CrackColumn(const std::vector<WellBond> &bonds, double h, int n_free,
                physics::WellPotential shape = {});

    int n_grip() const { return n_grip_; } ///< rows of each grip: the longest bond's
    int n_rows() const { return n_free_ + 2 * n_grip_; }
    double height() const { return n_free_ * h_; } ///< free height H
    double y(int row) const { return .5 * h_ * (2 * row + 1 - n_rows()); }
    bool is_constrained(int row) const { return row < n_grip_ || row >= n_free_ + n_grip_; }

    /// Energy of the uniform strain u_y = g y, W [energy/length^2].
    double density(double strain) const;

    /// The strain g >= 0 with W(g) H = energy, by bisection to rounding.
    /// @throws InputError  one that softens bonds before there is a crack: q² > r̄² for one of them
    double strain(double energy) const;

    /// A column in equilibrium.
    struct Rest
    {
      std::vector<double> u; ///< u_y of the rows, from below
      double energy = 0;     ///< per length of the strip
    };
    /// @param is_separated  no bonds across the crack plane
    /// @throws NumericalError  Newton's method does not settle: the strain is beyond stability
    Rest relax(double strain, bool is_separated) const;

    /// The energy W H of the strain at which a long crack neither grows nor closes: the intact
    /// column holds toughness() more than two halves. To 1e-12 of the strain.
    /// @throws NumericalError  bonds soften all over the strip before that: the strip is too low
    double threshold() const;

    double toughness() const { return toughness_; } ///< of the lattice, G_c,h

  private:
    /// Bonds to the row k above, those of equal k and way are one.
    struct Row
    {
      int k = 0;
      double way = 0, strength = 0;
    };
    double most_strain() const;

    physics::WellPotential shape_;
    double h_;
    int n_free_, n_grip_ = 0;
    double toughness_;
    std::vector<Row> rows_; ///< k > 0
  };
} // namespace plumbline::meshfree
