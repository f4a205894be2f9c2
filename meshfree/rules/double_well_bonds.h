#pragma once

#include "meshfree/rules/bonds.h"
#include "physics/double_well.h"

#include <string>

namespace plumbline::meshfree
{
  /// A bond of every node of a lattice, ready for forces of two wells: with q = way·(u_j - u_i),
  ///   F_i = Σ ω_i ω_j strength q φ'(q²) way,  PD = h^dim Σ_i Σ_j ω_i ω_j strength/4 φ(q²),
  /// φ the shape of the potential, law.shape().
  struct WellBond
  {
    std::array<int, 2> k{};      ///< lattice steps to the neighbour
    std::array<double, 2> way{}; ///< √(β/r) e, so that q² = β r S² [1/length]
    double strength = 0;         ///< 4 c w J / (ε^(dim+1) ω_dim), w the weight
  };

  /// Of one weight, the kernel point being where J, r and e are taken. k is left 0.
  WellBond well_bond(const physics::DoubleWell &law, double weight, const Point<2> &kernel_point);

  /// A rule's bonds, sorted. What the rule takes at the kernel point is the kernel of small strains
  /// as a whole, J, r and e: at the node for most rules, at the centroid for IPA-AC.
  /// @pre law.dim() == 2
  std::vector<WellBond> well_bonds(const physics::DoubleWell &law, const Bonds<2> &bonds);

  /// The bonds of a lattice with one axis, y = 0. The cell of the neighbour k reaches from (k-½)h
  /// to (k+½)h, and w is the length of its part in the horizon (FA: h if |k|h <= ε). J is taken at
  /// the node, for IPA-AC at that part's centre; r and e are the node's. IPA-AC-R2 takes J at the
  /// node, as for tensors in 2D, and scales these weights w to w (1 - λ J r), so that Σ w J r is
  /// exact and the speed of long waves with it.
  /// @param rule  FA, PA-AC, IPA-AC or IPA-AC-R2
  /// @throws InputError  another rule, h <= 0, or a horizon that holds no neighbour
  /// @pre law.dim() == 1
  std::vector<WellBond> axis_bonds(const physics::DoubleWell &law, double h,
                                   const std::string &rule);

  /// Whether there are axis_bonds of a rule.
  bool is_axis_rule(const std::string &name);

  /// What it costs a lattice of size h to open a straight crack along its axis, all bonds across it
  /// at f's limit c. Tends to law.toughness() as h → 0.
  double lattice_toughness(const std::vector<WellBond> &bonds, int dim, double h);
} // namespace plumbline::meshfree
