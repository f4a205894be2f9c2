#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::app
{
  struct ModuliOptions
  {
    std::string kernel = "bond-tensor"; ///< of kernel_types(), a tensor
    std::string state = "plane stress"; ///< of base::words<physics::ElasticState>
    std::string rules = "all";          ///< comma separated
    std::vector<std::string> ratios;    ///< m = horizon / h; empty: 2, 3, 4, 5
    double E = 1;                       ///< Young's modulus that the kernel is made for
    bool json = false;
    std::vector<scene::Override> overrides; ///< none
  };

  constexpr auto ratios_option = "--m";

  /// Print the elastic constants of each rule on a square or cubic lattice.
  /// @return  exit code 0
  /// @throws InputError  unknown names, numbers that cannot be
  int moduli(const ModuliOptions &options);
} // namespace plumbline::app
