#pragma once

#include "method/discretisation_in_space.h"
#include "method/method.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// Why these functions have no entries of a kernel, and the remedy; empty: they have.
  /// @param has_dilatation  whose influence function has the kernel's profile
  std::string refuse_tetrahedra(const physics::Kernel<3> &kernel, bool has_dilatation,
                                TetrahedralShapes shapes);

  /// Functions on the problem's tetrahedra. Entries are exact, see FacePotential; those of linear
  /// functions that are not continuous need quadrature, see assemble_with_jumps().
  /// @throws InputError  a kernel that refuse_tetrahedra() refuses
  /// @throws NumericalError  no unknown is free
  std::unique_ptr<method::DiscretisationInSpace>
  discretise_on_tetrahedra(const problem::Problem<3> &problem, TetrahedralShapes shapes);

  /// Memory of its static solution at the peak [bytes], see method::Method::expected_bytes.
  double expected_bytes_on_tetrahedra(const method::ProblemSize &size, TetrahedralShapes shapes);
} // namespace plumbline::reference
