#pragma once

#include "base/choice.h"

#include <string>

namespace plumbline::scene
{
  class Keys;

  /// The state of a strip when its motion begins.
  enum class CrackStart
  {
    opened, ///< at rest with its notch open, by small strains
    sudden  ///< at rest as if there were no notch, which opens at once
  };

  /// What becomes of a crack.
  enum class CrackOutcome
  {
    unknown,
    arrests, ///< stands still at the end
    runs,
    branches,
    too_short ///< the time is too short to tell
  };

  /// What the section Crack of a scene file says: a strip, Domain/boxes, with a notch along y = its
  /// middle from its left edge, pulled apart by grips beyond its upper and lower edge. For
  /// `plumbline crack`; see problem_sections.h.
  struct CrackSection
  {
    double notch = 0; ///< its length; 0: none [length]
    double load = 1;  ///< energy of the strip over that at which a long crack begins to grow
    CrackStart start = CrackStart::opened;
    unsigned int n_samples = 100; ///< of the crack tip and of energies
    unsigned int interval = 20;   ///< of checkpoints [samples]

    bool is_there() const { return notch != 0; }

    void declare(Keys &keys);
    /// @throws InputError  a number that is out of range
    void complete() const;
  };
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::CrackStart> = std::array{"opened", "sudden"};
  template <>
  inline constexpr auto words<scene::CrackOutcome> =
      std::array{"unknown", "arrests", "runs", "branches", "too short to tell"};
} // namespace plumbline::base
