#pragma once

#include "base/choice.h"
#include "scene/choices.h"

#include <string>

namespace plumbline::study
{
  /// What varies along a trend, coarse to fine.
  enum class Axis
  {
    mesh_size, ///< h
    horizon,   ///< δ where h is fixed
    time_step  ///< Δt at one level
  };

  /// That of a study's levels.
  inline Axis level_axis(scene::Regime regime)
  {
    return regime == scene::Regime::horizon ? Axis::horizon : Axis::mesh_size;
  }

  /// The place of a level, run or row on it.
  template <class Level>
  double coordinate(Axis axis, const Level &level)
  {
    return axis == Axis::horizon ? level.horizon : level.h;
  }

  /// Symbol, meaning and unit, for charts.
  inline std::string label(Axis axis)
  {
    switch (axis)
    {
    case Axis::mesh_size:
      return "mesh size h [length]";
    case Axis::horizon:
      return "horizon δ [length]";
    default:
      return "time step Δt [time]";
    }
  }
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::Axis> = std::array{"h", "horizon", "dt"};
} // namespace plumbline::base
