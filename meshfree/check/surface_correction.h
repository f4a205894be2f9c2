#pragma once

#include "meshfree/check/bulk_bonds.h"
#include "meshfree/surface/corrections.h"

#include <functional>

namespace plumbline::meshfree
{
  /// What was done to the weights near free surfaces and cracks.
  enum class Correction
  {
    none,
    /// Weights are multiplied by 2 V0 / (V_i + V_j), where V is the volume of a node's family and
    /// V0 that of one in the bulk. Source: the volume method of Le & Bobaru 2018,
    /// doi:10.1007/s00466-017-1469-1.
    volume,
    whole_ball,    ///< by V0 / V_i: every family has the sums of one in the bulk
    force_density, ///< by force_density_method(), of bond tensors alone
    energy         ///< by energy_method(), of bond tensors alone
  };

  /// One of the quantities that are used for V.
  struct FamilySize
  {
    std::string name;           ///< e.g. "the area of the visible part"
    std::vector<double> values; ///< of each node, numbered as the cells; NaN: not known
    double in_bulk = 0;         ///< V0
    /// Of the force density and the energy method instead: sums along the axes relative to those of
    /// the bulk, and where the nodes are [length].
    std::vector<AxisSums> sums = {};
    std::vector<Point<2>> places = {};
  };

  struct FoundCorrection
  {
    Correction correction = Correction::none;
    FamilySize size;
    /// Median over the bonds of families that are cut, or whose neighbour's is, of |weight /
    /// expected - 1|, where bonds of the bulk are expected; and with the correction.
    double before = 0, after = 0;

    /// By which the weight of a bond was multiplied; 1 where it is not known.
    double factor(std::size_t node, std::size_t neighbour) const;
  };

  /// Tries each correction with each quantity for V, and takes the one that explains the weights
  /// best, if it leaves a quarter of the differences at most.
  /// @param bulk     of the weights as they are given
  /// @param is_cut   of each node: its family is not a whole ball
  /// @param is_bulk  of each family
  /// @param visible  area of the visible part of each node's ball [length^2]
  FoundCorrection find_correction(const GivenWeights<2> &given, const BulkBonds &bulk,
                                  const std::vector<char> &is_cut, const std::vector<char> &is_bulk,
                                  const std::vector<double> &visible, const Kernel<2> &kernel);
} // namespace plumbline::meshfree
