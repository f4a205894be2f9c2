#pragma once

#include "report/text_table.h"
#include "study/study_results.h"

namespace plumbline::report
{
  /// Of records with the norm "energy", see study/energy.h: the energy of each solution, that of
  /// the known solution at the method's nodes, and the error in the energy norm.
  Table energy_table(const study::StudyResults &results);
} // namespace plumbline::report
