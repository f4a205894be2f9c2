#pragma once

#include "geometry/ball_cell.h"
#include "physics/double_well.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// A strip between grips with a notch in its left edge, on a lattice.
  struct NotchedStripShape
  {
    std::array<int, 2> n{}; ///< nodes along x, and rows between the grips
    int n_notch = 0;        ///< columns left of the notch's tip
    double h = 0;           ///< of the lattice [length]
  };

  /// What is seen of a crack in a state. A bond is soft where its force falls with its strain.
  struct CrackView
  {
    double tip = 0;         ///< its x [length]
    double soft_energy = 0; ///< of soft bonds
    int n_branches = 0;     ///< most cracks side by side in a column before the tip
    std::vector<double>
        damage; ///< fraction of a node's bonds that is soft or cut, shape (n_y, n_x)
  };

  /// A strip of bonds with two wells that grips pull apart; both ends are free. The origin is its
  /// middle, and vectors have shape (2, n_y, n_x).
  class NotchedStrip
  {
  public:
    virtual ~NotchedStrip() = default;

    virtual const std::array<int, 2> &n() const = 0; ///< all nodes, those of the grips too
    virtual std::size_t size() const = 0;
    virtual std::uint64_t n_bonds() const = 0;
    virtual double h() const = 0;         ///< [length]
    virtual double x(int i) const = 0;    ///< of node (i, j) [length]
    virtual double y(int j) const = 0;    ///< [length]
    virtual double notch_tip() const = 0; ///< its x [length]

    /// F(u) of the free nodes, 0 at those of the grips.
    virtual void force(const std::vector<double> &u, std::vector<double> &f) const = 0;
    /// F'(u) v, symmetric; v counts as 0 at the grips' nodes, and so does the result.
    virtual void tangent(const std::vector<double> &u, const std::vector<double> &v,
                         std::vector<double> &f) const = 0;

    /// The strain of the grips at which the uniform energy W H is this.
    /// @throws InputError  it softens bonds before there is a crack
    virtual double strain(double energy) const = 0;
    /// Displacements at rest under a strain of the grips, as small strains have them, with the
    /// notch open or as if there were none.
    /// @throws NumericalError  iterations do not settle
    virtual std::vector<double> at_rest(double strain, bool is_open) const = 0;
    virtual double energy(const std::vector<double> &u) const = 0;
    virtual CrackView view(const std::vector<double> &u) const = 0;
    /// The largest difference of u from its mirror image about y = 0.
    virtual double asymmetry(const std::vector<double> &u) const = 0;
  };

  /// The load at which a long crack in a strip neither grows nor closes.
  struct StripThreshold
  {
    double toughness = 0; ///< of the lattice, G_c,h [force/length]
    double energy = 0;    ///< W H; NaN where there is none [force/length]
    std::string failure;  ///< why not
  };

  /// What makes such strips.
  class DynamicFractureSolver
  {
  public:
    virtual ~DynamicFractureSolver() = default;

    /// @param n_rows  between the grips
    virtual StripThreshold strip_threshold(const physics::DoubleWell &law, double h, int n_rows,
                                           geometry::Backend backend) const = 0;

    /// @throws InputError  rows too few or odd; a notch of no column, or of all
    virtual std::unique_ptr<NotchedStrip> notched_strip(const physics::DoubleWell &law,
                                                        const NotchedStripShape &shape,
                                                        geometry::Backend backend) const = 0;
  };
} // namespace plumbline::method
