#pragma once

#include "meshfree/rules/bonds.h"

namespace plumbline::meshfree
{
  /// What is usual among some values, whatever a few of them are.
  struct Spread
  {
    double median = 0;
    double deviation = 0; ///< 1.4826 times the median of |value - median|: σ of a normal sample
    double tail = 0;      ///< of |value - median|: exceeded by 1 in 13 values, by one at least

    /// How far from the median a value may be: 10 deviations, and 6 times the tail, so that
    /// samples that are far from normal raise no alarm; at least the floor, for round-off.
    double allowed(double floor) const;
  };

  Spread spread_of(const std::vector<double> &values);

  /// What is usual among bonds that are alike: of one length and direction, up to symmetry, where
  /// bonds repeat, as on lattices; else of lengths that differ by less than half a node's size,
  /// which is how far a cut or a ramp that depends on the cell may begin earlier or later.
  class BondProfile
  {
  public:
    /// @param xi    of the bonds [length]; those that differ by 1e-8 size, or by the rounding of
    ///              four coordinates, are one
    /// @param size  of the nodes [length]
    /// @param rounding  of their coordinates [length]
    template <int dim>
    BondProfile(const std::vector<Point<dim>> &xi, double size, double rounding = 0)
        : BondProfile(shapes(xi), size, rounding)
    {
    }

    bool is_lattice() const { return is_lattice_; }

    struct Usual
    {
      double low = 0, high = 0; ///< lowest and highest median of such bonds: a step or a ramp
                                ///< between them is no defect
      double allowed = 0;       ///< beyond both
    };

    /// Of each bond, given one value for each.
    std::vector<Usual> usual(const std::vector<double> &values, double floor) const;

  private:
    /// The invariants of a bond under symmetry.
    struct Shape
    {
      double length = 0; ///< [length]
      double side =
          0; ///< invariant under rotations by 90° and reflections, for bonds of one length
    };

    template <int dim>
    static std::vector<Shape> shapes(const std::vector<Point<dim>> &xi);

    BondProfile(const std::vector<Shape> &bonds, double size, double rounding);
    void find_classes(const std::vector<Shape> &bonds, double same);
    void find_bins(const std::vector<Shape> &bonds, double size);

    std::vector<std::size_t> order_; ///< by length; of lattices by class
    std::vector<std::size_t> start_; ///< of the classes, or bins of length, in it
    /// Bins [first, last) that each bin is compared with.
    std::vector<std::pair<std::size_t, std::size_t>> like_;
    bool is_lattice_ = false;
  };
} // namespace plumbline::meshfree
