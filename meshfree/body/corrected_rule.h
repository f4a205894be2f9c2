#pragma once

#include "method/method.h"

namespace plumbline::meshfree
{
  /// RULE+CORRECTION, a rule on bodies of bonds with a free boundary, for each surface correction
  /// and some rules. Not in `all`.
  method::Methods corrected_rules();
} // namespace plumbline::meshfree
