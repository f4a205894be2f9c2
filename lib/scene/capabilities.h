#pragma once

#include "scene/scene.h"

#include <set>
#include <string>
#include <vector>

namespace plumbline::scene
{
  /// What a scene may need, and not every model, method and analysis can do.
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
    cracks,             ///< that stand, see DomainSection
    free_surfaces,      ///< of bodies of nodes alone, Domain/outside
    damaged_dilatation, ///< beside either
    notch,              ///< that opens, see CrackSection
    dilatation,
    zero_dilatation,  ///< of the collar
    mixed_dilatation, ///< as an unknown besides u
    nonlocal,         ///< a solution at a horizon, not its local limit
    dynamic,          ///< motions, see TimeSection
    double_well,
    double_well_collar, ///< with u given all around
    periodic,           ///< a torus
    line                ///< one axis
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

  /// What is done with a scene.
  enum class Analysis
  {
    statics,
    motion,
    crack,  ///< in motion
    growth, ///< of cracks in equilibrium
    strip,  ///< a standing crack
    stability,
    dispersion,
    check ///< of the weights of another code
  };

  /// By their words, in their order.
  const std::vector<Capable> &analyses();

  /// What a scene needs, as far as it says so itself: not which cells a mesh of a file has.
  Capabilities needs(const Scene &scene);

  /// Of what is missing the first thing, what to take instead, and what else to write; empty:
  /// nothing is missing.
  /// @param others  that can do all of it, in words; empty: there are none
  std::string refusal(const Scene &scene, const Capabilities &needed, const Capabilities &can,
                      const std::string &others);

  /// @throws InputError  the scene's model cannot do what else it says
  void check_model(const Scene &scene);

  /// @throws InputError  naming what it cannot do of the scene
  void check_analysis(const Scene &scene, Analysis analysis);

  /// A table in Markdown; those that can do the same share a row.
  std::string capability_table(const std::string &of, const std::vector<Capable> &all);
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::Capability> = std::array{"lattice",
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
                                                              "one dimension"};
  template <>
  inline constexpr auto words<scene::Analysis> = std::array{
      "statics", "motion", "crack", "growth", "strip", "stability", "dispersion", "check"};
} // namespace plumbline::base
