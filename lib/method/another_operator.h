#pragma once

#include "method/method.h"

#include <string>

namespace plumbline::method
{
  /// A method that discretises another operator than that of the problem, to show what follows from
  /// it. Its solutions tend to those of that operator, which changes of mesh or degree do not
  /// reveal: it has no error estimate and is no reference.
  class AnotherOperator
  {
  public:
    virtual ~AnotherOperator() = default;

    /// What it does to the operator, as what follows the name of the method: "replaces ...".
    virtual std::string what_it_does() const = 0;
  };

  /// Null: the method discretises the operator of the problem.
  inline const AnotherOperator *of_another_operator(const Method &method)
  {
    return dynamic_cast<const AnotherOperator *>(&method);
  }

  /// A Galerkin method of the operator of the problem, whose error can be estimated.
  inline bool is_reference(const Method &method)
  {
    return method.family() == MethodFamily::reference && of_another_operator(method) == nullptr;
  }
} // namespace plumbline::method
