#pragma once

#include "meshfree/lattice/crack_column.h"
#include "meshfree/lattice/double_well_force.h"
#include "method/dynamic_fracture_solver.h"

#include <array>
#include <vector>

namespace plumbline::meshfree
{
  /// A strip of bonds with two wells with a notch in its left edge, pulled apart by grips along its
  /// upper and lower edge (see CrackColumn); both ends are free. Node (i, j) is at x(i), y(j), the
  /// origin in the middle of the strip, and vectors have shape (2, n_y, n_x).
  /// The notch is cut: the straight lines of its bonds cross it, and they carry no force for good.
  /// All other bonds soften and heal by their wells alone, as those of the paper do, so that a
  /// crack closes again where it is unloaded.
  /// Fields that are symmetric about y = 0 stay so to the last bit, on any number of threads.
  class CrackStrip : public method::NotchedStrip
  {
  public:
    using Shape = method::NotchedStripShape;
    using View = method::CrackView;

    /// @param potential  φ of the bonds
    /// @throws InputError  as CrackColumn; a notch of no column, or of all
    CrackStrip(const std::vector<WellBond> &bonds, const Shape &shape,
               const physics::WellPotential &potential = {});

    const CrackColumn &column() const { return column_; }
    const std::array<int, 2> &n() const override { return n_; }
    std::size_t size() const override { return 2 * n_nodes(); }
    std::size_t n_nodes() const { return static_cast<std::size_t>(n_[0]) * n_[1]; }
    std::uint64_t n_bonds() const override { return force_.n_bonds(); }
    double h() const override { return h_; }
    double x(int i) const override { return .5 * h_ * (2 * i + 1 - n_[0]); }
    double y(int j) const override { return column_.y(j); }
    double notch_tip() const override { return .5 * h_ * (2 * n_notch_ - n_[0]); }

    /// F(u) of the free nodes, 0 at those of the grips.
    void force(const std::vector<double> &u, std::vector<double> &f) const override;

    /// F'(u) v, symmetric; v counts as 0 at the grips' nodes, and so does the result.
    void tangent(const std::vector<double> &u, const std::vector<double> &v,
                 std::vector<double> &f) const override;

    double strain(double energy) const override { return column_.strain(energy); }

    /// Displacements at rest under a strain of the grips, as small strains have them, with the
    /// notch open or as if there were none; by conjugate gradients to 1e-10 of the first residual.
    /// Bonds that they stretch too far soften once the strip is let go.
    /// @throws NumericalError  conjugate gradients do not settle
    std::vector<double> at_rest(double strain, bool is_open) const override;

    /// PD(u) less the bonds of the notch.
    double energy(const std::vector<double> &u) const override;

    /// A bond is soft where q² > r̄², for the exponential 1/2. The tip is where the first column
    /// right of the notch begins whose shortest bonds along y are not soft, between columns by
    /// linear interpolation of q²; branches are a grip apart.
    View view(const std::vector<double> &u) const override;

    /// The largest difference of u from its mirror image about y = 0.
    double asymmetry(const std::vector<double> &u) const override;

  private:
    /// A bond of the notch from a node above the plane, and with it that of the mirror image.
    struct Cut
    {
      std::size_t from = 0, to = 0;
      std::array<double, 2> way{};
      double strength = 0;
    };
    template <typename Visit>
    void visit_cuts(const Visit &visit) const;
    void hold(std::vector<double> &f) const;
    /// Subtract the notch's bonds from F'(u) v.
    void cut_tangent(const std::vector<double> &u, const std::vector<double> &v,
                     std::vector<double> &f) const;
    std::size_t mirror(std::size_t node) const;
    /// Sums over the bonds of each node.
    struct Softened
    {
      std::vector<double> all, strength, energy; ///< strengths of all bonds, of soft ones
    };
    void add_softened(const std::vector<double> &u, int row, Softened &sums) const;
    void find_tip(const std::vector<double> &u, View &view) const;

    std::vector<WellBond> bonds_;
    physics::WellPotential potential_;
    CrackColumn column_;
    double h_;
    std::array<int, 2> n_;
    int n_notch_;
    DoubleWellForce<2> force_;
    std::vector<Cut> cuts_;
  };
} // namespace plumbline::meshfree
