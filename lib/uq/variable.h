#pragma once

#include "base/choice.h"

#include <string>

namespace plumbline::uq
{
  /// The law of a variable in its standard form.
  enum class Law
  {
    normal, ///< mean 0, deviation 1
    uniform ///< on (-1, 1)
  };

  /// An independent random variable: centre + scale times a standard one.
  struct Variable
  {
    std::string name;
    Law law = Law::normal;
    double centre = 0; ///< mean
    double scale = 1;  ///< > 0: deviation of normal ones, half the width of uniform ones

    double at(double standard) const { return centre + scale * standard; }
  };
} // namespace plumbline::uq

namespace plumbline::base
{
  template <>
  inline constexpr auto words<uq::Law> = std::array{"normal", "uniform"};
} // namespace plumbline::base
