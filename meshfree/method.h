#pragma once

#include "meshfree/rules/rules.h"
#include "method/method.h"

namespace plumbline::meshfree
{
  /// Every rule of the table as a method, on lattices and on scattered nodes.
  method::Methods methods();

  /// A rule as a method, of the table or not.
  std::shared_ptr<const method::Method> make_method(const Rule &rule);
} // namespace plumbline::meshfree
