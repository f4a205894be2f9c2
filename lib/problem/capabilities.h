#pragma once

#include "base/choice.h"

#include <set>
#include <string>
#include <vector>

namespace plumbline::problem
{
  /// What a problem may need, and not every model, method and analysis can do.
  enum class Capability
  {
    lattice,
    meshes, ///< cells that differ
    quadrilaterals,
    triangles,
    mixed_cells,
    free_boundary,
    floating, ///< a body of which nothing is fixed
    heterogeneous,
    cracks,             ///< that stand
    free_surfaces,      ///< where families end, Domain/outside
    damaged_dilatation, ///< beside either
    notch,              ///< that opens
    dilatation,
    zero_dilatation,  ///< of the collar
    mixed_dilatation, ///< as an unknown besides u
    nonlocal,         ///< a solution at a horizon, not its local limit
    dynamic,          ///< motions
    double_well,
    double_well_collar, ///< with u given all around
    periodic,           ///< a torus
    line,               ///< one axis
    space               ///< three axes
  };

  using Capabilities = std::set<Capability>;

  Capabilities all_capabilities();
  Capabilities all_but(const Capabilities &left_out);
  Capabilities of_meshes(); ///< with cells of all kinds
  Capabilities of_damage(); ///< cracks that stand, and free surfaces
  Capabilities operator|(Capabilities a, const Capabilities &b);

  /// A row of a table: what a model, an analysis or a method can do.
  struct Capable
  {
    std::string name;
    Capabilities can;
  };

  /// A table in Markdown; those that can do the same share a row.
  std::string capability_table(const std::string &of, const std::vector<Capable> &all);
} // namespace plumbline::problem

namespace plumbline::base
{
  template <>
  inline constexpr auto words<problem::Capability> = std::array{"lattice",
                                                                "meshes",
                                                                "quadrilaterals",
                                                                "triangles",
                                                                "mixed cells",
                                                                "free boundary",
                                                                "floating",
                                                                "heterogeneous",
                                                                "cracks",
                                                                "free surfaces",
                                                                "dilatation at cracks",
                                                                "notch",
                                                                "dilatation",
                                                                "zero collar dilatation",
                                                                "mixed dilatation",
                                                                "nonlocal",
                                                                "dynamic",
                                                                "double well",
                                                                "double well in a collar",
                                                                "periodic",
                                                                "one dimension",
                                                                "three dimensions"};
} // namespace plumbline::base
