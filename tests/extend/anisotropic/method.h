#pragma once

#include <meshfree/rules/rules.h>
#include <method/method.h>

namespace anisotropic
{
  /// The model with a rule's bonds on lattices, for scalar kernels.
  /// @param a  of the FibreKernel
  std::shared_ptr<const plumbline::method::Method> fibres(plumbline::meshfree::Rule rule, double a);
} // namespace anisotropic
