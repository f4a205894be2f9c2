#pragma once

#include "base/choice.h"
#include "scene/problem.h"

#include <set>
#include <string>

namespace plumbline::method
{
  /// What a scene may need, and not every method can do.
  enum class Capability
  {
    lattice,
    quadrilaterals,
    triangles,
    mixed_cells,
    free_boundary,
    heterogeneous,
    damage,
    zero_dilatation,  ///< of the collar
    mixed_dilatation, ///< as an unknown besides u
    nonlocal,         ///< a solution at a horizon, not its local limit
    dynamic,          ///< motions, see scene::TimeSection
    double_well,
    double_well_collar, ///< with u given all around
    periodic            ///< a torus
  };

  using Capabilities = std::set<Capability>;

  Capabilities all_capabilities();

  /// What a scene needs.
  /// @param problem  of any case and level
  Capabilities needs(const scene::Scene &scene, const scene::Problem &problem);

  /// How a scene says that it needs something, and what to write instead; empty: there is nothing.
  struct Need
  {
    std::string text, remedy;
  };
  Need describe(Capability capability, const scene::Scene &scene);
} // namespace plumbline::method

namespace plumbline::base
{
  template <>
  inline constexpr auto words<method::Capability> = std::array{"lattice",
                                                               "quadrilaterals",
                                                               "triangles",
                                                               "mixed cells",
                                                               "free boundary",
                                                               "heterogeneous",
                                                               "damage",
                                                               "zero collar dilatation",
                                                               "mixed dilatation",
                                                               "nonlocal",
                                                               "dynamic",
                                                               "double well",
                                                               "double well in a collar",
                                                               "periodic"};
} // namespace plumbline::base
