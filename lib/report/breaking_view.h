#pragma once

#include "report/view.h"

namespace plumbline::report
{
  /// The record is of a body in motion whose bonds break, see study::breaking_record.
  bool is_of_breaking(const Record &record);

  View breaking_view(const Record &record);
} // namespace plumbline::report
