#pragma once

#include "meshfree/rules/rules.h"
#include "physics/elastic_constants.h"
#include "report/view.h"

#include <string>
#include <vector>

namespace plumbline::check
{
  struct ModuliOptions
  {
    std::string kernel = "bond-tensor";    ///< of kernel_types(), a tensor
    std::string state = "plane strain";    ///< of base::words<physics::ElasticState>
    std::string rules = "all";             ///< comma separated
    std::vector<std::string> ratios;       ///< m = horizon / h; empty: 2, 3, 4, 5
    double E = 1;                          ///< Young's modulus that the kernel is made for
    std::vector<meshfree::Rule> own_rules; ///< besides those of the library, in the plane
  };

  constexpr auto ratios_option = "--m";

  /// @throws InputError  a word that is none of "plane stress", "plane strain" and "3D"
  physics::ElasticState elastic_state(const std::string &word);

  /// The elastic constants of each rule on a square or cubic lattice, one record for each ratio.
  /// @throws InputError  unknown names, numbers outside their range
  study::StudyResults moduli_of_rules(const ModuliOptions &options);

  report::View moduli_view(const study::StudyResults &results);
} // namespace plumbline::check
