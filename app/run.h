#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::app
{
  struct RunOptions
  {
    std::string scene_file, output; ///< output empty: results/NAME of the scene
    std::vector<scene::Override> overrides;
    std::string methods; ///< comma separated, instead of the scene's
    std::string model;   ///< smallest or full, instead of the scene's
    unsigned int n_levels = 0;
    double budget = 0; ///< of a single solve [CPU s]; 0: any
    bool check = false, quiet = false, json = false;
  };

  /// Run a scene, write its report, print the verdicts.
  /// @return exit code: 0, 1 (an expectation does not hold, with check), 3 (a method fails that the
  ///         scene does not expect to, or charts could not be drawn), 130 (interrupted; what is
  ///         finished is written)
  int run(const RunOptions &options);

  /// Rebuild tables, charts and page of a folder from its results.
  int rebuild_report(const std::string &folder);
} // namespace plumbline::app
