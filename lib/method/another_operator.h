#pragma once

#include "method/method.h"

#include <string>

namespace plumbline::method
{
  /// A method that discretises a different operator from that of the problem, to show the effect of
  /// this. Its solutions tend to those of that operator. Changes of mesh or degree do not reveal
  /// this, so it has no error estimate and cannot be a reference.
  class AnotherOperator
  {
  public:
    virtual ~AnotherOperator() = default;

    /// What it does to the operator, as a predicate after the name of the method: "replaces ...".
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
