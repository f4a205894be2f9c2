#pragma once

#include <optional>
#include <string>

namespace plumbline::app
{
  struct ProbeOptions
  {
    std::string nodes_file; ///< as of check; in space where it has a column z that is not constant
    std::string command;    ///< see check::ForceProgram
    double horizon = 0;     ///< no force reaches farther [length]
    std::optional<double> step; ///< of the displacements [length]; 1e-5 horizons unless given
    std::size_t n_nodes = 2;    ///< to displace, see meshfree::plan_probe
    bool all = false;           ///< displace all nodes
    std::string forces_are = "forces"; ///< of base::words<check::ForceKind>
    std::string output = "bonds.csv";
    bool quiet = false, json = false;
  };

  /// Derive the force constants of another program's bonds from its forces, write them as bonds for
  /// `check --bonds-are 'force constants'`, and print how exact they are.
  /// @return  exit code: 0, or 130: interrupted, nothing is written
  /// @throws InputError  files, numbers or a command that cannot be used; forces that are not those
  /// of bonds
  int probe(const ProbeOptions &options);
} // namespace plumbline::app
