#pragma once

#include "report/view.h"

// What is shown of static solutions.
namespace plumbline::report
{
  /// Charts of errors, costs and iterations of each case, and maps. Of work and precision the first
  /// chart is that of the telling problem, with each method's points that no other series of it
  /// beats; elsewhere those of that problem come first. A point whose error is zero or not a
  /// number, or whose cost is zero, is left out of the picture, and its value is an empty field in
  /// the CSV. Errors below round-off stand in a strip (see Strip) of the picture, and as they are
  /// in the CSV. A gallery may be empty.
  std::vector<Gallery> statics_galleries(const StudyResults &results);

  /// Which method to take: statements, remarks, cards and lines of the terminal.
  void add_advice(const StudyResults &results, View &view);
} // namespace plumbline::report
