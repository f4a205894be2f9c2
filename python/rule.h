#pragma once

#include "callables.h"
#include "meshfree/rules/rules.h"
#include "method/method.h"

namespace plumbline::python
{
  /// A rule that is written in Python: weights of a family from all its bonds, by one call.
  struct PythonRule
  {
    std::string name, help;
    Callable function;
    bool is_partial = false; ///< it is given ball ∩ cell instead of cells whose node is in the ball

    meshfree::Rule rule() const;
  };

  /// @param given  a name of the library's rules, or a rule of Python
  /// @throws InputError  unknown name; the message lists the known ones
  meshfree::Rule to_rule(const py::object &given);

  /// @param given  a name of the library's methods, or a rule of Python
  /// @throws InputError  unknown name; the message lists the known ones
  std::shared_ptr<const method::Method> to_method(const py::object &given);
} // namespace plumbline::python
