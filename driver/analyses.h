#pragma once

#include "report/view.h"
#include "study/dispersion.h"

namespace plumbline::driver
{
  /// What an analysis needs besides its scene.
  struct Asked
  {
    study::Checkpoints checkpoints;
    study::AskedDirections directions = {}; ///< of waves
    bool has_frames = false; ///< of cracks: states for ParaView in frames/, beside the checkpoint
  };

  /// An analysis of the command and of Python, and how its results are shown.
  struct AnalysisRow
  {
    std::string name;     ///< of the command, of the analysis and of its files
    std::string help;     ///< of the command
    std::string expected; ///< what --check checks
    study::Analysis (*make)(const Asked &) = nullptr;
    report::View (*view)(const study::StudyResults &) = report::default_view;
    bool has_checkpoint = false;   ///< see study::Checkpoints
    bool takes_directions = false; ///< see Asked
  };

  /// All analyses except those of `run`; to add one, add a row.
  const std::vector<AnalysisRow> &analyses();

  /// Null if there is none of this name.
  const AnalysisRow *find_analysis(const std::string &name);
} // namespace plumbline::driver
