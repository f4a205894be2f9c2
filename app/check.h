#pragma once

#include "scene/scene.h"

namespace plumbline::app
{
  struct CheckOptions
  {
    std::string nodes_file, bonds_file, scene_file; ///< {h} in names: a series of levels
    std::string bonds_are = "weights";              ///< or what else, see meshfree::BondValues
    std::string boundary = "constrained";           ///< or free: that of the domain is a surface
    std::vector<std::string> cracks;                ///< each "x0, y0 : x1, y1", like Domain/cracks
    std::string output;                ///< folder; empty: results/check_NAME of the scene
    std::vector<std::string> required; ///< see requirements.h; empty: ac
    std::vector<scene::Override> overrides;
    bool quiet = false, json = false; ///< with either of them files are written with -o only
  };

  /// Check quadrature weights of another code on its own nodes: moments, symmetry, matrix,
  /// solutions; outliers among bonds and nodes; what was done to all weights.
  /// Print what is found, and write report.html with maps, nodes.csv, outliers.csv, cells.vtu and
  /// check.json.
  /// @return exit code: 0, or 1: a requirement that does not hold, an outlier, a
  ///         cause found, or a matrix that is not positive definite
  /// @throws InputError  files, a scene or a requirement that cannot be used
  /// @throws NumericalError  no solution, where the weights are not found wrong; maps that cannot
  ///         be drawn
  int check(const CheckOptions &options);
} // namespace plumbline::app
