#pragma once

#include "driver/analyse.h"

namespace plumbline::driver
{
  struct RunOptions : AnalyseOptions
  {
    std::string model;        ///< smallest or full, instead of the scene's
    bool is_estimate = false; ///< print the memory and time it would take, and run nothing
    unsigned int n_ranks = 0; ///< that estimates are for; 0: those there are
  };

  /// @throws InputError  the scene is one of quasi-static fracture
  void refuse_growth(const scene::Scene &scene);

  /// Run a scene, write its report, print the verdicts.
  /// With is_estimate nothing is run; the memory that it is expected to take is printed,
  /// and on several ranks the time of an iteration.
  /// @return exit code: 0, 1 (an expectation does not hold, with check), 3 (a method fails that the
  ///         scene does not expect to, or charts could not be drawn), 130 (interrupted; what is
  ///         finished is written)
  int run(const RunOptions &options);

  /// Rebuild tables, charts and page of a folder from its results.
  /// @param is_pdf  charts as PDF, besides SVG
  int rebuild_report(const std::string &folder, bool is_pdf);
} // namespace plumbline::driver
