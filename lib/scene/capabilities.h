#pragma once

#include "problem/capabilities.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
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
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::Analysis> = std::array{
      "statics", "motion", "crack", "growth", "strip", "stability", "dispersion", "check"};
} // namespace plumbline::base
