#pragma once

#include "meshfree/check/bond_rule.h"

namespace plumbline::meshfree
{
  /// What a rule with a ramp, or partial areas, would make of weights that are whole cells.
  struct RampEffect
  {
    std::string rule;
    std::size_t n_bonds = 0; ///< given or the rule's
    /// That would have another weight; 0: no cell is in the ramp's range.
    std::size_t n_changed = 0;
    /// The largest of w C, relative to the largest w C; 0: the same operator, since the kernel is 0
    /// where the ramp cuts.
    double change = 0;
    double before = 0, after = 0; ///< median defect of the moments of degree 1 and 2

    /// Whether the operators differ, so that something can tell them apart.
    bool is_seen() const { return change > file_tolerance; }
  };

  /// Of LAMMPS, QWJ and PA-AC.
  /// @param families  weights that are those of FA
  template <int dim>
  std::vector<RampEffect> ramp_effects(const GivenBonds<dim> &given,
                                       const std::vector<Family<dim>> &families);

  /// The same for people: that the weights are whole cells, and what ramps would make of the
  /// moments.
  /// @param measure  area or volume
  std::string ramp_text(const std::vector<RampEffect> &effects,
                        const std::string &measure = "area");
} // namespace plumbline::meshfree
