#pragma once

#include "requirements.h"

namespace plumbline::app
{
  /// Whether names of files stand for a series, one for each mesh size: nodes_{h}.csv.
  bool is_series(const CheckOptions &options);

  /// Check the weights of each level of a scene that there are files for, and what the errors of
  /// the solutions by them say together: rates, and whether they converge to the limit.
  /// Print a row for each level and the verdicts; write a page for each level, and that of the
  /// study with charts over h.
  /// @return exit code as of `check`; 1 as well where ac is required and the errors stall
  /// @throws InputError  a level without files between others, several series of levels, less than
  /// two levels with files
  int check_series(const scene::Scene &scene, const CheckOptions &options,
                   const Requirements &required);
} // namespace plumbline::app
