#pragma once

#include "check/scene_findings.h"

#include <optional>

namespace plumbline::driver
{
  struct CheckOptions : check::Input
  {
    std::string output;                ///< folder; empty: results/check_NAME of the scene
    std::vector<std::string> required; ///< see check::parse_requirements; empty: ac
    bool quiet = false, json = false;  ///< with either of them files are written with -o only
    bool pdf = false;                  ///< maps as PDF, besides SVG
    std::optional<double> budget;      ///< of one level of a series [CPU s]; empty: any
  };

  /// Check quadrature weights of another code on its own nodes: moments, symmetry, matrix,
  /// solutions; outliers among bonds and nodes; what was done to all weights.
  /// A series resumes from check.jsonl after it was interrupted or killed.
  /// Print what is found, and write report.html with maps, nodes.csv, outliers.csv, cells.vtu and
  /// check.json; of a series of files levels.csv, a page for each level, and that of the study. In
  /// three dimensions there are no maps, no cells.vtu, and no checks of matrix and solutions.
  /// @return exit code: 0, or 1: a requirement that does not hold, an outlier, a
  ///         cause found, a matrix that is not positive definite, or errors of a series that stall
  ///         where ac is required
  /// @throws InputError  files, a scene or a requirement that cannot be used
  /// @throws NumericalError  no solution, where the weights are not found wrong; maps that cannot
  ///         be drawn
  int check(const CheckOptions &options);
} // namespace plumbline::driver
