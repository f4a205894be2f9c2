#pragma once

#include "base/choice.h"

namespace plumbline::method
{
  /// Whose a method is. Meshfree methods and references share no code that decides numbers.
  enum class MethodFamily
  {
    meshfree,
    reference, ///< Galerkin
    local      ///< of the local limit
  };
} // namespace plumbline::method

namespace plumbline::base
{
  template <>
  inline constexpr auto words<method::MethodFamily> = std::array{"meshfree", "reference", "local"};
} // namespace plumbline::base
