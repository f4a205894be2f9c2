#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::app
{
  struct WeightsOptions
  {
    std::string rule; ///< of the library
    double m = 3, h = 1;
    std::string kernel = "linear-decay"; ///< of kernel_types(), whose profile needs no more keys
    unsigned int dimension = 2;
    bool quiet = false, json = false;       ///< nothing
    std::vector<scene::Override> overrides; ///< none
  };

  /// Print the weights of a rule's family on a lattice as CSV: the place of the neighbour relative
  /// to the node (x, y, z) [length], weight [length^dim], where the kernel is taken (qx, qy, qz)
  /// [length] and the area or volume that the weight stands for; 17 digits.
  /// @return  exit code 0
  /// @throws InputError      unknown names, numbers that cannot be
  /// @throws NumericalError  the rule has no weights at this m
  int weights(const WeightsOptions &options);
} // namespace plumbline::app
