#pragma once

#include "report/text_table.h"
#include "study/grade.h"

#include <string>

namespace plumbline::report
{
  /// Values with their bounds by both ways, point by point.
  Table certificate_table(const study::Certificate &certificate, bool has_mean);

  /// Root mean squares of the errors of a certificate's meshfree rules by mesh sizes, their orders,
  /// and the digits on the finest one.
  Table rules_table(const study::Certificate &certificate);

  /// Why nothing is certified, in a sentence; empty: all values are, to a digit at least.
  std::string certificate_refusal(const study::Certificate &certificate);

  /// What is certified, with all tables and the scene.
  std::string certificate_markdown(const study::Certificate &certificate);

  /// For a terminal: as many values as there is room for; the answer last.
  /// @param file  where all of them are
  std::string certificate_summary(const study::Certificate &certificate, const std::string &file);

  /// Grades by a certificate, beside those of its meshfree rules; the answer last.
  std::string grade_text(const study::Certificate &certificate, const study::SeriesGrade &found);
} // namespace plumbline::report
