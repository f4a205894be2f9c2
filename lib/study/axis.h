#pragma once

#include "base/choice.h"
#include "scene/choices.h"

#include <algorithm>
#include <string>
#include <vector>

namespace plumbline::study
{
  /// What varies along a trend, coarse to fine where it refines.
  enum class Axis
  {
    mesh_size, ///< h
    horizon,   ///< δ where h is fixed
    time_step, ///< Δt at one level
    variable   ///< a number of the scene, Study/variable
  };

  /// That of a study's levels.
  inline Axis level_axis(scene::Regime regime)
  {
    return regime == scene::Regime::horizon    ? Axis::horizon
           : regime == scene::Regime::variable ? Axis::variable
                                               : Axis::mesh_size;
  }

  /// The place of a level, run or row on it.
  template <class Level>
  double coordinate(Axis axis, const Level &level)
  {
    return axis == Axis::horizon ? level.horizon : axis == Axis::variable ? level.value : level.h;
  }

  /// Whether places on it are drawn on a logarithmic axis: lengths and times are; variables where
  /// they are positive and grow eightfold.
  inline bool is_logarithmic(Axis axis, const std::vector<double> &x)
  {
    constexpr double wide = 8;
    if (axis != Axis::variable || x.empty())
      return true;
    const auto [least, most] = std::minmax_element(x.begin(), x.end());
    return *least > 0 && *most >= wide * *least;
  }

  /// Symbol, meaning and unit, for charts.
  /// @param variable  its name, where that is the axis
  inline std::string label(Axis axis, const std::string &variable)
  {
    switch (axis)
    {
    case Axis::mesh_size:
      return "mesh size h [length]";
    case Axis::horizon:
      return "horizon δ [length]";
    case Axis::variable:
      return variable;
    default:
      return "time step Δt [time]";
    }
  }
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::Axis> = std::array{"h", "horizon", "dt", "variable"};
} // namespace plumbline::base
