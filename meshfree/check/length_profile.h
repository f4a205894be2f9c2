#pragma once

#include "meshfree/check/bond_rule.h"

namespace plumbline::meshfree
{
  /// Weights over volumes by the length of bonds, up to half a node's size within the horizon,
  /// where no rule cuts cells.
  struct LengthProfile
  {
    struct Bin
    {
      double length = 0;    ///< median [length]
      double ratio = 0;     ///< median of weights over volumes
      double deviation = 0; ///< mean of |weight over volume - ratio|
    };
    std::vector<Bin> bins; ///< ascending lengths; empty: too few bonds

    double largest() const; ///< |ratio|

    /// From the largest ratio to the smallest, relative to the largest; 0: no bins.
    double variation() const;

    /// Of bonds of one length, most of them, relative to the largest ratio; 0: no bins.
    double scatter() const;

    /// Whether ratios become smaller with the length, and never change their sign.
    bool falls() const;
  };

  enum class VolumeOf
  {
    neighbour,
    node ///< that the bond is of
  };

  template <int dim>
  LengthProfile length_profile(const GivenBonds<dim> &given, VolumeOf volume = VolumeOf::neighbour);
} // namespace plumbline::meshfree
