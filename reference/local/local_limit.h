#pragma once

#include "method/method.h"

namespace plumbline::reference
{
  /// The local limit of a problem by classical finite elements of degree 2 on the cells of Ω:
  /// -div(d a ∇u) = b, d the kernel's diffusion and a its coefficient, or for bond tensors
  /// -div(a [λ div u I + 2 μ ε(u)]) = b; u given on the boundary of Ω by the constraint.
  std::unique_ptr<method::Discretisation>
  discretise_local_limit(const problem::Problem<2> &problem);
} // namespace plumbline::reference
