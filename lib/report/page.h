#pragma once

#include "study/study_results.h"

#include <filesystem>

namespace plumbline::report
{
  /// Write dir/report.html: one file that needs no other, no network and no script. Pictures are
  /// taken from dir/charts (see write_charts); one that is not there is named with its data.
  /// @throws InputError  dir cannot be written
  void write_page(const study::StudyResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
