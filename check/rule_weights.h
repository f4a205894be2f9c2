#pragma once

#include <string>

namespace plumbline::check
{
  /// A rule of the library on a lattice.
  struct RuleOnLattice
  {
    std::string rule;
    double m = 3, h = 1;
    std::string kernel = "linear-decay"; ///< of kernel_types(), whose profile needs no more keys
    unsigned int dimension = 2;
  };

  /// The weights of its family as CSV: the place of the neighbour relative to the node (x, y, z)
  /// [length], weight [length^dim], where the kernel is taken (qx, qy, qz) [length] and the area or
  /// volume that the weight stands for; 17 digits.
  /// @throws InputError      unknown names, numbers outside their range
  /// @throws NumericalError  the rule has no weights at this m
  std::string weights_csv(const RuleOnLattice &options);
} // namespace plumbline::check
