#pragma once

#include "problem/capabilities.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// Analyses of a scene.
  enum class Analysis
  {
    statics,
    transient,
    crack,  ///< dynamic fracture
    growth, ///< quasi-static fracture
    strip,  ///< stationary crack
    stability,
    dispersion,
    check ///< of the weights of another code
  };

  /// Their capabilities, in the order of the enum.
  const std::vector<Capable> &analyses();

  /// Capabilities that a scene needs, as far as its keys tell: not the cell types of a mesh file.
  Capabilities needs(const Scene &scene);

  /// Message that names the first missing capability and its remedies; empty: none is missing.
  /// @param others  names of alternatives that have all capabilities; empty: there are none
  std::string refusal(const Scene &scene, const Capabilities &needed, const Capabilities &can,
                      const std::string &others);

  /// @throws InputError  the scene's model lacks a capability that the scene needs
  void check_model(const Scene &scene);

  /// @throws InputError  the analysis lacks a capability that the scene needs
  void check_analysis(const Scene &scene, Analysis analysis);
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::Analysis> =
      std::array{"statics", "transient analysis", "crack",      "growth",
                 "strip",   "stability",          "dispersion", "check"};
} // namespace plumbline::base
