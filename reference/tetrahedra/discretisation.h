#pragma once

#include "method/discretisation_in_space.h"
#include "method/method.h"

namespace plumbline::reference
{
  /// Continuous linear functions, or constants, on the problem's tetrahedra. Entries by quadrature
  /// over pairs of faces that keeps linear fields exact, see FacePotential.
  /// @throws InputError  a kernel that refuse_tetrahedra() refuses
  /// @throws NumericalError  no unknown is free
  std::unique_ptr<method::DiscretisationInSpace>
  discretise_on_tetrahedra(const problem::Problem<3> &problem, bool is_continuous);

  /// Memory of its static solution at the peak [bytes], see method::Method::expected_bytes.
  double expected_bytes_on_tetrahedra(const method::ProblemSize &size, bool is_continuous);
} // namespace plumbline::reference
