#pragma once

#include "physics/kernel.h"
#include "reference/shapes.h"

#include <Eigen/Core>

namespace plumbline::reference
{
  /// Bonds between two cells of a lattice, as a quadratic form of what shape functions have there,
  /// with or without a crack between them. The bond z is the outer variable: for fixed z, points x
  /// of bonds (x, x + z) fill a rectangle, those of bonds that cross a straight crack the part of
  /// it on one side of a line, where products of shape functions are integrated exactly. For a
  /// fixed direction of z what is left is a polynomial of its length on intervals that are known,
  /// times the kernel, and over directions analytic between those in which lines and corners meet.
  /// Accuracy: 2e-14 of the largest entry of the lattice, a test; of what a crack cuts, 1e-14 of
  /// that of pairs of constants.
  class BondPairs
  {
  public:
    /// Energy = ½ uᵀ M u, u of the first cell's functions, both components of each, then of the
    /// second's. [unit of the kernel times length^4]
    using Form = Eigen::MatrixXd;

    /// @param kernel  a bond tensor without breaks
    BondPairs(const physics::Kernel<2> &kernel, double h, const AxisShapes &shapes);

    unsigned int n_functions() const { return n_; } ///< of a cell: first along x
    int reach() const;                              ///< cells farther apart have no bonds

    /// All bonds from a cell to the one (i, j) away; of a cell with itself each once.
    Form whole(int i, int j) const;

    /// Those that cross a crack along x, from far left to its tip: its line `depth` >= 1 cells
    /// above the lower side of the first cell, its tip to the right of that cell's left side
    /// [cells].
    /// @pre j >= depth
    Form broken(int i, int j, int depth, double tip) const;

  private:
    struct Crack
    {
      double y = 0, tip = 0;
    };
    Form integrate(int i, int j, const Crack *crack) const;
    std::vector<double> directions(int i, int j, const Crack *crack) const;
    std::vector<double> lengths(int i, int j, double cosine, double sine, const Crack *crack) const;
    Form products(int i, int j, double z1, double z2, const Crack *crack) const;

    physics::Kernel<2> kernel_;
    double h_, m_; ///< m: the horizon in cells
    AxisShapes shapes_;
    unsigned int n_axis_, n_;
  };
} // namespace plumbline::reference
