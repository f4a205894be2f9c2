#pragma once

#include "meshfree/check/bond_file.h"
#include "meshfree/check/bond_rule.h"

#include <string>

namespace plumbline::meshfree
{
  /// Something done to all weights or kernel points that explains the moments.
  struct Cause
  {
    std::string name; ///< in a word or two
    std::string text; ///< a sentence
    /// Median defect of the moments of degree 1 and 2 of a node, with this cause and with it
    /// undone, all other causes being undone in both; and the largest.
    double before = 0, after = 0;
    double worst_before = 0, worst_after = 0;
    double factor = 1;         ///< the weights are the right ones times this
    bool is_own_error = false; ///< of a rule that is right for ever finer nodes
    double point_scale = 1;    ///< the kernel points are the right ones times this
    /// The list of bonds or each weight is another than it should be: single bonds cannot be
    /// compared against others before it is mended.
    bool is_structural = false;
  };

  /// What is known besides the bonds.
  template <int dim>
  struct Circumstances
  {
    std::vector<std::string> meant = {}; ///< rules that the weights are meant to be; empty: unknown
    double volume_factor = 1; ///< that the volumes carry, see VolumeCheck; undone in what is given
    std::vector<CollarBond<dim>> of_collar = {}; ///< bonds of nodes in the collar
  };

  template <int dim>
  struct Explanation
  {
    std::vector<Cause> causes;
    std::optional<Recognised<dim>> rule; ///< of the weights with structural causes undone
  };

  /// Tries what other codes have been seen to do, in this order: all weights are 0; each pair of
  /// nodes stands once; a kernel is in the weights already; weights are the own volume instead of
  /// the neighbour's; kernel points at the bond's midpoint, absolute, reversed, from the neighbour;
  /// weights scaled to the whole ball with the node's own volume; weights negated, twice, half,
  /// with the factor of the volumes, with the volume of a ball (δ³) or the bond constant (δ⁴) of
  /// three dimensions in a plate of thickness h, or by another factor, where weights over volumes
  /// do not depend on the length; a drift in all weights; bonds as long as the horizon left out;
  /// whole cells where partial ones would do. Each has a signature of its own in the bonds and is
  /// undone before the next is tried. What remains is checked in one place: a cause whose removal
  /// does not bring the moments nearer to the exact ones is none (but for kernel points that the
  /// moments do not feel, and a ramp that is meant). Whole cells are a cause whatever the moments
  /// say where a rule with a ramp is meant, and FA is not, as long as the ramp changes the
  /// operator. Where none is meant the moments alone cannot tell: of kernels that fall to 0 at the
  /// horizon, FA's are as good as those of ramps, or better.
  /// @param rule  of the weights as they are given, if one is recognised
  template <int dim>
  Explanation<dim> explain(const GivenBonds<dim> &given, const std::optional<Recognised<dim>> &rule,
                           const Circumstances<dim> &circumstances = {});

  /// The causes alone.
  template <int dim>
  std::vector<Cause> find_causes(const GivenBonds<dim> &given,
                                 const std::optional<Recognised<dim>> &rule,
                                 const std::vector<std::string> &meant = {});
} // namespace plumbline::meshfree
