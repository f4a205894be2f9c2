#pragma once

#include "report/text_table.h"
#include "study/certificate.h"

namespace plumbline::app
{
  /// Root mean squares of the errors of a certificate's meshfree rules by mesh sizes, their orders,
  /// and the digits on the finest one.
  report::Table table_of_rules(const study::Certificate &certificate);
} // namespace plumbline::app
