#pragma once

#include "study/study_results.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// What is found where surface terms exert a net force at tips of cracks, one sentence for each
  /// problem, series and tip: over the last three levels, at which m is fixed, F grows like
  /// δ^(1/2 ± .15) and is more than 1e-6 of the forces that it is the sum of. Such a force moves
  /// the body by as much as F times a function of the place, so that the error tends to √δ.
  std::vector<std::string> tip_force_findings(const StudyResults &results);

  /// Put them in the place of earlier ones among the warnings.
  void warn_of_tip_forces(StudyResults &results);
} // namespace plumbline::study
