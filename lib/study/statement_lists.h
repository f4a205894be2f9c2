#pragma once

#include "study/study_results.h"

namespace plumbline::study
{
  /// The lists that grow while a study goes on, besides its records, as pointers to members.
  template <class Action>
  void for_each_statement_list(const Action &action)
  {
    action(&StudyResults::left_out);
    action(&StudyResults::references);
    action(&StudyResults::estimates);
    action(&StudyResults::savings);
    action(&StudyResults::maps);
    action(&StudyResults::solution_grids);
    action(&StudyResults::warnings);
  }
} // namespace plumbline::study
