#pragma once

#include "meshfree/method.h"
#include "reference/method.h"

namespace plumbline::driver
{
  /// Meshfree and Galerkin methods, meshfree rules first: the one place that knows both.
  inline method::Methods all_methods()
  {
    method::Methods methods = meshfree::methods();
    for (const auto &method : reference::methods())
      methods.push_back(method);
    return methods;
  }
} // namespace plumbline::driver
