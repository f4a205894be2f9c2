#pragma once

#include "base/choice.h"

namespace plumbline::scene
{
  class Keys;

  /// What holds a strip.
  enum class StripEdges
  {
    grips,  ///< Rice's, which move apart by 2
    K_field ///< all around, the field of a crack at K = 1
  };

  /// A strip with a standing crack, see method::RiceStrip.
  struct StripSection
  {
    double height = 1; ///< between the grips [length]
    double length = 0; ///< 0: there is none [length]
    double crack = 0;  ///< from its left end [length]
    StripEdges edges = StripEdges::grips;
    unsigned int n_growth = 0; ///< columns that it grows through, by rules

    bool is_there() const { return length != 0; }

    void declare(Keys &keys);
    /// @throws InputError  a number that is out of range
    void complete() const;
  };
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::StripEdges> = std::array{"grips", "K field"};
} // namespace plumbline::base
