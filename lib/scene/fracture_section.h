#pragma once

#include "problem/fracture.h"
#include "scene/vocabulary.h"

namespace plumbline::scene
{
  class Keys;

  /// What can be expected of a growth, see study/growth.h.
  inline constexpr std::array growth_quantities = {
      "broken bonds", "events",     "peak load",   "peak reaction",
      "advance",      "G by bonds", "G by energy", "K by bonds",
      "K by energy",  "L1",         "L2",          "Li"};

  /// What the section Fracture of a scene file says: how bonds break in equilibrium, for
  /// `plumbline grow`. Domain, its cracks (the notch) and its fixed parts (the grips), Material and
  /// Problem/constraint (what the grips do) say of what body.
  struct FractureSection : problem::FractureSettings
  {
    void declare(Keys &keys);
    /// @param of_material  Material/surface terms
    /// @throws InputError  a number that is out of range; two keys that contradict each other
    void complete(SurfaceTerms of_material);
  };
} // namespace plumbline::scene
